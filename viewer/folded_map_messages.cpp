// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/folded_map_messages.hpp"

#include <optional>
#include <utility>

#include "geomap/keyframe_update_t.hpp"
#include "geomap/map_edit_reply_t.hpp"
#include "geomap/map_edit_t.hpp"
#include "geomap/plane_set_t.hpp"
#include "mapping/edit_messages.hpp"
#include "mapping/map_messages.hpp"
#include "messaging/channels.hpp"
#include "messaging/config.hpp"
#include "messaging/safe_decode.hpp"

namespace geomap::viewer {
namespace {

namespace channels = messaging::channels;
using Bytes = std::span<const std::uint8_t>;

template <class Message>
std::optional<Message> decode(Bytes data) {
  return messaging::safe_decode<Message>(data.data(), data.size()).message;
}

mapping::GeometricMap empty_map() {
  const messaging::Config config = messaging::Config::load();
  return {config.read<mapping::MergeConfig>("merge"),
          config.read<mapping::HistoryConfig>("history")};
}

}  // namespace

FoldedMap::FoldedMap() : map_(empty_map()) {}

bool FoldedMap::take(const std::string& channel, Bytes data) {
  if (channel == channels::kPlanes) return take_planes(data);
  if (channel == channels::kKeyframeUpdate) return take_update(data);
  if (channel == channels::kMapEditReply) return take_reply(data);
  if (channel == channels::kMapEdit) take_edit(data);
  return false;
}

bool FoldedMap::apply(const mapping::MapEvent& event) {
  return map_.apply(event).fault == mapping::EventFault::kNone;
}

bool FoldedMap::take_planes(Bytes data) {
  const auto message = decode<geomap::plane_set_t>(data);
  const auto observation = message ? mapping::from_message(*message) : nullptr;
  if (!observation) return false;
  const bool is_changed = apply(observation);
  return do_placed_edits() || is_changed;
}

bool FoldedMap::take_update(Bytes data) {
  const auto update = decode<geomap::keyframe_update_t>(data);
  if (!update) return false;
  bool is_changed = false;
  for (const mapping::MapEvent& event : mapping::from_message(*update)) {
    is_changed = apply(event) || is_changed;
  }
  return is_changed;
}

void FoldedMap::take_edit(Bytes data) {
  const auto message = decode<geomap::map_edit_t>(data);
  auto command = message ? mapping::from_message(*message) : std::nullopt;
  if (command && message->dry_run == 0) edits_.add(std::move(*command), message->seen_utime);
}

bool FoldedMap::take_reply(Bytes data) {
  const auto reply = decode<geomap::map_edit_reply_t>(data);
  if (!reply) return false;
  edits_.take_reply(reply->author, reply->command, reply->done != 0, reply->utime);
  return do_placed_edits();
}

bool FoldedMap::do_placed_edits() {
  bool is_changed = false;
  while (const auto placed = edits_.next(map_.history().newest())) {
    is_changed = map_.edit(placed->command, placed->after).edit != nullptr || is_changed;
  }
  return is_changed;
}

bool FoldedMap::finish() {
  bool is_changed = false;
  while (const auto placed = edits_.next_at_end()) {
    is_changed = map_.edit(placed->command, placed->after).edit != nullptr || is_changed;
  }
  return is_changed;
}

}  // namespace geomap::viewer
