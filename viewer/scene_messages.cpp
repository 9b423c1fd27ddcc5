// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene_messages.hpp"

#include <algorithm>
#include <utility>

#include "geomap/keyframe_update_t.hpp"
#include "geomap/map_delta_t.hpp"
#include "geomap/map_t.hpp"
#include "mapping/clean_text.hpp"
#include "messaging/channels.hpp"
#include "messaging/convert_geometry.hpp"
#include "messaging/safe_decode.hpp"
#include "viewer/channel_counts.hpp"
#include "viewer/health_messages.hpp"
#include "viewer/registration_messages.hpp"
#include "viewer/sound_geometry.hpp"

namespace geomap::viewer {
namespace {

namespace channels = messaging::channels;
using namespace std::chrono_literals;

constexpr auto kRequestPeriod = 1s;  // between requests
constexpr auto kForgetting = 10min;  // silence of a process, while others are heard
constexpr std::size_t kMostReplies = 1000, kMostProcesses = 100;

}  // namespace

SceneMessages::SceneMessages(std::function<void(const char* channel)> ask)
    : ask_(std::move(ask)), map_([this] { ask_(messaging::channels::kMapSnapshot); }) {
  subscribe_to_mapping();
  subscribe_to_registration();
}

template <class Message, class Handler>
void SceneMessages::on(const char* channel, Handler handler) {
  handlers_[channel] = [handler](Bytes data, const Arrival& arrival) {
    const auto decoded = messaging::safe_decode<Message>(data.data(), data.size());
    if (!decoded.message) return Taken::kRefused;
    return handler(*decoded.message, arrival);
  };
}

void SceneMessages::subscribe_to_mapping() {
  on<geomap::map_delta_t>(channels::kMapDelta, [this](const auto& message, const Arrival& arrival) {
    return take_map(message, arrival);
  });
  on<geomap::map_t>(channels::kMapSnapshot, [this](const auto& message, const Arrival& arrival) {
    return take_map(message, arrival);
  });
  on<geomap::map_edit_record_t>(channels::kMapEditRecord,
                                [this](const auto& message, const Arrival& arrival) {
                                  return records_.take(message, arrival.now);
                                });
  on<geomap::map_edit_reply_t>(
      channels::kMapEditReply,
      [this](const auto& message, const Arrival&) { return take_reply(message); });
  on<geomap::health_t>(channels::kHealth, [this](const auto& message, const Arrival& arrival) {
    return take_health(message, arrival);
  });
}

void SceneMessages::subscribe_to_registration() {
  on<geomap::point_map_update_t>(channels::kPointMap,
                                 [this](const auto& message, const Arrival& arrival) {
                                   return take_points(message, arrival);
                                 });
  on<geomap::keyframe_t>(channels::kKeyframe, [this](const auto& message, const Arrival& arrival) {
    return take_keyframe(message, arrival);
  });
  on<geomap::keyframe_update_t>(channels::kKeyframeUpdate,
                                [this](const auto& message, const Arrival& arrival) {
                                  return track_.take_update(message, arrival.scene.track);
                                });
  on<bot_core::rigid_transform_t>(
      channels::kCameraPose,
      [this](const auto& message, const Arrival& arrival) { return take_pose(message, arrival); });
  on<bot_core::rigid_transform_t>(channels::kCameraToBody,
                                  [this](const auto& message, const Arrival& arrival) {
                                    return track_.take_camera_to_body(message, arrival.scene.track);
                                  });
  on<geomap::rgbd_frame_t>(
      channels::kRgbdFrame,
      [this](const auto& message, const Arrival& arrival) { return take_frame(message, arrival); });
  on<geomap::plane_set_t>(channels::kPlanes, [this](const auto& message, const Arrival& arrival) {
    return take_planes(message, arrival);
  });
}

std::vector<std::string> SceneMessages::channels() const {
  std::vector<std::string> names;
  for (const auto& [channel, handler] : handlers_) names.push_back(channel);
  return names;
}

bool SceneMessages::take(const std::string& channel, Bytes data, Clock::time_point now,
                         SceneModel& scene) {
  const auto handler = handlers_.find(channel);
  if (handler == handlers_.end()) return false;
  ChannelState& state = scene.channels[channel];
  note_arrival(data.size(), now, state);
  scene.heard = now;
  Taken taken = Taken::kRefused;
  try {
    taken = handler->second(data, {now, scene, data.size()});
  } catch (const std::exception&) {
    // What the checks before have let through, such as a message that memory does not suffice for.
  }
  if (taken == Taken::kRefused) ++state.refused;
  return taken == Taken::kChange;
}

template <class Message>
Taken SceneMessages::take_map(const Message& message, const Arrival& arrival) {
  const std::int64_t refused = map_.refused();
  map_.take(message, arrival.now);
  arrival.scene.map.bytes += static_cast<std::int64_t>(arrival.bytes);
  if (show_map(arrival.scene)) return Taken::kChange;
  return map_.refused() > refused ? Taken::kRefused : Taken::kNothing;
}

bool SceneMessages::show_map(SceneModel& scene) {
  const mapping::MapView& view = map_.view();
  if (view.epoch == 0) return false;  // nothing has come yet
  MapLayer& layer = scene.map;
  const bool is_current = map_.is_current();
  const bool is_changed = std::exchange(shown_changes_, map_.changes()) != map_.changes();
  if (!is_changed && layer.is_current == is_current) return false;
  layer.is_current = is_current;
  ++layer.stamp;
  if (!is_changed) return true;
  layer.features = view.features;
  for (auto& [id, feature] : layer.features) feature.label = mapping::clean_text(feature.label);
  layer.utime = view.utime;
  layer.epoch = view.epoch;
  layer.revision = view.revision;
  return true;
}

bool SceneMessages::show_records(SceneModel& scene) {
  if (!records_.show()) return false;
  scene.map.vetoes = records_.vetoes();
  ++scene.map.veto_stamp;
  ++scene.map.stamp;
  return true;
}

Taken SceneMessages::take_reply(const geomap::map_edit_reply_t& message) {
  replies_.push_back({message.author,
                      {.command = message.command,
                       .is_done = message.done != 0,
                       .text = mapping::clean_text(message.text),
                       .edit = message.edit,
                       .revision = message.revision}});
  if (replies_.size() > kMostReplies) replies_.erase(replies_.begin());
  return Taken::kNothing;
}

std::vector<EditReply> SceneMessages::take_replies() { return std::exchange(replies_, {}); }

Taken SceneMessages::take_points(const geomap::point_map_update_t& message,
                                 const Arrival& arrival) {
  const Taken taken = points_.take(message, arrival.now, arrival.scene.points);
  arrival.scene.channels[channels::kPointMap].missing = points_.missing();
  const bool is_empty = message.complete != 0 && message.n_blocks == 0;
  if (taken == Taken::kChange && is_empty) track_.note_empty_map(arrival.scene.track);
  return taken;
}

Taken SceneMessages::take_keyframe(const geomap::keyframe_t& message, const Arrival& arrival) {
  SceneModel& scene = arrival.scene;
  if (note_registration(message, scene.registration) == Taken::kRefused) {
    return Taken::kRefused;
  }
  const Taken taken = track_.take_keyframe(message, scene.track);
  if (taken == Taken::kRefused) return taken;
  note_missing(channels::kKeyframe,
               gaps_[channels::kKeyframe].gaps.note(message.session, message.sequence), scene);
  if (taken == Taken::kChange) {
    frames_.offer(channels::kKeyframe, message.frame, scene.track.keyframes.at(message.utime));
  }
  return Taken::kChange;
}

Taken SceneMessages::take_pose(const bot_core::rigid_transform_t& message, const Arrival& arrival) {
  const Taken taken = track_.take_pose(message, arrival.scene.track);
  if (taken == Taken::kChange) frames_.note_pose(message.utime, messaging::from_message(message));
  return taken;
}

Taken SceneMessages::take_frame(const geomap::rgbd_frame_t& message, const Arrival& arrival) {
  frames_.offer(channels::kRgbdFrame, message, std::nullopt);
  note_missing(channels::kRgbdFrame, gaps_[channels::kRgbdFrame].gaps.note(message.sequence),
               arrival.scene);
  return Taken::kNothing;
}

Taken SceneMessages::take_planes(const geomap::plane_set_t& message, const Arrival& arrival) {
  const auto planes = messaging::from_message(message);
  if (!planes || !is_sound(planes->T_world_camera)) return Taken::kRefused;
  std::vector<geometry::PlanarPolygon> surfaces;
  for (const geometry::PlaneObservation& plane : planes->planes) {
    if (!is_sound(plane.surface)) return Taken::kRefused;
    surfaces.push_back(plane.surface.transformed(planes->T_world_camera));
  }
  PlanesLayer& layer = arrival.scene.planes;
  layer.keyframe = planes->keyframe;
  layer.planes = std::move(surfaces);
  ++layer.stamp;
  note_missing(channels::kPlanes,
               gaps_[channels::kPlanes].gaps.note(message.session, message.sequence),
               arrival.scene);
  return Taken::kChange;
}

Taken SceneMessages::take_health(const geomap::health_t& message, const Arrival& arrival) {
  const std::string process = mapping::clean_text(message.process);
  auto& processes = arrival.scene.processes;
  if (!processes.contains(process) && processes.size() >= kMostProcesses) return Taken::kRefused;
  const auto known = started_.find(process);
  if (known == started_.end() || known->second != message.started) {
    started_.insert_or_assign(process, message.started);
    processes[process] = {};
    note_start(process, arrival.now);
  }
  viewer::take_health(message, arrival.now, processes[process]);
  return Taken::kChange;
}

// A process that was started anew begins to count anew, and may hold what it does not send unasked.
void SceneMessages::note_start(const std::string& process, Clock::time_point now) {
  if (process == "geomap-register") points_.note_loss();
  if (process != "geomap-mapper") return;
  ask(channels::kMapSnapshot, now);
  ask(channels::kMapEditRecord, now);
}

void SceneMessages::ask_for_all(Clock::time_point now) {
  points_.note_loss();
  ask(channels::kMapSnapshot, now);
  ask(channels::kMapEditRecord, now);
}

void SceneMessages::ask(const char* channel, Clock::time_point now) {
  const auto asked = asked_.find(channel);
  if (asked != asked_.end() && now - asked->second < kRequestPeriod) return;
  asked_.insert_or_assign(channel, now);
  ask_(channel);
}

bool SceneMessages::poll(Clock::time_point now, SceneModel& scene) {
  map_.poll(now);
  const bool is_map_new = show_map(scene);
  const bool is_history_new = show_records(scene);
  if (points_.should_ask(now)) ask_(channels::kPointMap);
  const std::int64_t epoch = map_.view().epoch;
  if (epoch != 0 && !records_.is_whole(epoch)) ask(channels::kMapEditRecord, now);
  for (auto& [name, channel] : scene.channels) {
    update_rate(now, channel);
    update_troubles(now, channel);
  }
  forget_silent(scene);
  return points_.drop_outdated(now, scene.points) || is_map_new || is_history_new;
}

// While nothing at all is heard, as of a log that pauses, nobody is more silent than the others.
void SceneMessages::forget_silent(SceneModel& scene) {
  std::erase_if(scene.processes, [&](const auto& process) {
    const bool is_silent = scene.heard && *scene.heard - process.second.heard > kForgetting;
    if (is_silent) started_.erase(process.first);
    return is_silent;
  });
}

void SceneMessages::note_missing(const std::string& channel, std::int64_t messages,
                                 SceneModel& scene) {
  Gaps& gaps = gaps_[channel];
  gaps.missing += messages;
  scene.channels[channel].missing = std::max<std::int64_t>(0, gaps.missing - gaps.left_out);
}

void SceneMessages::note_left_out(const std::string& channel, std::int64_t messages,
                                  SceneModel& scene) {
  gaps_[channel].left_out = messages;
  note_missing(channel, 0, scene);
}

}  // namespace geomap::viewer
