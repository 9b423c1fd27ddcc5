// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/plane.hpp"
#include "geometry/plane_moments.hpp"
#include "geometry/rgbd_frame.hpp"
#include "perception/cell_normals.hpp"
#include "perception/depth_cells.hpp"
#include "perception/depth_tolerance.hpp"

namespace geomap::perception {

/// @brief Label of a pixel or cell without a plane.
inline constexpr std::int16_t kNoPlane = -1;

/// @brief Sums over pixels of one plane.
struct PlaneSums {
  geometry::PlaneMoments moments;  // camera frame, weights 1/σ_z²
  int pixels = 0;
  std::array<double, 3> color{};  // of red, green, blue; zero without a colour image of the depth's size

  PlaneSums& operator+=(const PlaneSums& other);
};

/// @brief The pixels of one plane within one cell.
struct PlaneCell {
  int cell = 0;
  PlaneSums sums;
  Eigen::AlignedBox2i box;  // of the pixels (u, v)
};

/// @brief Which pixel belongs to which plane.
struct PlanePixels {
  std::vector<std::int16_t> label;            // per pixel: index of the plane, or kNoPlane
  std::vector<std::int16_t> cell_label;       // per cell: the plane of most of its pixels, or kNoPlane
  std::vector<std::vector<PlaneCell>> cells;  // per plane, cells ascending
};

/// @brief Assigns every reading to the plane it fits best, among the planes known in the neighbourhood
/// of its cell: within the depth tolerance at its range, and not where the cell's own normal says
/// otherwise.
class PixelAssigner {
 public:
  /// @param max_normal_angle between a cell's normal and the plane's [rad]
  PixelAssigner(const geometry::RgbdFrame& frame, const DepthCells& cells,
                const std::vector<CellNormal>& normals, const DepthTolerance& tolerance,
                double near, double far, double max_normal_angle);

  /// @param cell_label where each plane is known to be: the seeds, one per cell.
  /// @param row_step only every so many rows are assigned, for a quick first fit.
  PlanePixels assign(const std::vector<geometry::Plane>& planes,
                     const std::vector<std::int16_t>& cell_label, int row_step = 1) const;

 private:
  struct Candidate;
  void label_pixels(const std::vector<geometry::Plane>& planes,
                    const std::vector<std::int16_t>& cell_label, int row_step,
                    PlanePixels& result) const;
  int candidates_at(int column, int row, const std::vector<geometry::Plane>& planes,
                    const std::vector<std::int16_t>& cell_label, Candidate* candidates) const;
  void label_cell(int column, int row, const Candidate* candidates, int count, int row_step,
                  PlanePixels& result) const;
  void sum_up(std::size_t planes, int row_step, PlanePixels& result) const;
  int distinct_labels(int column, int row, int row_step, const std::vector<std::int16_t>& label,
                      std::array<std::int16_t, DepthCells::kSide * DepthCells::kSide>& labels) const;
  PlaneCell sum_cell(int column, int row, std::int16_t label, int row_step,
                     const PlanePixels& pixels) const;

  const geometry::RgbdFrame& frame_;
  const DepthCells& cells_;
  const std::vector<CellNormal>& normals_;
  double unevenness_;  // tolerance along the normal, beside the rest [m]
  double cosine_;      // of the largest angle between normals
  // Per depth reading [mm]; 0 where it is out of range.
  std::vector<float> inverse_;    // inverse depth [1/m]
  std::vector<float> tolerance_;  // of the inverse depth [1/m]
  std::vector<float> slope_;      // inverse depth per depth: squared inverse [1/m²]
  std::vector<double> weight_;    // 1/σ_z² [1/m²]
};

}  // namespace geomap::perception
