// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "viewer/gl_buffer.hpp"
#include "viewer/palette.hpp"
#include "viewer/scene_model.hpp"

namespace geomap::viewer {

inline constexpr Rgba kPathColor = {0.93F, 0.42F, 0.72F, 1.0F};

/// @brief A path as lines, made longer as poses come in. A very long one is drawn in coarser steps,
/// so that it never has more than 20 000 pieces.
class PathLines {
 public:
  static constexpr std::size_t kMostPieces = 20'000;

  /// @brief Takes the poses that are new; all of them when the earlier ones are others than before.
  /// @return how many vertices, from the first on, are what they were.
  std::size_t follow(const std::vector<TrackLayer::Pose>& poses);

  const std::vector<Vertex>& lines() const { return lines_; }  // relative to the origin
  const Eigen::Vector3d& origin() const { return origin_; }    // world frame
  double step() const { return step_; }                        // shortest piece [m]

 private:
  bool begins_with_taken(const std::vector<TrackLayer::Pose>& poses) const;
  void begin_anew(double step);
  void take(const std::vector<TrackLayer::Pose>& poses);

  std::vector<Vertex> lines_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d end_ = Eigen::Vector3d::Zero();  // of the last piece, world frame
  bool has_origin_ = false;
  TrackLayer::Pose first_, last_;  // of those that were taken
  std::size_t taken_ = 0;
  double length_ = 0.0, step_ = 0.0;  // of all pieces, of one at least [m]
};

}  // namespace geomap::viewer
