// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "geomap/keyframe_update_t.hpp"
#include "geomap/map_request_t.hpp"
#include "geomap/plane_set_t.hpp"
#include "mapping/edit_process.hpp"
#include "mapping/event_journal.hpp"
#include "mapping/geometric_map.hpp"
#include "mapping/map_view_process.hpp"
#include "messaging/config.hpp"
#include "messaging/live_process.hpp"
#include "messaging/sequence_gaps.hpp"

namespace geomap::mapping {

struct MapperConfig {
  MergeConfig merge;
  HistoryConfig history;
  MapViewConfig view;
};

/// @throws messaging::ConfigError.
MapperConfig read_mapper_config(const messaging::Config& config);

/// @brief geomap-mapper: PLANES and operators' edits in, the geometric map and the operator's view
/// of it out. Key frames that registration moves or removes are moved and removed here too. With a
/// journal the map outlives the process.
///
/// MAP_REQUEST SAVE and LOAD are answered as edits are, with MAP_EDIT_REPLY: `command` is the
/// request's utime, `author` its author, `edit` 0, and the text says what was done or why not. A
/// request with utime 0 has no number, and is not answered.
class MapperProcess {
 public:
  /// @param journal not opened yet; null: nothing is stored. @throws as EventJournal::open.
  MapperProcess(const MapperConfig& config, std::unique_ptr<EventJournal> journal,
                messaging::LiveProcess& live);

  /// @brief At the end of the input.
  void finish() { edits_.finish(view_.view()); }

  const GeometricMap& map() const { return map_; }
  std::string summary() const;

 private:
  GeometricMap first_map() const;
  void take_planes(const geomap::plane_set_t& message);
  void take_update(const geomap::keyframe_update_t& update);
  void take_request(const geomap::map_request_t& request);
  void apply(const std::string& channel, const MapEvent& event, ViewCause cause);
  void store(const MapEvent& event);
  void replace_map(GeometricMap map, ViewCause cause);
  void answer(const geomap::map_request_t& request, const std::function<std::string()>& task);
  void acknowledge(const geomap::map_request_t& request, bool is_done, const std::string& text);
  // These return what was done, in words.
  std::string save(const std::string& name);
  std::string load(const std::string& name);
  void publish(const MapChange& change, ViewCause cause);
  void report_trouble();

  messaging::LiveProcess& live_;
  MapperConfig config_;
  std::unique_ptr<EventJournal> journal_;
  GeometricMap map_;
  MapViewPublisher view_;
  EditDesk edits_;
  messaging::SequenceGaps sequence_;
  std::string reported_trouble_;  // of the journal, in HEALTH and log
};

}  // namespace geomap::mapping
