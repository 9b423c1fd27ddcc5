// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "perception/extraction_config.hpp"
#include "perception/plane_extractor.hpp"
#include "perception/plane_observation.hpp"
#include "perception/surface_region.hpp"

namespace geomap::perception {

/// @brief What plane extractors do differently.
struct ExtractionSteps {
  /// Planes, and the cells that are on them.
  std::function<CellRegions(const DepthCells&, const std::vector<CellNormal>&,
                            const DepthTolerance&)>
      find_regions;
  /// Largest angle [rad] between a cell's normal and the plane of its pixels.
  std::function<double(const DepthTolerance&)> max_normal_angle;
  /// Writes the polygons of `found`; `label`, the parts' numbers per pixel, may be extended.
  std::function<void(const PlanePixels& pixels, std::vector<FoundPart>& found,
                     std::vector<std::int16_t>& label)>
      outline;
};

/// @brief What they have in common: cells with normals, regions of cells, pixels, connected parts,
/// outlines, and what of them is a plane worth reporting.
/// @throws std::invalid_argument as ExtractionConfig::require_valid. An empty depth image has no
/// planes.
ExtractedPlanes extract_surfaces(const ExtractionConfig& config, const geometry::RgbdFrame& frame,
                                 const std::optional<Eigen::Vector3d>& up_camera,
                                 const ExtractionSteps& steps);

}  // namespace geomap::perception
