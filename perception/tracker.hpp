// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "perception/depth_correction_estimator.hpp"
#include "perception/icp_registration.hpp"
#include "perception/keyframe_selector.hpp"
#include "perception/point_map.hpp"
#include "perception/pose_prior.hpp"
#include "perception/registration.hpp"
#include "perception/trust_prior.hpp"

namespace geomap::perception {

struct RegistrationConfig {
  std::string method = "icp";  // "icp", or "prior": poses are taken as they come
  int min_readings = 20;       // pixels of a thin frame with depth; fewer: the frame is blind
  IcpRegistrationConfig icp;
  int lost_after = 10;         // rejections in a row that mean the camera is lost
  int places = 8;              // key frames at whose poses each frame of a lost camera is tried
  double found_overlap = 0.5;  // of the view, before a lost camera counts as found
  // How far from the last key frame odometry is followed into what the map does not know.
  double unknown_step = 0.5;       // [m]
  double unknown_turn_deg = 30.0;  // [deg]

  std::vector<std::string> validate() const;

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& visitor) {
    visitor("method", self.method);
    visitor("min_readings", self.min_readings);
    IcpRegistrationConfig::visit(self.icp, visitor);
    visitor("lost_after", self.lost_after);
    visitor("places", self.places);
    visitor("found_overlap", self.found_overlap);
    visitor("unknown_step", self.unknown_step);
    visitor("unknown_turn_deg", self.unknown_turn_deg);
  }
};

/// @brief One member per section of the settings.
struct TrackerConfig {
  PriorConfig prior;
  KeyframeConfig keyframes;
  RegistrationConfig registration;
  DepthCorrectionConfig depth_correction;
  PointMapConfig point_map;
};

/// @brief What became of a frame.
enum class TrackStatus {
  kKeyframe,  // registered and in the point map
  kTracked,   // its pose is known; it is too near the last key frame to add anything
  kRejected,  // registration refused it; its pose is the prior's, mended as far as the view tells
  kLost,      // the camera is lost; it was looked for and not found
  kNoPrior,   // nothing is known of its pose, and nothing to align it to
  kNoImage,   // the image could not be had
  kRepeated,  // a key frame of this utime is in the map already
};

/// @brief One frame after tracking.
struct Tracked {
  TrackStatus status = TrackStatus::kNoPrior;
  std::string
      reason;  // of a rejection, stable: of PriorReason, RegistrationReason or "out_of_range"
  std::optional<Eigen::Isometry3d> T_world_camera;  // where it is known
  std::optional<RegistrationResult> registration;   // where one was made
};

/// @brief What a tracker has met on its way.
struct TrackerCounts {
  std::int64_t lost = 0;            // times that the camera was lost
  std::int64_t relocalised = 0;     // and found again
  std::int64_t relinked = 0;        // odometry that jumped, restarted or came late, tied in anew
  std::int64_t time_went_back = 0;  // frames older than the one before
  std::int64_t corrections = 0;     // better depth corrections
  std::int64_t refreshed = 0;       // key frames that the point map holds with a better one since
};

/// @brief The paper's section on registration as one object: prior, key frame?, frustum ICP, point
/// map, for one frame after the other. It owns every key frame's pose and the point map.
///
/// With POSE a frame is registered when the prior says that it is due as a key frame. Without, the
/// motion since the last two tracked frames goes on (constant velocity), and every frame is
/// registered. The first accepted frame fixes the world: at its prior, or without any POSE at the
/// configured camera on a body at the origin.
///
/// Through a doorway a view may show hardly anything that the map knows: with odometry that holds,
/// its pose is taken, up to `unknown_step` from the last key frame.
///
/// After `lost_after` rejections in a row the camera is lost: nothing enters the map, and each
/// frame is aligned from the prior and from the poses of key frames until one fits well.
class Tracker {
 public:
  /// @throws std::invalid_argument when the configuration is not valid.
  explicit Tracker(const TrackerConfig& config = {});

  PosePrior& prior() { return prior_; }
  const PosePrior& prior() const { return prior_; }

