// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mapper_process.hpp"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "mapping/map_hash.hpp"
#include "messaging/channels.hpp"
#include "messaging/convert_geometry.hpp"
#include "messaging/log.hpp"
#include "messaging/stopwatch.hpp"

namespace geomap::mapping {

namespace channels = messaging::channels;
using messaging::Keep;

MapperConfig read_mapper_config(const messaging::Config& config) {
  return {config.read<MergeConfig>("merge"), config.read<HistoryConfig>("history")};
}

MapperProcess::MapperProcess(const MapperConfig& config, messaging::LiveProcess& live)
    : live_(live), config_(config), map_(config.merge, config.history) {
  live_.on<geomap::plane_set_t>(channels::kPlanes, Keep::kEvery,
                                [this](const geomap::plane_set_t& planes) { take_planes(planes); });
  live_.on<geomap::keyframe_update_t>(
      channels::kKeyframeUpdate, Keep::kEvery,
      [this](const geomap::keyframe_update_t& update) { take_update(update); });
  live_.on<geomap::map_request_t>(
      channels::kMapRequest, Keep::kEvery,
      [this](const geomap::map_request_t& request) { take_request(request); });
}

void MapperProcess::take_planes(const geomap::plane_set_t& message) {
  live_.note_missing(channels::kPlanes, sequence_.note(message.session, message.sequence));
  live_.health().note_utime(message.utime);
  if (is_paused_) {
    live_.health().count("paused.keyframes");
    return;
  }
  auto planes = messaging::from_message(message);
  if (!planes) {
    live_.reject(channels::kPlanes, "bad_plane");
    return;
  }
  auto observation = std::make_shared<Observation>();
  observation->keyframe = planes->keyframe;
  observation->T_world_camera = planes->T_world_camera;
  observation->planes = std::move(planes->planes);
  apply(channels::kPlanes, std::shared_ptr<const Observation>(std::move(observation)));
}

void MapperProcess::take_update(const geomap::keyframe_update_t& update) {
  PoseCorrection correction;
  for (const geomap::pose_correction_t& pose : update.corrections) {
    correction.poses.emplace_back(pose.keyframe, messaging::from_message(pose.T_world_camera));
  }
  if (!correction.poses.empty()) apply(channels::kKeyframeUpdate, correction);
  for (const std::int64_t keyframe : update.removed) {
    apply(channels::kKeyframeUpdate, KeyframeRemoval{keyframe});
  }
}

void MapperProcess::take_request(const geomap::map_request_t& request) {
  using Request = geomap::map_request_t;
  switch (request.kind) {
    case Request::PAUSE:
    case Request::RESUME:
      is_paused_ = request.kind == Request::PAUSE;
      messaging::log_info(is_paused_ ? "paused" : "resumed");
      break;
    case Request::CLEAR:
    case Request::RESET:
      map_ = GeometricMap(config_.merge, config_.history);
      messaging::log_info("map cleared");
      break;
    default:
      live_.reject(channels::kMapRequest, "unknown_kind");
      break;
  }
}

void MapperProcess::apply(const std::string& channel, const MapEvent& event) {
  const messaging::Stopwatch merging;
  const ApplyResult applied = map_.apply(event);
  live_.health().time("merging", merging.seconds());
  if (applied.fault != EventFault::kNone) live_.reject(channel, to_string(applied.fault));
}

std::string MapperProcess::summary() const {
  return fmt::format("{} features of {} key frames\nmap_hash {}\n", map_.features().size(),
                     map_.history().keyframes().size(), map_hash(map_.features()));
}

}  // namespace geomap::mapping
