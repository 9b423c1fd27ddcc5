// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/edit_decision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

namespace geomap::mapping {
namespace {

/// What stands against a command, in words.
class Refusal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

bool is_undoable(EditKind kind) { return kind != EditKind::kUndo && kind != EditKind::kRedo; }

class Decision {
 public:
  Decision(const EditCommand& command, std::int64_t after, const FeatureSet& features,
           const EventHistory& history)
      : command_(command),
        targets_(command.targets.begin(), command.targets.end()),
        after_(after),
        features_(features),
        history_(history) {}

  std::shared_ptr<const Edit> make() {
    edit_.number = history_.edits().last_number() + 1;
    edit_.after = after_;
    edit_.kind = command_.kind;
    edit_.author = command_.author;
    edit_.command = command_.command;
    edit_.utime = command_.utime;
    edit_.label = command_.label;
    for (const FeatureId& id : targets_) edit_.targets.push_back(target(id).observations);
    hang_geometry();
    switch (command_.kind) {
      case EditKind::kUnlock:
        edit_.edits = holders();
        break;
      case EditKind::kRestore:
        edit_.edits = vetoed();
        break;
      case EditKind::kUndo:
        edit_.edits = to_undo();
        break;
      case EditKind::kRedo:
        edit_.edits = to_redo();
        break;
      case EditKind::kDropKeyframe:
        edit_.keyframe = keyframe();
        break;
      default:
        break;
    }
    return std::make_shared<const Edit>(std::move(edit_));
  }

 private:
  const MapFeature& target(const FeatureId& id) const {
    const auto found = features_.find(id);
    if (found != features_.end()) return *found->second;
    for (const auto& [other, feature] : features_) {
      if (std::binary_search(feature->observations.begin(), feature->observations.end(), id)) {
        throw Refusal(fmt::format("{} is part of {} now", to_string(id), to_string(other)));
      }
    }
    throw Refusal(to_string(id) + " is not in the map" + last_edit_of(id));
  }

  // " (delete by ann, edit 3)", where an edit that counts has taken it out.
  std::string last_edit_of(const FeatureId& id) const {
    const auto& entries = history_.edits().entries();
    for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry) {
      const Edit& edit = *entry->second.edit;
      const bool names_it = std::any_of(edit.targets.begin(), edit.targets.end(), [&](auto& t) {
        return std::binary_search(t.begin(), t.end(), id);
      });
      if (!names_it || !entry->second.is_effective()) continue;
      return fmt::format(" ({} by {}, edit {})", to_string(edit.kind),
                         edit.author.empty() ? "somebody" : edit.author, edit.number);
    }
    return "";
  }

  void hang_geometry() {
    edit_.anchor =
        command_.targets.empty() ? after_ : target(command_.targets.front()).first_utime();
    const Eigen::Isometry3d T_world_anchor =
        history_.pose_of(edit_.anchor).value_or(Eigen::Isometry3d::Identity());
    const Eigen::Isometry3d T_anchor_world = T_world_anchor.inverse();
    edit_.T_world_anchor = T_world_anchor;
    if (command_.kind == EditKind::kMove) {
      edit_.T_anchor_moved = T_anchor_world * command_.T_world_moved * T_world_anchor;
    }
    for (const Eigen::Vector3d& point : command_.points) {
      edit_.points.push_back(T_anchor_world * point);
    }
  }

  const EditEntry& entry(std::int64_t number) const {
    const auto& entries = history_.edits().entries();
    const auto found = entries.find(number);
    if (found != entries.end()) return found->second;
    if (number < 1 || number > history_.edits().last_number()) {
      throw Refusal(fmt::format("there is no edit {}", number));
    }
    throw Refusal(
        fmt::format("edit {} is too old: the map keeps no events from before it", number));
  }

