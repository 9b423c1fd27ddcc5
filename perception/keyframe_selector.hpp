// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

namespace geomap::perception {

/// @brief How far the camera moves between key frames.
struct KeyframeConfig {
  double min_translation = 0.10;  // [m]
  double min_rotation_deg = 5.0;  // [deg]

  std::vector<std::string> validate() const;

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& visitor) {
    visitor("min_translation", self.min_translation);
    visitor("min_rotation_deg", self.min_rotation_deg);
  }
};

/// @brief Picks the frames worth adding to the map: those from which the camera has moved or turned
/// enough since the last accepted key frame. A key frame that registration rejects is not accepted,
/// so the next frame is due again.
class KeyframeSelector {
 public:
  /// @throws std::invalid_argument when the configuration is not valid.
  explicit KeyframeSelector(const KeyframeConfig& config = {});

  /// @brief True for the first frame, and when either threshold is reached.
  bool is_due(const Eigen::Isometry3d& T_world_camera) const;

  /// @brief Makes this pose the one that later frames are compared with.
  void accept(const Eigen::Isometry3d& T_world_camera);

  /// @brief Forgets the last key frame: the next frame is the first again.
  void reset() { last_.reset(); }

 private:
  KeyframeConfig config_;
  std::optional<Eigen::Isometry3d> last_;  // T_world_camera
};

}  // namespace geomap::perception
