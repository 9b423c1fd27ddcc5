// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/edit_process.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "mapping/edit_messages.hpp"
#include "messaging/channels.hpp"
#include "messaging/log.hpp"

namespace geomap::mapping {
namespace {

namespace channels = messaging::channels;

constexpr std::size_t kRefusedKept = 256;  // refusals that are known when a command is sent again

ViewCause cause_of(EditKind kind) {
  switch (kind) {
    case EditKind::kUndo:
      return ViewCause::kUndo;
    case EditKind::kRedo:
      return ViewCause::kRedo;
    case EditKind::kDropKeyframe:
      return ViewCause::kKeyframeRemoval;
    default:
      return ViewCause::kEdit;
  }
}

// The key frames that an edit speaks of, itself or by undoing or redoing others.
std::vector<std::int64_t> keyframes_of(const Edit& edit, const EditHistory& edits) {
  std::vector<std::int64_t> keyframes;
  if (edit.kind == EditKind::kDropKeyframe) keyframes.push_back(edit.keyframe);
  if (edit.kind != EditKind::kUndo && edit.kind != EditKind::kRedo) return keyframes;
  for (const std::int64_t number : edit.edits) {
    const auto found = edits.entries().find(number);
    if (found == edits.entries().end()) continue;
    const Edit& other = *found->second.edit;
    if (other.kind == EditKind::kDropKeyframe) keyframes.push_back(other.keyframe);
  }
  return keyframes;
}

// Says of these key frames whether they are in the map now.
void note_keyframes(const Edit& edit, const EditHistory& edits, geomap::map_edit_reply_t& reply) {
  for (const std::int64_t keyframe : keyframes_of(edit, edits)) {
    (edits.is_dropped(keyframe) ? reply.dropped : reply.restored).push_back(keyframe);
  }
  reply.n_dropped = static_cast<std::int32_t>(reply.dropped.size());
  reply.n_restored = static_cast<std::int32_t>(reply.restored.size());
}

}  // namespace

EditDesk::EditDesk(GeometricMap& map, messaging::LiveProcess& live,
                   std::function<void(const EditResult&, ViewCause)> note_done)
    : map_(map), live_(live), note_done_(std::move(note_done)) {}

void EditDesk::take(const geomap::map_edit_t& message, const MapView& view) {
  auto command = from_message(message);
  if (!command) {
    refuse(message, fmt::format("there is no command of kind {}", message.kind), view);
    return;
  }
  if (live_.bus().config().lossless) {
    if (message.dry_run == 0) logged_.add(std::move(*command), message.seen_utime);
    return;
  }
  const bool is_repeated = map_.history().edits().find(message.author, message.command) != nullptr;
  if (!is_repeated && message.epoch != 0 && message.epoch != view.epoch) {
    refuse(message, "the mapper was started anew since: look at the map again", view);
    return;
  }
  const auto refused = std::find_if(refused_.begin(), refused_.end(), [&](const auto& reply) {
    return reply.author == message.author && reply.command == message.command;
  });
  if (message.command != 0 && message.dry_run == 0 && refused != refused_.end()) {
    send(*refused, view);  // what was refused once is not done because it was sent again
    return;
  }
  answer(*command, {}, message.dry_run != 0, view);
}

// Of the log that is replayed; the process's own ones are of its own epoch.
void EditDesk::take_reply(const geomap::map_edit_reply_t& reply, const MapView& view) {
  if (!live_.bus().config().lossless || reply.epoch == view.epoch) return;
  logged_.take_reply(reply.author, reply.command, reply.done != 0, reply.utime);
  note_change(view);
}

void EditDesk::note_change(const MapView& view) {
  while (const auto placed = logged_.next(map_.history().newest())) {
    answer(placed->command, placed->after, false, view);
  }
  publish_changed_records(view);
}

void EditDesk::finish(const MapView& view) {
  while (const auto placed = logged_.next_at_end()) {
    answer(placed->command, placed->after, false, view);
  }
}

void EditDesk::publish_all(const MapView& view) {
  published_.clear();
  publish_changed_records(view);
  if (map_.history().edits().entries().empty()) publish_record({}, view);
}

void EditDesk::answer(const EditCommand& command, std::optional<std::int64_t> after,
                      bool is_dry_run, const MapView& view) {
  std::optional<GeometricMap> trial;
  GeometricMap& map = is_dry_run ? trial.emplace(map_) : map_;
  const EditResult result = map.edit(command, after);
  geomap::map_edit_reply_t reply = reply_to(command, result, is_dry_run, map);
  if (!is_dry_run) {
    live_.health().count(result.edit ? "edits.done" : "edits.refused");
    const bool is_new = result.edit && !result.is_repeated;
    if (is_new) note_done_(result, cause_of(result.edit->kind));
    // In a replay registration follows the log's replies, at their place among the frames.
    if (result.edit && !live_.bus().config().lossless) {
      note_keyframes(*result.edit, map_.history().edits(), reply);
    }
  }
  if (!is_dry_run && !result.edit && command.author.size() <= kLongestAuthor) {
    refused_.push_back(reply);
    if (refused_.size() > kRefusedKept) refused_.pop_front();
  }
  send(std::move(reply), view);
  if (is_dry_run || !result.edit) return;
  messaging::log_info(fmt::format("{}: {}", command.author, describe(result)));
  publish_changed_records(view);
}

void EditDesk::refuse(const geomap::map_edit_t& message, const std::string& why,
                      const MapView& view) {
  live_.health().count("edits.refused");
  const EditCommand command{.author = message.author, .command = message.command};
  send(reply_to(command, {.refusal = why}, false, map_), view);
}

void EditDesk::send(geomap::map_edit_reply_t reply, const MapView& view) {
  reply.epoch = view.epoch;
  reply.revision = view.revision;
  live_.publish(channels::kMapEditReply, reply);
}

void EditDesk::publish_changed_records(const MapView& view) {
  const auto& entries = map_.history().edits().entries();
  for (const auto& [number, entry] : entries) {
    const auto state = state_of(entry, map_);
    const auto known = published_.find(number);
    if (known != published_.end() && known->second == state) continue;
    published_.insert_or_assign(number, state);
    publish_record(record_of(entry, map_), view);
  }
}

void EditDesk::publish_record(geomap::map_edit_record_t record, const MapView& view) {
  record.utime = map_.history().newest();
  record.epoch = view.epoch;
  record.count = static_cast<std::int32_t>(map_.history().edits().entries().size());
  live_.publish(channels::kMapEditRecord, record);
}

}  // namespace geomap::mapping