  std::vector<std::int64_t> holders() const {
    std::set<std::int64_t> numbers;
    for (const FeatureId& id : targets_) {
      const MapFeature& feature = target(id);
      if (!feature.is_held()) throw Refusal(to_string(id) + " is not held");
      for (const std::int64_t number : feature.held_by) {
        if (entry(number).edit->kind == EditKind::kAdd) {
          throw Refusal(fmt::format("{} was added by hand: undo edit {} to take it out",
                                    to_string(id), number));
        }
        numbers.insert(number);
      }
    }
    for (const auto& [id, feature] : features_) {
      for (const std::int64_t number : feature->held_by) {
        if (!numbers.contains(number) || targets_.contains(id)) continue;
        throw Refusal(
            fmt::format("edit {} holds {} too: unlock both, or undo it", number, to_string(id)));
      }
    }
    return {numbers.begin(), numbers.end()};
  }

  std::vector<std::int64_t> vetoed() const {
    for (const std::int64_t number : command_.edits) {
      const EditEntry& found = entry(number);
      const EditKind kind = found.edit->kind;
      if (kind != EditKind::kDelete && kind != EditKind::kCut) {
        throw Refusal(fmt::format("edit {} is no deletion but: {}", number, to_string(kind)));
      }
      if (!found.is_effective()) {
        throw Refusal(fmt::format("edit {} keeps nothing out any more", number));
      }
    }
    return command_.edits;
  }

  std::vector<std::int64_t> to_undo() const {
    const auto& entries = history_.edits().entries();
    if (command_.edits.empty()) {
      const auto newest = std::find_if(entries.rbegin(), entries.rend(), [](const auto& e) {
        return is_undoable(e.second.edit->kind) && !e.second.is_undone;
      });
      if (newest == entries.rend()) throw Refusal("there is nothing to undo");
      require_referents(*newest->second.edit);
      return {newest->first};
    }
    for (const std::int64_t number : command_.edits) {
      const EditEntry& found = entry(number);
      if (!is_undoable(found.edit->kind)) {
        throw Refusal(
            fmt::format("edit {} is an undo or redo itself: name the edit it speaks of", number));
      }
      if (found.is_undone) throw Refusal(fmt::format("edit {} is undone already", number));
      require_referents(*found.edit);
    }
    return command_.edits;
  }

  std::vector<std::int64_t> to_redo() const {
    const auto& entries = history_.edits().entries();
    if (command_.edits.empty()) {
      const EditEntry* last = nullptr;  // undone
      for (const auto& [number, candidate] : entries) {
        if (!candidate.is_undone) continue;
        if (last == nullptr || candidate.undone_by >= last->undone_by) last = &candidate;
      }
      if (last == nullptr) throw Refusal("there is nothing to redo");
      require_referents(*last->edit);
      return {last->edit->number};
    }
    for (const std::int64_t number : command_.edits) {
      if (!entry(number).is_undone) throw Refusal(fmt::format("edit {} is not undone", number));
      require_referents(*entry(number).edit);
    }
    return command_.edits;
  }

  // What an unlock or restore let go of must still be known.
  void require_referents(const Edit& edit) const {
    if (edit.kind != EditKind::kUnlock && edit.kind != EditKind::kRestore) return;
    for (const std::int64_t number : edit.edits) entry(number);
  }

  std::int64_t keyframe() const {
    if (!history_.keyframes().contains(command_.keyframe)) {
      throw Refusal(fmt::format("there is no key frame {}", command_.keyframe));
    }
    if (history_.edits().is_dropped(command_.keyframe)) {
      throw Refusal(fmt::format("key frame {} is dropped already", command_.keyframe));
    }
    return command_.keyframe;
  }

  const EditCommand& command_;
  std::set<FeatureId> targets_;
  std::int64_t after_;
  const FeatureSet& features_;
  const EventHistory& history_;
  Edit edit_;
};

}  // namespace

EditDecision decide(const EditCommand& command, std::int64_t after, const FeatureSet& features,
                    const EventHistory& history) {
  const std::string fault = find_fault(command);
  if (!fault.empty()) return {nullptr, fault};
  try {
    return {Decision(command, after, features, history).make(), ""};
  } catch (const Refusal& refusal) {
    return {nullptr, refusal.what()};
  }
}

}  // namespace geomap::mapping
