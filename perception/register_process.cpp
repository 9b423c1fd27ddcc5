// SPDX-License-Identifier: BSD-3-Clause
#include "perception/register_process.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "geomap/keyframe_update_t.hpp"
#include "messaging/log.hpp"
#include "perception/point_map_messages.hpp"

namespace geomap::perception {

namespace channels = messaging::channels;
using messaging::Keep;

RegisterConfig read_register_config(const messaging::Config& config) {
  return {{},
          read_tracker_config(config),
          {config.read<messaging::CameraConfig>("driver_camera.depth").camera(),
           config.read<messaging::CameraConfig>("driver_camera.color").camera()}};
}

RegisterProcess::RegisterProcess(const RegisterConfig& config, messaging::LiveProcess& live)
    : live_(live),
      tracking_(config.tracker, [this](const TrackedFrame& frame) { take_tracked(frame); }),
      sensors_(tracking_, config.cameras) {
  const auto sensor = [this](const std::string& channel, messaging::LiveProcess::Bytes data) {
    take_sensor(channel, data);
  };
  for (const char* frames :
       {channels::kRgbdFrame, channels::kOpenniFrame, channels::kKinectFrame}) {
    live_.on_bytes(frames, Keep::kNewest, sensor);
  }
  live_.on_bytes(channels::kPose, Keep::kEvery, sensor);
  live_.on_bytes(channels::kCameraToBody, Keep::kEvery, sensor);
  live_.on_request([this](const geomap::map_request_t& request) { take_request(request); });
  live_.on<geomap::map_edit_reply_t>(
      channels::kMapEditReply, Keep::kEvery,
      [this](const geomap::map_edit_reply_t& reply) { take_reply(reply); });
  live_.every(1.0, [this] { note_counts(); });
  if (!config.state_folder.empty()) restore(config.state_folder);
}

void RegisterProcess::restore(const std::string& folder) {
  journal_.emplace(folder);
  const KeyframeJournal::Restored restored = journal_->restore(tracking_.tracker());
  tracking_.tracker().take_changed_blocks();
  messaging::log_info(fmt::format("{}: {} key frames restored", folder, restored.keyframes));
  if (restored.refused > 0) {
    messaging::log_warning(
        fmt::format("{}: {} damaged records were passed over", folder, restored.refused));
  }
}

// A full disk must not stop the robot; HEALTH tells.
template <typename Write>
void RegisterProcess::keep(const Write& write) {
  if (!journal_) return;
  try {
    write();
    live_.health().set_trouble(geomap::health_t::GOOD, {});
  } catch (const std::runtime_error& error) {
    live_.health().count("not_kept");
    live_.health().set_trouble(geomap::health_t::FAILING, error.what());
  }
}

void RegisterProcess::finish() {
  tracking_.finish();
  note_counts();
}

void RegisterProcess::take_sensor(const std::string& channel, messaging::LiveProcess::Bytes data) {
  const bool is_frame = channel != channels::kPose && channel != channels::kCameraToBody;
  if (live_.is_paused() && is_frame) {
    live_.health().count("paused.frames");
    return;
  }
  sensors_.handle(channel, data);
  if (live_.bus().config().lossless) note_counts();
}

void RegisterProcess::take_request(const geomap::map_request_t& request) {
  using Request = geomap::map_request_t;
  switch (request.kind) {
    case Request::CLEAR:
      tracking_.tracker().clear();
      keep([this] { journal_->clear(); });
      publish_points(true);
      messaging::log_info("key frames and point map cleared; the pose is kept");
      break;
    case Request::RESET:
      tracking_.reset();
      keep([this] { journal_->clear(); });
      publish_points(true);
      messaging::log_info("reset: the next key frame is the first one");
      break;
    case Request::SNAPSHOT:
      if (request.name.empty() || request.name == channels::kPointMap) publish_points(true);
      break;
    default:
      break;  // the mapper's
  }
}

// The mapper decides on edits; the point map follows.
void RegisterProcess::take_reply(const geomap::map_edit_reply_t& reply) {
  Tracker& tracker = tracking_.tracker();
  geomap::keyframe_update_t update{};
  for (const std::int64_t keyframe : reply.dropped) {
    if (tracker.remove(keyframe)) update.dropped.push_back(keyframe);
  }
  for (const std::int64_t keyframe : reply.restored) {
    if (tracker.put_back(keyframe)) update.restored.push_back(keyframe);
  }
  update.n_dropped = static_cast<std::int32_t>(update.dropped.size());
  update.n_restored = static_cast<std::int32_t>(update.restored.size());
  if (update.n_dropped + update.n_restored == 0) return;
  update.utime = newest_utime_;
  update.session = messages_.session().value_or(0);
  update.epoch = ++epoch_;
  keep([&] { journal_->keep(update); });
  live_.publish(channels::kKeyframeUpdate, update);
  publish_points(true);
}

void RegisterProcess::take_tracked(const TrackedFrame& frame) {
  newest_utime_ = std::max(newest_utime_, frame.message.utime);
  messaging::Health& health = live_.health();
  health.note_utime(newest_utime_);
  health.count("frames");
  if (!frame.tracked.reason.empty()) health.count("refused_frames." + frame.tracked.reason);
  health.time("registration", frame.registration_seconds);
  if (frame.decode_seconds > 0.0) health.time("decode", frame.decode_seconds);
  const bool is_keyframe = frame.tracked.status == TrackStatus::kKeyframe;
  if (is_keyframe) keep([&] { journal_->keep(frame, tracking_.tracker()); });
  messages_.send(frame, [this](const char* channel, std::int64_t, const auto& message) {
    live_.publish(channel, message);
  });
  health.set_session(messages_.session().value_or(0));
  if (!is_keyframe) return;
  health.count("keyframes");
  publish_points(false);
}

void RegisterProcess::publish_points(bool complete) {
  const VoxelMap& voxels = tracking_.tracker().point_map().voxels();
  std::vector<BlockIndex> blocks = tracking_.tracker().take_changed_blocks();
  if (complete) blocks = voxels.blocks();
  for (geomap::point_map_update_t& update : to_messages(voxels, blocks, complete)) {
    update.utime = newest_utime_;
    update.session = messages_.session().value_or(0);
    update.epoch = epoch_;
    update.sequence = ++points_sequence_;
    live_.publish(channels::kPointMap, update);
  }
}

void RegisterProcess::note_counts() {
  messaging::Health& health = live_.health();
  for (const auto& [channel, reasons] : sensors_.refused()) {
    for (const auto& [reason, count] : reasons) {
      health.set("rejected." + channel + "." + reason, count);
    }
  }
  // A frame that a newer one has replaced is missing by its number, but not lost on the way.
  const auto replaced = live_.bus().inbox().replaced();
  const auto found = replaced.find(channels::kRgbdFrame);
  const std::int64_t missing =
      sensors_.missing_frames() - (found == replaced.end() ? 0 : found->second);
  if (missing <= noted_missing_) return;
  live_.note_missing(channels::kRgbdFrame, missing - std::exchange(noted_missing_, missing));
}

std::string RegisterProcess::summary() const {
  return fmt::format("{} key frames in the point map, {} points\n",
                     tracking_.tracker().point_map().keyframes(),
                     tracking_.tracker().point_map().size());
}

}  // namespace geomap::perception
