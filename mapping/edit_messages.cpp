// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/edit_messages.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>

#include "mapping/map_messages.hpp"
#include "messaging/convert_geometry.hpp"

namespace geomap::mapping {
namespace {

using Record = geomap::map_edit_record_t;

// What it was given to is there, but has got another label since.
bool is_overruled_label(const Edit& label, const FeatureSet& features) {
  bool is_there = false;
  for (const auto& [id, feature] : features) {
    if (feature->label_edit == label.number) return false;
    const std::vector<ObservationId>& seen = feature->observations;
    is_there = is_there ||
               std::any_of(label.targets.begin(), label.targets.end(), [&](const auto& target) {
                 return std::binary_search(seen.begin(), seen.end(), target.front());
               });
  }
  return is_there;
}

geomap::veto_t to_message(const Veto& veto) {
  geomap::veto_t message{};
  message.id = mapping::to_message(veto.feature.id);
  message.held = veto.cause == VetoCause::kDeleted ? 0 : 1;
  message.frame = messaging::to_message(veto.feature.surface.frame);
  message.polygon = messaging::to_message(veto.feature.surface.polygon);
  return message;
}

}  // namespace

geomap::map_edit_t to_message(const EditCommand& command) {
  geomap::map_edit_t message{};
  message.kind = static_cast<std::int8_t>(command.kind);
  message.author = command.author;
  message.command = command.command;
  message.utime = command.utime;
  for (const FeatureId& id : command.targets) message.targets.push_back(to_message(id));
  message.n_targets = static_cast<std::int32_t>(message.targets.size());
  message.T_world_moved = messaging::to_message(command.T_world_moved);
  for (const Eigen::Vector3d& point : command.points) {
    message.points.push_back({{point.x(), point.y(), point.z()}});
  }
  message.n_points = static_cast<std::int32_t>(message.points.size());
  message.label = command.label;
  message.keyframe = command.keyframe;
  message.edits = command.edits;
  message.n_edits = static_cast<std::int32_t>(message.edits.size());
  return message;
}

std::optional<EditCommand> from_message(const geomap::map_edit_t& message) {
  if (message.kind < 0 || message.kind > static_cast<std::int8_t>(kLastEditKind)) {
    return std::nullopt;
  }
  EditCommand command;
  command.kind = static_cast<EditKind>(message.kind);
  command.author = message.author;
  command.command = message.command;
  command.utime = message.utime;
  for (const geomap::observation_id_t& id : message.targets) {
    command.targets.push_back(from_message(id));
  }
  command.T_world_moved = messaging::from_message(message.T_world_moved);
  for (const geomap::point_t& point : message.points) command.points.emplace_back(point.position);
  command.label = message.label;
  command.keyframe = message.keyframe;
  command.edits = message.edits;
  return command;
}

std::pair<std::int8_t, std::string> state_of(const EditEntry& entry, const GeometricMap& map) {
  if (entry.is_undone) return {Record::UNDONE, fmt::format("by edit {}", entry.undone_by)};
  if (entry.revoked_by != 0) return {Record::REVOKED, fmt::format("by edit {}", entry.revoked_by)};
  const auto idle = map.idle_edits().find(entry.edit->number);
  if (idle != map.idle_edits().end()) return {Record::IDLE, idle->second};
  const bool is_overruled =
      entry.edit->kind == EditKind::kLabel && is_overruled_label(*entry.edit, map.features());
  return {Record::DONE, is_overruled ? "overruled by a later label" : ""};
}

geomap::map_edit_record_t record_of(const EditEntry& entry, const GeometricMap& map) {
  const Edit& edit = *entry.edit;
  geomap::map_edit_record_t record{};
  record.number = edit.number;
  record.edit_utime = edit.utime;
  record.author = edit.author;
  record.kind = static_cast<std::int8_t>(edit.kind);
  record.text = describe(edit);
  std::tie(record.state, record.reason) = state_of(entry, map);
  const auto begin =
      map.vetoes().lower_bound({edit.number, FeatureId{INT64_MIN, INT32_MIN}, VetoCause::kDeleted});
  for (auto veto = begin; veto != map.vetoes().end() && veto->first.edit == edit.number; ++veto) {
    record.vetoes.push_back(to_message(*veto->second));
  }
  record.n_vetoes = static_cast<std::int32_t>(record.vetoes.size());
  return record;
}

std::string describe(const Edit& edit) {
  std::string text = to_string(edit.kind);
  const std::size_t targets = edit.targets.size();
  if (targets == 1) {
    text += fmt::format(" {}", to_string(edit.targets.front().front()));
  } else if (targets > 1) {
    text += fmt::format(" {} features", targets);
  }
  if (edit.kind == EditKind::kDropKeyframe) text += fmt::format(" {}", edit.keyframe);
  if (is_about_edits(edit.kind) && !edit.edits.empty()) {
    text += fmt::format(" {} {}{}", targets > 0 ? "from" : "of",
                        edit.edits.size() == 1 ? "edit " : "edits ", fmt::join(edit.edits, ", "));
  }
  if (!edit.label.empty()) text += fmt::format(" '{}'", edit.label);
  return text;
}

std::string describe(const EditResult& result) {
  if (!result.edit) return result.refusal;
  const std::string text = fmt::format("edit {}: {}", result.edit->number, describe(*result.edit));
  if (result.is_repeated) return text + " (was done before)";
  const MapChange& change = result.change;
  return text + fmt::format("; {} features new or changed, {} gone", change.upserted.size(),
                            change.removed.size() + change.absorbed.size());
}

geomap::map_edit_reply_t reply_to(const EditCommand& command, const EditResult& result,
                                  bool is_dry_run, const GeometricMap& map) {
  geomap::map_edit_reply_t reply{};
  reply.utime = result.edit ? result.edit->after : map.history().newest();
  reply.command = command.command;
  reply.author = command.author;
  reply.done = result.edit ? 1 : 0;
  reply.edit = result.edit ? result.edit->number : 0;
  reply.text = describe(result);
  if (is_dry_run && result.edit) reply.text = fmt::format("would be {}", reply.text);
  return reply;
}

std::string state_name(const geomap::map_edit_record_t& record) {
  switch (record.state) {
    case Record::UNDONE:
      return "undone";
    case Record::REVOKED:
      return "revoked";
    case Record::IDLE:
      return "idle";
    default:
      return "done";
  }
}

}  // namespace geomap::mapping
