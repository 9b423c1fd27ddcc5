// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "geomap/map_edit_reply_t.hpp"
#include "geomap/map_edit_t.hpp"
#include "logs/pipeline_config.hpp"
#include "logs/stage_times.hpp"
#include "mapping/geometric_map.hpp"
#include "mapping/logged_edits.hpp"
#include "perception/plane_extractor.hpp"
#include "perception/tracking_process.hpp"

namespace geomap::logs {

/// @brief One key frame that entered the map.
struct KeyframeRecord {
  std::int64_t id = 0;  // utime [us]
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  std::int64_t pixels = 0;      // of its depth image
  int planes = 0;               // extracted
  int map_features = 0;         // in the map after it
  std::int64_t candidates = 0;  // features of the map that its planes were compared with
  double noise_factor = 1.0;    // of the depth noise model
  StageTimes times;
  perception::RegistrationResult registration;
};

/// @brief Camera pose of a tracked frame, T_world_camera.
using TimedPose = std::pair<std::int64_t, Eigen::Isometry3d>;

/// @brief The whole system in one process: the very classes that the separate processes drive, fed
/// with decoded messages in the order of a log. Its state is a function of those alone; threads
/// only extract the planes of several key frames at once, which are merged in the order of the key
/// frames.
class Pipeline {
 public:
  /// @brief Called after each key frame has been merged, in the caller's thread.
  using KeyframeListener = std::function<void(const KeyframeRecord&, const mapping::Observation&,
                                              const mapping::MapChange&)>;

  /// @brief Called for each frame once it has been tracked.
  using TrackListener = std::function<void(const perception::TrackedFrame&)>;

  /// @param threads at least 1; beyond 1, that many key frames are extracted at the same time.
  /// @throws std::invalid_argument when a setting is not valid.
  Pipeline(const PipelineConfig& config, int threads);

  void on_keyframe(KeyframeListener listener) { listener_ = std::move(listener); }

  void on_tracked(TrackListener listener) { track_listener_ = std::move(listener); }

  /// @brief Where the input goes.
  perception::TrackingProcess& tracking() { return tracking_; }
  /// @brief An operator's command of the log, and what was answered to it then: the reply says
  /// behind which key frame the edit has its place, and which key frames left the point map.
  void add_edit(const geomap::map_edit_t& message);
  void add_edit_reply(const geomap::map_edit_reply_t& message);
  /// @brief Processes what still waits for a prior or an extraction. Call at the end of the input.
  void finish();

  std::int64_t frames() const { return tracking_.frames(); }
  std::int64_t edits() const { return edits_; }
  const std::vector<KeyframeRecord>& keyframes() const { return keyframes_; }
  /// @brief Frames that could not become key frames, by reason.
  const std::map<std::string, std::int64_t>& rejected() const { return rejected_; }
  const std::vector<TimedPose>& tracked() const { return tracked_; }
  const mapping::GeometricMap& map() const { return map_; }
  const perception::PointMap& point_map() const { return tracker().point_map(); }
  const perception::Tracker& tracker() const { return tracking_.tracker(); }

 private:
  struct Extraction {
    KeyframeRecord record;
    std::future<perception::ExtractedPlanes> planes;
  };

  void take(perception::TrackedFrame frame);
  void start_extraction(KeyframeRecord record, geometry::RgbdFrame frame);
  void merge_oldest();
  void edit(const mapping::LoggedEdits::Placed& placed);

  PipelineConfig config_;
  std::size_t threads_;
  perception::TrackingProcess tracking_;
  std::unique_ptr<perception::PlaneExtractor> extractor_;
  mapping::GeometricMap map_;
  mapping::LoggedEdits logged_edits_;
  std::int64_t edits_ = 0;  // that were done

  std::deque<Extraction> extractions_;  // in the order of the key frames
  KeyframeListener listener_;
  TrackListener track_listener_;

  std::vector<KeyframeRecord> keyframes_;
  std::map<std::string, std::int64_t> rejected_;
  std::vector<TimedPose> tracked_;
};

}  // namespace geomap::logs
