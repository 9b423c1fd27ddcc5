// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "geomap/keyframe_update_t.hpp"
#include "geomap/map_request_t.hpp"
#include "geomap/plane_set_t.hpp"
#include "mapping/geometric_map.hpp"
#include "messaging/config.hpp"
#include "messaging/live_process.hpp"
#include "messaging/sequence_gaps.hpp"

namespace geomap::mapping {

struct MapperConfig {
  MergeConfig merge;
  HistoryConfig history;
};

/// @throws messaging::ConfigError.
MapperConfig read_mapper_config(const messaging::Config& config);

/// @brief geomap-mapper: PLANES in, the geometric map out. Key frames that registration moves or
/// drops are moved and dropped here too.
class MapperProcess {
 public:
  MapperProcess(const MapperConfig& config, messaging::LiveProcess& live);

  const GeometricMap& map() const { return map_; }
  std::string summary() const;

 private:
  void take_planes(const geomap::plane_set_t& message);
  void take_update(const geomap::keyframe_update_t& update);
  void take_request(const geomap::map_request_t& request);
  void apply(const std::string& channel, const MapEvent& event);

  messaging::LiveProcess& live_;
  MapperConfig config_;
  GeometricMap map_;
  messaging::SequenceGaps sequence_;
  bool is_paused_ = false;
};

}  // namespace geomap::mapping
