// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/planar_polygon.hpp"
#include "geometry/rgbd_frame.hpp"
#include "mapping/veto.hpp"
#include "mapping/view_feature.hpp"

namespace geomap::viewer {

using Clock = std::chrono::steady_clock;

/// @brief Grows with every change of a layer; who has drawn it compares.
using Stamp = std::uint64_t;

using Features = std::map<mapping::FeatureId, mapping::ViewFeature>;

/// @brief The geometric map. Of a former mapper until the next one's is complete.
struct MapLayer {
  Features features;
  std::vector<mapping::Veto> vetoes;  // surfaces that are kept out, world frame
  std::int64_t utime = 0;             // id of the newest key frame in it [us]
  std::int64_t epoch = 0;
  std::int64_t revision = 0;
  bool is_current = false;  // nothing is known to be missing
  std::int64_t bytes = 0;   // that came over the link for it
  Stamp stamp = 0;
  Stamp veto_stamp = 0;  // of the vetoes alone
};

struct ScenePoint {
  Eigen::Vector3f position;  // world frame [m]
  std::array<std::uint8_t, 3> color;
  std::uint8_t unused = 0;
};

/// @brief Points of one cube of space, in an order in which any first ones are an even sample.
struct PointBlock {
  std::shared_ptr<const std::vector<ScenePoint>> points;
  Eigen::AlignedBox3d box;
  Stamp stamp = 0;
};
using BlockKey = std::array<std::int32_t, 3>;

/// @brief The point map.
struct PointLayer {
  std::map<BlockKey, PointBlock> blocks;
  std::size_t points = 0;
  Stamp stamp = 0;
};

/// @brief Camera frames: the newest one for the images, and for the live cloud the newest one of
/// which it is known where it was taken, often a few frames older.
struct FrameLayer {
  std::shared_ptr<const geometry::RgbdFrame> newest;  // null before the first one
  std::shared_ptr<const geometry::RgbdFrame> frame;   // of the cloud; null before the first one
  std::optional<Eigen::Isometry3d> T_world_camera;    // of `frame`
  Stamp stamp = 0;
};

/// @brief The planes that were seen in the newest key frame.
struct PlanesLayer {
  std::int64_t keyframe = 0;                    // its id [us]
  std::vector<geometry::PlanarPolygon> planes;  // world frame
  Stamp stamp = 0;
};

/// @brief Where the camera has been.
struct TrackLayer {
  struct Pose {
    std::int64_t utime = 0;  // [us]
    Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  };
  std::vector<Pose> poses;                              // of tracked frames, in order, thinned
  std::map<std::int64_t, Eigen::Isometry3d> keyframes;  // T_world_camera by id [us]
  std::optional<Pose> newest;
  std::optional<Eigen::Isometry3d> T_body_camera;  // from the robot
  std::optional<geometry::CameraModel> camera;
  Stamp stamp = 0;
};

enum class Level { kGood, kDegraded, kFailing };

/// @brief What registration says of the newest key frame, in plain words.
struct RegistrationState {
  Level level = Level::kGood;
  std::string text;         // "ok", "rejected: ...", "lost: ..."; empty before the first
  int rejected_in_row = 0;  // key frames
};

/// @brief HEALTH of one process.
struct ProcessState {
  Level level = Level::kGood;
  std::string message;  // why it is not good
  std::map<std::string, std::int64_t> counters;
  struct Stage {
    std::string name;
    double p50 = 0.0, p95 = 0.0, max = 0.0;  // over the last second with any [s]
    int count = 0;
  };
  std::vector<Stage> stages;
  Clock::time_point heard;
};

/// @brief What comes in on one channel.
struct ChannelState {
  std::int64_t messages = 0, bytes = 0, refused = 0;
  std::int64_t missing = 0;                             // by sequence numbers
  std::int64_t recent_missing = 0, recent_refused = 0;  // of these, in the last minute
  struct Trouble {
    Clock::time_point at;
    std::int64_t missing = 0, refused = 0;  // in all, until then
  };
  std::deque<Trouble> troubles;  // of the last minute, where the numbers have changed
  Clock::time_point last;
  double rate = 0.0;                     // over the last seconds [1/s]
  std::deque<Clock::time_point> recent;  // arrivals, for the rate
};

/// @brief All that the operator can look at. Each layer is replaced by its own messages only: none
/// is ever cleared because another one came, except that an empty point map ends the camera's path.
/// World frame (z up), metres.
struct SceneModel {
  MapLayer map;
  PointLayer points;
  FrameLayer frame;
  PlanesLayer planes;
  TrackLayer track;
  RegistrationState registration;
  std::map<std::string, ProcessState> processes;
  std::map<std::string, ChannelState> channels;
  std::optional<Clock::time_point> heard;  // anything at all
  std::int64_t overflowed = 0;             // messages that this process had no room for

  /// @brief Body pose T_world_body, where the camera's pose and its place on the body are known;
  /// without the latter the point below the camera, heading as the camera does.
  std::optional<Eigen::Isometry3d> T_world_body() const;

  /// @brief Box around points and camera path; empty when there is nothing.
  Eigen::AlignedBox3d track_and_points() const;
  /// @brief The same with the map. Works it out of all polygons each time.
  Eigen::AlignedBox3d bounds() const;
};

}  // namespace geomap::viewer
