// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map_view_process.hpp"

#include <algorithm>

#include "mapping/map_view_messages.hpp"
#include "messaging/channels.hpp"

namespace geomap::mapping {
namespace {

namespace channels = messaging::channels;

constexpr double kLookPeriod = 0.25;  // whether a snapshot is due [s]
// Between two snapshots, times what the link needs for one.
constexpr double kWhenRequested = 1.5;
constexpr double kUnasked = 4.0;

}  // namespace

std::vector<std::string> MapViewConfig::validate() const {
  std::vector<std::string> messages;
  if (!(snapshot_period >= 0.5 && snapshot_period <= 3600.0)) {
    messages.emplace_back("snapshot_period must be between 0.5 and 3600 s");
  }
  if (!(kbit_per_s >= 8.0 && kbit_per_s <= 1e6)) {
    messages.emplace_back("kbit_per_s must be between 8 and 1000000");
  }
  if (!(tolerance.distance > 0.0)) messages.emplace_back("view_distance must be positive");
  if (!(tolerance.area_share > 0.0)) messages.emplace_back("view_area_share must be positive");
  return messages;
}

MapViewPublisher::MapViewPublisher(const MapViewConfig& config, const GeometricMap& map,
                                   messaging::LiveProcess& live)
    : live_(live), config_(config) {
  view_.epoch = live_.health().started();
  if (!map.features().empty()) {
    apply(delta_of(map, difference({}, map.features()), ViewCause::kLoad), view_);
  }
  live_.every(kLookPeriod, [this] { publish_due_snapshot(); });
}

void MapViewPublisher::publish(const GeometricMap& map, const MapChange& change, ViewCause cause) {
  const ViewDelta delta = delta_of(map, change, cause);
  for (const geomap::map_delta_t& part : to_messages(delta, view_)) {
    live_.publish(channels::kMapDelta, part);
  }
  apply(delta, view_);
}

ViewDelta MapViewPublisher::delta_of(const GeometricMap& map, const MapChange& change,
                                     ViewCause cause) const {
  ViewDelta delta = delta_after(view_, map.features(), change, config_.tolerance);
  const EventHistory::Keyframes& keyframes = map.history().keyframes();
  delta.utime =
      keyframes.empty() ? map.history().forgotten_through().value_or(0) : keyframes.rbegin()->first;
  delta.cause = cause;
  return delta;
}

void MapViewPublisher::publish_due_snapshot() {
  const Clock::time_point now = Clock::now();
  const std::chrono::duration<double> age = now - published_;
  const double due = is_requested_ ? kWhenRequested * carried_in_
                                   : std::max(config_.snapshot_period, kUnasked * carried_in_);
  if (age.count() < due) return;
  is_requested_ = false;
  published_ = now;
  carried_in_ = 0.0;
  for (const geomap::map_t& part : to_messages(view_)) {
    live_.publish(channels::kMapSnapshot, part);
    carried_in_ += 8e-3 * part.getEncodedSize() / config_.kbit_per_s;
  }
}

}  // namespace geomap::mapping