  /// @brief Gives the image of the frame when it is needed; nullptr when it cannot be had.
  using Image = std::function<const geometry::RgbdFrame*()>;

  /// @brief The next frame, whose prior is ready.
  Tracked track(std::int64_t utime, const Image& image);

  /// @brief Takes a key frame out of the point map again. @return false when there is none.
  bool remove(std::int64_t keyframe);
  /// @brief Puts a removed key frame in again, as it was. @return false when none of this id was
  /// removed.
  bool put_back(std::int64_t keyframe);

  /// @brief Goes on from a key frame of an earlier tracker, as if this one had accepted it. Given
  /// all of them in their order, the point map is the same to the last bit.
  /// @param thin what that point map kept of it (PointMap::thin_frame_of)
  /// @throws std::invalid_argument as PointMap::insert().
  void restore(std::int64_t keyframe, const geometry::RgbdFrame& thin,
               const Eigen::Isometry3d& T_world_camera);
  /// @brief The correction of the odometry that goes with it.
  void restore_odometry(const Eigen::Isometry3d& T_world_odom);

  /// @brief Takes all key frames out of the point map; the odometry stays tied to the world.
  void clear();

  bool is_lost() const { return lost_; }
  const PointMap& point_map() const { return point_map_; }
  /// @brief Blocks of the point map that have changed since the last call.
  std::vector<BlockIndex> take_changed_blocks() { return point_map_.take_changed_blocks(); }
  const TrackerCounts& counts() const { return counts_; }
  /// @brief What the views say of the camera's depth error.
  const DepthCorrectionEstimator& depth_correction_estimator() const { return correction_; }

 private:
  struct Start {
    Eigen::Isometry3d T_world_camera;
    PriorSource source;
  };
  struct Pose {
    std::int64_t utime;
    Eigen::Isometry3d T_world_camera;
  };
  struct KeyframeSurfaces {
    std::int64_t id;
    Eigen::Isometry3d T_world_camera;
    SurfaceImage surfaces;
    geometry::DepthCorrection correction;  // that they were made with
  };

  struct RemovedKeyframe {
    geometry::RgbdFrame thin;
    Eigen::Isometry3d T_world_camera;
  };

  std::optional<Start> start_of(const Prior& prior, std::int64_t utime) const;
  Eigen::Isometry3d continued_motion(std::int64_t utime) const;
  RegistrationResult register_view(const FrameView& view, const Start& start) const;
  bool is_new_ground(const RegistrationResult& result, const Start& start) const;
  RegistrationResult relocalise(const FrameView& view, const Start& start) const;
  Tracked reject(std::int64_t utime, const Start& start, RegistrationResult result);
  Tracked take(std::int64_t utime, const Prior& prior, FrameView view, RegistrationResult result);
  void insert(std::int64_t utime, FrameView view, const Eigen::Isometry3d& T_world_camera);
  void improve_depth_correction();
  void note_time(std::int64_t utime);
  void note_pose(std::int64_t utime, const Eigen::Isometry3d& T_world_camera);
  void link_odometry(const Prior& prior, const Eigen::Isometry3d& T_world_camera);
  std::int64_t odometry_breaks() const;
  bool aligns() const { return config_.registration.method == "icp"; }

  TrackerConfig config_;
  PosePrior prior_;
  KeyframeSelector selector_;
  std::unique_ptr<Registration> registration_;
  DepthCorrectionEstimator correction_;
  PointMap point_map_;

  std::optional<std::int64_t> last_utime_;
  std::deque<Pose> recent_;      // the last two tracked frames
  std::vector<Pose> keyframes_;  // in the order they were accepted
  std::map<std::int64_t, RemovedKeyframe> removed_;
  std::deque<KeyframeSurfaces> surfaces_;  // of the last key frames, newest first
  bool linked_ = false;                    // T_world_odom holds for the odometry as it is now
  std::int64_t breaks_ = 0;                // of odometry, when it was linked
  int rejections_ = 0;                     // in a row
  bool lost_ = false;
  TrackerCounts counts_;
};

}  // namespace geomap::perception
