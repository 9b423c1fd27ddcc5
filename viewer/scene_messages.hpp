// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "bot_core/rigid_transform_t.hpp"
#include "geomap/health_t.hpp"
#include "geomap/keyframe_t.hpp"
#include "geomap/map_edit_record_t.hpp"
#include "geomap/map_edit_reply_t.hpp"
#include "geomap/plane_set_t.hpp"
#include "geomap/point_map_update_t.hpp"
#include "geomap/rgbd_frame_t.hpp"
#include "mapping/map_client.hpp"
#include "messaging/sequence_gaps.hpp"
#include "viewer/edit_record_messages.hpp"
#include "viewer/frame_messages.hpp"
#include "viewer/map_source.hpp"
#include "viewer/point_layer_messages.hpp"
#include "viewer/scene_model.hpp"
#include "viewer/taken.hpp"
#include "viewer/track_messages.hpp"

namespace geomap::viewer {

/// @brief What a mapper has answered to somebody.
struct EditReply {
  std::string author;
  Outcome outcome;
};

/// @brief Makes a scene out of messages, in whatever order they come. Trusts none of them: what is
/// not sound is counted as refused, and nothing is thrown.
class SceneMessages {
 public:
  using Bytes = std::span<const std::uint8_t>;

  /// @param ask asks whoever sends a channel (MAP_SNAPSHOT, MAP_EDIT_RECORD or POINT_MAP) for all
  /// of it. Called about once a second for each at most.
  explicit SceneMessages(std::function<void(const char* channel)> ask);
  SceneMessages(const SceneMessages&) = delete;
  SceneMessages& operator=(const SceneMessages&) = delete;

  /// @brief Takes a message over. Images are not decoded yet.
  /// @return true when a layer has changed.
  bool take(const std::string& channel, Bytes data, Clock::time_point now, SceneModel& scene);
  /// @brief To be called several times a second: asks for what is missing, shows the edits that
  /// have come, and keeps rates up to date. @return true when a layer has changed.
  bool poll(Clock::time_point now, SceneModel& scene);
  /// @brief Decodes what is to be seen of the newest images. @return true when there is something.
  bool show_newest_frame(SceneModel& scene) { return frames_.show(scene); }

  /// @brief After a silence, in which anything may have happened.
  void ask_for_all(Clock::time_point now);

  const std::vector<HistoryEntry>& history() const { return records_.history(); }
  std::vector<EditReply> take_replies();
  /// @brief The mapper's view, for the epoch and key frame that an edit speaks of.
  const mapping::MapView& view() const { return map_.view(); }

  /// @brief Messages of a channel that the receiver itself has left out, in all: these are missing
  /// by their numbers, but not lost.
  void note_left_out(const std::string& channel, std::int64_t messages, SceneModel& scene);

  /// @brief The channels that it understands.
  std::vector<std::string> channels() const;

 private:
  struct Arrival {
    Clock::time_point now;
    SceneModel& scene;
    std::size_t bytes;
  };
  struct Gaps {
    messaging::SequenceGaps gaps;
    std::int64_t missing = 0, left_out = 0;
  };

  template <class Message, class Handler>
  void on(const char* channel, Handler handler);
  void subscribe_to_mapping();
  void subscribe_to_registration();

  template <class Message>
  Taken take_map(const Message& message, const Arrival& arrival);
  bool show_map(SceneModel& scene);
  bool show_records(SceneModel& scene);
  Taken take_reply(const geomap::map_edit_reply_t& message);
  Taken take_points(const geomap::point_map_update_t& message, const Arrival& arrival);
  Taken take_keyframe(const geomap::keyframe_t& message, const Arrival& arrival);
  Taken take_pose(const bot_core::rigid_transform_t& message, const Arrival& arrival);
  Taken take_frame(const geomap::rgbd_frame_t& message, const Arrival& arrival);
  Taken take_planes(const geomap::plane_set_t& message, const Arrival& arrival);
  Taken take_health(const geomap::health_t& message, const Arrival& arrival);
  void note_start(const std::string& process, Clock::time_point now);
  void ask(const char* channel, Clock::time_point now);
  void forget_silent(SceneModel& scene);
  void note_missing(const std::string& channel, std::int64_t messages, SceneModel& scene);

  std::function<void(const char* channel)> ask_;
  std::map<std::string, std::function<Taken(Bytes, const Arrival&)>> handlers_;  // by channel
  std::map<std::string, Clock::time_point> asked_;                               // by channel
  mapping::MapClient map_;
  std::uint64_t shown_changes_ = 0;  // of map_
  EditRecords records_;
  std::vector<EditReply> replies_;
  PointUpdates points_;
  TrackUpdates track_;
  RecentFrames frames_;
  std::map<std::string, std::int64_t> started_;  // by process
  std::map<std::string, Gaps> gaps_;             // by channel
};

}  // namespace geomap::viewer
