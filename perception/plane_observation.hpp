// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/planar_polygon.hpp"
#include "perception/depth_tolerance.hpp"
#include "perception/extraction_config.hpp"
#include "perception/plane_parts.hpp"
#include "perception/plane_pixels.hpp"

namespace geomap::perception {

/// @brief A plane to report, its outline still to come, and the pixels that are on it: those of a
/// part with that surface's label.
struct FoundPart {
  geometry::PlaneObservation observation;
  std::int16_t surface = 0;
  PlanePart part;
};

/// @brief The connected parts of surfaces that are planes and can be known: fitted to their own
/// pixels, of the wanted orientation, larger ones first.
/// @param planes of the surfaces, by label; `pixels` must outlive the result.
std::vector<FoundPart> find_parts(const ExtractionConfig& config, const geometry::RgbdFrame& frame,
                                  const DepthCells& cells, const DepthTolerance& tolerance,
                                  const std::vector<geometry::Plane>& planes,
                                  const PlanePixels& pixels,
                                  const std::optional<Eigen::Vector3d>& up_camera);

/// @brief Whether an outline is large enough, and its pixels cover enough of it.
bool covers_enough(const geometry::CameraModel& camera,
                   const geometry::PlaneObservation& observation, const PlanePart& part,
                   const ExtractionConfig& config);

/// @brief Per pixel the index of its part, or kNoPlane. @param label of the surfaces, per pixel.
std::vector<std::int16_t> label_parts(const std::vector<FoundPart>& found,
                                      const std::vector<std::int16_t>& label, int width);

}  // namespace geomap::perception
