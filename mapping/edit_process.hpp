// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "geomap/map_edit_record_t.hpp"
#include "geomap/map_edit_reply_t.hpp"
#include "geomap/map_edit_t.hpp"
#include "mapping/geometric_map.hpp"
#include "mapping/logged_edits.hpp"
#include "mapping/map_view.hpp"
#include "messaging/live_process.hpp"

namespace geomap::mapping {

/// @brief The mapper's desk for operators' commands: MAP_EDIT in, MAP_EDIT_REPLY and
/// MAP_EDIT_RECORD out.
///
/// In a lossless process, which replays a log, an edit waits for the log's own reply, which says
/// behind which key frame it has its place.
class EditDesk {
 public:
  /// @param map that is edited. @param note_done is called with each edit that was done, before
  /// the reply: stores it and publishes what changed.
  EditDesk(GeometricMap& map, messaging::LiveProcess& live,
           std::function<void(const EditResult&, ViewCause)> note_done);

  /// @param view as it is, for epoch and revision.
  void take(const geomap::map_edit_t& message, const MapView& view);
  void take_reply(const geomap::map_edit_reply_t& reply, const MapView& view);
  /// @brief After a change of the map: does what has waited for it, publishes new records.
  void note_change(const MapView& view);
  /// @brief At the end of the input.
  void finish(const MapView& view);
  /// @brief Every record again.
  void publish_all(const MapView& view);

 private:
  void answer(const EditCommand& command, std::optional<std::int64_t> after, bool is_dry_run,
              const MapView& view);
  void refuse(const geomap::map_edit_t& message, const std::string& why, const MapView& view);
  void send(geomap::map_edit_reply_t reply, const MapView& view);
  void publish_changed_records(const MapView& view);
  void publish_record(geomap::map_edit_record_t record, const MapView& view);

  GeometricMap& map_;
  messaging::LiveProcess& live_;
  std::function<void(const EditResult&, ViewCause)> note_done_;
  LoggedEdits logged_;
  std::deque<geomap::map_edit_reply_t> refused_;                           // the newest
  std::map<std::int64_t, std::pair<std::int8_t, std::string>> published_;  // state and reason
};

}  // namespace geomap::mapping
