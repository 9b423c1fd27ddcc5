// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "geometry/camera_model.hpp"
#include "geometry/plane.hpp"
#include "geometry/plane_frame.hpp"
#include "geometry/polygon.hpp"
#include "perception/plane_pixels.hpp"

namespace geomap::perception {

/// @brief One connected piece of a plane, and its border in the image.
struct PlanePart {
  PlaneSums sums;
  double covered = 0.0;  // area on the plane that the pixels cover [m²]
  /// Closed rings of image points [pixel]; their area is on the left as seen on the plane from the
  /// camera. Border points lie on the outer edges of border pixels.
  std::vector<std::vector<Eigen::Vector2d>> rings;
};

struct PartSettings {
  double alpha = 0.06;      // largest circumscribed circle of a triangle of the hull, radius [m]
  double tolerance = 0.06;  // parts farther apart than this are separate [m]
  double spacing = 0.035;   // of the points inside that are triangulated [m]
};

/// @brief Splits a plane's pixels into parts (paper: clustering of the inliers) and traces each part's
/// concave hull. Lengths grow where the pixels' spacing on the plane is larger. The points triangulated
/// are where pixels' rays meet the plane: free of depth noise, and not shrunk by any averaging.
/// @param index of the plane in `pixels`.
std::vector<PlanePart> split_into_parts(const geometry::CameraModel& camera, int width,
                                        const geometry::Plane& plane, std::int16_t index,
                                        const PlanePixels& pixels, const PartSettings& settings);

/// @brief Where the ray through an image point meets the plane, camera frame [m].
Eigen::Vector3d intersect(const geometry::CameraModel& camera, const geometry::Plane& plane,
                          const Eigen::Vector2d& pixel);

/// @brief Length on the plane [m] of one pixel at an image point, in the direction of the plane's slope.
double pixel_length(const geometry::CameraModel& camera, const geometry::Plane& plane,
                    const Eigen::Vector2d& pixel);

/// @brief A part's rings on the 0.1 mm grid of `frame`, made valid.
geometry::Polygon part_polygon(const geometry::CameraModel& camera, const geometry::Plane& plane,
                               const geometry::PlaneFrame& frame, const PlanePart& part);

}  // namespace geomap::perception
