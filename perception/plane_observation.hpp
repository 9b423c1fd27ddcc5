// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "geometry/planar_polygon.hpp"
#include "perception/depth_tolerance.hpp"
#include "perception/part_outline.hpp"

namespace geomap::perception {

/// @brief What makes a part of a plane worth reporting, and how its outline is drawn.
struct ObservationSettings {
  double min_area = 0.015;  // [m²]
  int min_pixels = 200;
  double min_fill = 0.4;             // share of the outline's area that pixels cover
  double max_rms_ratio = 1.6;        // rms over what noise model and systematic error expect
  double max_curvature = 3.0;        // of what counts as a plane [1/m]
  double min_view_cosine = 0.1;      // |n·ray|: views more grazing than that do not decide a side
  double max_normal_error = 0.1;     // standard deviation of the normal [rad]
  double alpha = 0.06;               // of the concave hull [m]
  double simplify_tolerance = 0.01;  // of the outline, one pixel's length is added [m]
};

/// @brief A part as an observation: plane fitted to its own pixels, outline, statistics. Nothing
/// where it turns out to be no plane, or none that can be known.
/// @param index label of the plane of which this is a part.
std::optional<geometry::PlaneObservation> observe(const geometry::CameraModel& camera,
                                                  const LabelImage& image, std::int16_t index,
                                                  const PlanePart& part,
                                                  const DepthTolerance& tolerance,
                                                  const ObservationSettings& settings);

}  // namespace geomap::perception
