// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "mapping/geometric_map.hpp"
#include "mapping/map_view.hpp"
#include "messaging/live_process.hpp"

namespace geomap::mapping {

/// @brief What the operator is sent.
struct MapViewConfig {
  double snapshot_period = 5.0;  // between two MAP_SNAPSHOT [s]
  double kbit_per_s = 200.0;     // that the link carries; snapshots leave room for the rest
  ViewTolerance tolerance;

  std::vector<std::string> validate() const;

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& visitor) {
    visitor("snapshot_period", self.snapshot_period);
    visitor("kbit_per_s", self.kbit_per_s);
    visitor("view_distance", self.tolerance.distance);
    visitor("view_area_share", self.tolerance.area_share);
  }
};

/// @brief Publishes the map as the operator sees it: MAP_DELTA with every change, MAP_SNAPSHOT
/// every few seconds and on request.
class MapViewPublisher {
 public:
  /// @param map what is there already: whoever follows needs a snapshot first.
  MapViewPublisher(const MapViewConfig& config, const GeometricMap& map,
                   messaging::LiveProcess& live);

  /// @brief Tells what a change has made of the map.
  void publish(const GeometricMap& map, const MapChange& change, ViewCause cause);
  /// @brief The next one comes within a quarter of a second, or as soon as the link has carried the
  /// one before, however many ask.
  void request_snapshot() { is_requested_ = true; }

  const MapView& view() const { return view_; }

 private:
  using Clock = std::chrono::steady_clock;

  ViewDelta delta_of(const GeometricMap& map, const MapChange& change, ViewCause cause) const;
  void publish_due_snapshot();

  messaging::LiveProcess& live_;
  MapViewConfig config_;
  MapView view_;
  bool is_requested_ = true;
  Clock::time_point published_;
  double carried_in_ = 0.0;  // the newest snapshot, by the link [s]
};

}  // namespace geomap::mapping
