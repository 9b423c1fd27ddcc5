// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/plane.hpp"
#include "perception/cell_means.hpp"
#include "perception/cell_normals.hpp"
#include "perception/depth_cells.hpp"
#include "perception/depth_tolerance.hpp"

namespace geomap::perception {

/// @brief A plane as a linear function of the ray: inverse depth q = a x + b y + c [1/m].
struct InversePlane {
  double a = 0.0, b = 0.0, c = 0.0;
  double length = 0.0;  // of (a, b, c): one over the plane's distance from the camera [1/m]

  static InversePlane of(const Eigen::Vector3d& coefficients) {
    return {coefficients.x(), coefficients.y(), coefficients.z(), coefficients.norm()};
  }
  Eigen::Vector3d coefficients() const { return {a, b, c}; }
  Eigen::Vector3d normal() const { return -coefficients() / length; }  // towards the camera
  geometry::Plane plane() const { return {normal(), 1.0 / length}; }
  double off(const CellMean& mean) const { return mean.q - (a * mean.x + b * mean.y + c); }
  /// @brief Whether a cell's mean is within tolerance of the plane.
  bool is_near(const CellMean& mean, const DepthTolerance& tolerance) const;
};

/// @brief Cells of one plane.
struct SurfaceRegion {
  InverseDepthSums sums;
  std::optional<InversePlane> plane;
  std::vector<int> cells;

  void fit();
  double depth() const { return sums.mean_depth(); }
};

/// @brief Root of the mean square distance of a region's readings from a plane, along its normal
/// [m].
double rms_about(const InverseDepthSums& sums, const InversePlane& plane);

/// @brief Planes of a depth image, and the cells that are on them.
struct CellRegions {
  std::vector<geometry::Plane> planes;   // normals towards the camera (d > 0)
  std::vector<std::int16_t> cell_label;  // per cell: index into planes, or kNoPlane
};

/// @brief Joins regions that touch in the image and are one surface under the sensor's tolerance;
/// drops those without a plane, and what noise makes up across an edge. Cells without a region that
/// lie on a plane and have its normal become that plane's.
/// @param max_normal_angle between a cell's normal and its plane's [rad]
/// @param max_merge_angle between planes that may be joined [rad]; small ones may be turned by
/// twice as much
/// @param label per cell its region, or negative
CellRegions merge_regions(const DepthCells& cells, const std::vector<CellNormal>& normals,
                          const std::vector<CellMean>& means, const DepthTolerance& tolerance,
                          double max_normal_angle, double max_merge_angle,
                          std::vector<SurfaceRegion> regions, std::vector<std::int16_t> label);

}  // namespace geomap::perception
