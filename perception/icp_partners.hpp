// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "perception/icp_loops.hpp"
#include "perception/icp_sums.hpp"
#include "perception/surface_image.hpp"
#include "perception/surfel.hpp"

namespace geomap::perception {

/// @brief Surfels as columns of numbers, so that several are worked on at a time, and what a view
/// shows of them. World frame, metres.
class IcpPartners {
 public:
  /// @param stride 4: every fourth surfel.
  explicit IcpPartners(const std::vector<Surfel>& surfels, std::size_t stride = 1);

  /// @brief Leaves out surfels that fall more than `border` pixels outside the image, or lie behind
  /// the camera.
  void keep_in_view(const geometry::CameraModel& camera, const Eigen::Isometry3d& T_world_camera,
                    double border);

  /// @brief Finds partners of the surfels among the pixels onto which they fall, no farther than
  /// `gate` along the surfel's normal [m], normals no farther apart than `least_cosine` tells.
  /// @return sums over the partners. They run over eight interleaved parts, whatever the processor.
  IcpSums match(const SurfaceImage& view, const Eigen::Isometry3d& T_world_camera, double gate,
                double least_cosine);

  /// @brief Pixels of the last match's partners, row by row.
  std::vector<int> pixels() const;
  /// @brief Squared differences of the normals of the last match's partners, of every fourth
  /// surfel.
  std::vector<double> squared_normal_differences() const;

 private:
  enum Column : std::size_t { kPosition = 0, kNormal = 3, kCosine = 6, kColumns = 7 };

  double* column(std::size_t which, std::size_t first = 0) {
    return values_.data() + which * height_ + first;
  }
  InColumns three(std::size_t which, std::size_t first = 0) {
    return {column(which, first), column(which + 1, first), column(which + 2, first)};
  }
  std::size_t whole_groups() const;
  void fill_last_group();

  std::size_t size_ = 0;
  std::size_t height_ = 0;           // of a column
  std::vector<double> values_;       // column by column
  std::vector<std::int32_t> pixel_;  // of the last match: index in the view, one beyond for none
};

}  // namespace geomap::perception
