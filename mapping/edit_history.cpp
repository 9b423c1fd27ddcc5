// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/edit_history.hpp"

#include <algorithm>

namespace geomap::mapping {

std::set<std::int64_t> EditHistory::add(std::shared_ptr<const Edit> edit) {
  std::map<std::int64_t, bool> before;
  for (const auto& [number, entry] : entries_) before.emplace(number, entry.is_effective());

  const bool is_undo = edit->kind == EditKind::kUndo;
  if (is_undo || edit->kind == EditKind::kRedo) {
    for (const std::int64_t number : edit->edits) {
      const auto found = entries_.find(number);
      if (found == entries_.end()) continue;
      found->second.is_undone = is_undo;
      found->second.undone_by = is_undo ? edit->number : 0;
    }
  }
  number_after(edit->number);
  if (edit->command != 0) commands_[{edit->author, edit->command}] = edit->number;
  entries_.emplace(edit->number, EditEntry{.edit = edit});
  update_effects();

  std::set<std::int64_t> changed;
  for (const auto& [number, entry] : entries_) {
    const auto old = before.find(number);
    if ((old != before.end() && old->second) != entry.is_effective()) changed.insert(number);
  }
  return changed;
}

void EditHistory::update_effects() {
  for (auto& [number, entry] : entries_) entry.revoked_by = 0;
  for (const auto& [number, entry] : entries_) {
    const bool revokes =
        entry.edit->kind == EditKind::kUnlock || entry.edit->kind == EditKind::kRestore;
    if (!revokes || entry.is_undone) continue;
    for (const std::int64_t other : entry.edit->edits) {
      const auto found = entries_.find(other);
      if (found != entries_.end()) found->second.revoked_by = number;
    }
  }
  dropped_.clear();
  for (const auto& [number, entry] : entries_) {
    if (entry.edit->kind == EditKind::kDropKeyframe && entry.is_effective()) {
      dropped_.insert(entry.edit->keyframe);
    }
  }
}

std::shared_ptr<const Edit> EditHistory::find(const std::string& author,
                                              std::int64_t command) const {
  const auto found = commands_.find({author, command});
  if (command == 0 || found == commands_.end()) return nullptr;
  return entries_.at(found->second).edit;
}

std::vector<std::shared_ptr<const Edit>> EditHistory::in_fold_order() const {
  std::vector<std::shared_ptr<const Edit>> edits;
  for (const auto& [number, entry] : entries_) {
    if (entry.is_effective() && has_place_in_fold(entry.edit->kind)) edits.push_back(entry.edit);
  }
  std::stable_sort(edits.begin(), edits.end(),
                   [](const auto& a, const auto& b) { return a->after < b->after; });
  return edits;
}

void EditHistory::forget_before(
    std::int64_t keyframe,
    const std::function<std::optional<Eigen::Isometry3d>(std::int64_t)>& last_pose_of) {
  std::erase_if(entries_, [&](const auto& entry) {
    const Edit& edit = *entry.second.edit;
    return edit.after < keyframe ||
           (edit.kind == EditKind::kDropKeyframe && edit.keyframe <= keyframe);
  });
  std::erase_if(commands_, [&](const auto& command) { return !entries_.contains(command.second); });
  update_effects();
  for (auto& [number, entry] : entries_) {
    const auto pose = entry.edit->anchor <= keyframe ? last_pose_of(entry.edit->anchor)
                                                     : std::optional<Eigen::Isometry3d>();
    if (!pose) continue;
    auto moved = std::make_shared<Edit>(*entry.edit);
    moved->T_world_anchor = *pose;
    entry.edit = std::move(moved);
  }
}

}  // namespace geomap::mapping
