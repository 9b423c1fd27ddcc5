// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/geometric_map.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

#include "mapping/apply_edit.hpp"
#include "mapping/edit_decision.hpp"
#include "mapping/fuse.hpp"

namespace geomap::mapping {

std::vector<std::string> HistoryConfig::validate() const {
  std::vector<std::string> messages;
  if (copy_every < 1) messages.emplace_back("copy_every must be at least 1");
  if (max_copies < 2) messages.emplace_back("max_copies must be at least 2");
  if (max_keyframes < 2 * copy_every) {
    messages.emplace_back("max_keyframes must be at least twice copy_every");
  }
  return messages;
}

GeometricMap::GeometricMap(const MergeConfig& merge, const HistoryConfig& history)
    : merge_config_(merge), history_config_(history), merger_(make_merger(merge)) {
  const std::vector<std::string> messages = history.validate();
  if (!messages.empty()) throw std::invalid_argument("history: " + messages.front());
}

GeometricMap::GeometricMap(const SavedMap& saved) : GeometricMap(saved.merge, saved.history) {
  base_ = saved.base;
  if (saved.base_keyframe) history_.forget_through(*saved.base_keyframe);
  for (const MapEvent& event : saved.events) {
    EventFault fault = find_fault(event);
    if (fault == EventFault::kNone) fault = history_.record(event).fault;
    if (fault != EventFault::kNone) {
      throw std::invalid_argument("saved map holds an event that is refused: " + to_string(fault));
    }
  }
  history_.number_edits_after(saved.last_edit);
  state_ = MapState(saved.contents);
  revision_ = saved.revision;
}

ApplyResult GeometricMap::apply(const MapEvent& event) {
  ApplyResult result;
  result.fault = find_fault(event);
  if (result.fault != EventFault::kNone) return result;
  const EventHistory::Recorded recorded = history_.record(event);
  result.fault = recorded.fault;
  if (!recorded.changed_from) return result;

  if (is_last(event)) {
    if (const auto* edit = std::get_if<std::shared_ptr<const Edit>>(&event)) {
      fold(**edit, state_);
    } else {
      const Observation& observation = *history_.keyframes().rbegin()->second;
      result.candidates = fold(observation, state_);
      note_folded(observation.keyframe);
    }
    result.change = state_.store.take_change();
    compact();
  } else {
    const FeatureSet before = features();
    result.candidates = fold_again_from(*recorded.changed_from);
    result.change = difference(before, features());
  }
  ++revision_;
  return result;
}

EditResult GeometricMap::edit(const EditCommand& command, std::optional<std::int64_t> after) {
  if (auto done = history_.edits().find(command.author, command.command)) {
    return {.edit = std::move(done), .is_repeated = true};
  }
  const std::int64_t newest = history_.newest();
  const std::int64_t place = std::min(after.value_or(newest), newest);
  if (place < history_.forgotten_through().value_or(place)) {
    return {.refusal = "it is too old: the map keeps no events from before it"};
  }
  MapState trial = place == newest ? MapState(state_.contents()) : state_after(place);
  EditDecision decision = decide(command, place, trial.store.features(), history_);
  if (!decision.edit) return {.refusal = std::move(decision.refusal)};
  if (has_place_in_fold(decision.edit->kind)) {
    fold(*decision.edit, trial);
    const auto idle = trial.idle_edits.find(decision.edit->number);
    if (idle != trial.idle_edits.end()) return {.refusal = idle->second};
  }
  ApplyResult applied = apply(decision.edit);
  if (applied.fault != EventFault::kNone) return {.refusal = to_string(applied.fault)};
  return {.edit = std::move(decision.edit), .change = std::move(applied.change)};
}

void GeometricMap::fold_anew() { fold_again_from(std::numeric_limits<std::int64_t>::min()); }

// An event behind which nothing is folded yet.
bool GeometricMap::is_last(const MapEvent& event) const {
  const auto& edits = history_.edits().entries();
  const auto& keyframes = history_.keyframes();
  if (const auto* edit = std::get_if<std::shared_ptr<const Edit>>(&event)) {
    return has_place_in_fold((*edit)->kind) && (*edit)->after == history_.newest();
  }
  const auto* observation = std::get_if<std::shared_ptr<const Observation>>(&event);
  return observation != nullptr && keyframes.rbegin()->first == (*observation)->keyframe &&
         std::none_of(edits.begin(), edits.end(), [&](const auto& entry) {
           return entry.second.edit->after >= (*observation)->keyframe;
         });
}

SavedMap GeometricMap::saved() const {
  return {merge_config_,
          history_config_,
          revision_,
          state_.contents(),
          history_.forgotten_through(),
          base_,
          history_.edits().last_number(),
          history_.events()};
}

std::int64_t GeometricMap::fold(const Observation& observation, MapState& state) const {
  std::int64_t candidates = 0;
  const auto planes = static_cast<std::int32_t>(observation.planes.size());
  for (std::int32_t i = 0; i < planes; ++i) {
    auto feature = feature_of(observation, i, merge_config_);
    if (feature && cut_vetoed(*feature, state.vetoes, merge_config_)) {
      candidates += merger_->insert(std::move(*feature), state.store);
    }
  }
  return candidates;
}

void GeometricMap::fold(const Edit& edit, MapState& state) const {
  std::string idle = apply_edit(edit, history_.pose_of(edit.anchor).value_or(edit.T_world_anchor),
                                *merger_, merge_config_, state);
  if (!idle.empty()) state.idle_edits.insert_or_assign(edit.number, std::move(idle));
}

// Key frames and edits that follow upon the copy of a state (nothing: upon the base), up to those
// at a time.
std::int64_t GeometricMap::fold_onwards(
    std::optional<std::int64_t> copied, std::int64_t through, MapState& state,
    const std::function<void(std::int64_t)>& note_keyframe) const {
  const EventHistory::Keyframes& keyframes = history_.keyframes();
  const std::vector<std::shared_ptr<const Edit>> edits = history_.edits().in_fold_order();
  auto edit = edits.begin();
  while (copied && edit != edits.end() && (*edit)->after < *copied) ++edit;
  const auto fold_edits_before = [&](std::int64_t keyframe) {
    for (; edit != edits.end() && (*edit)->after < keyframe; ++edit) fold(**edit, state);
  };
  std::int64_t candidates = 0;
  auto next = copied ? keyframes.upper_bound(*copied) : keyframes.begin();
  for (; next != keyframes.end() && next->first <= through; ++next) {
    fold_edits_before(next->first);
    if (history_.edits().is_dropped(next->first)) continue;
    candidates += fold(*next->second, state);
    note_keyframe(next->first);
  }
  for (; edit != edits.end() && (*edit)->after <= through; ++edit) fold(**edit, state);
  return candidates;
}

std::int64_t GeometricMap::fold_again_from(std::int64_t time) {
  copies_.erase(copies_.lower_bound(time), copies_.end());
  std::optional<std::int64_t> copied = history_.forgotten_through();
  if (!copies_.empty()) copied = copies_.rbegin()->first;
  state_ = MapState(copies_.empty() ? base_ : copies_.rbegin()->second);
  folds_since_copy_ = 0;
  const std::int64_t candidates = fold_onwards(
      copied, history_.newest(), state_, [this](std::int64_t keyframe) { note_folded(keyframe); });
  state_.store.take_change();
  return candidates;
}

// The map as it was when a key frame and the edits behind it were the newest.
MapState GeometricMap::state_after(std::int64_t keyframe) const {
  const auto later = copies_.upper_bound(keyframe);
  std::optional<std::int64_t> copied = history_.forgotten_through();
  if (later != copies_.begin()) copied = std::prev(later)->first;
  MapState state(later == copies_.begin() ? base_ : std::prev(later)->second);
  fold_onwards(copied, keyframe, state, [](std::int64_t) {});
  return state;
}

void GeometricMap::note_folded(std::int64_t keyframe) {
  if (++folds_since_copy_ >= history_config_.copy_every) keep_copy(keyframe);
}

void GeometricMap::keep_copy(std::int64_t keyframe) {
  folds_since_copy_ = 0;
  copies_.emplace(keyframe, state_.contents());
  if (copies_.size() <= static_cast<std::size_t>(history_config_.max_copies)) return;
  for (auto copy = copies_.begin(); copy != copies_.end();) {
    copy = copies_.erase(copy);
    if (copy != copies_.end()) ++copy;
  }
}

void GeometricMap::compact() {
  const EventHistory::Keyframes& keyframes = history_.keyframes();
  if (keyframes.size() <= static_cast<std::size_t>(history_config_.max_keyframes)) return;
  const auto middle = std::next(keyframes.begin(), static_cast<long>(keyframes.size() / 2));
  auto copy = copies_.upper_bound(middle->first);
  if (copy == copies_.begin()) return;  // no copy in the older half: nothing can be let go yet
  --copy;
  history_.forget_through(copy->first);
  base_ = copy->second;
  copies_.erase(copies_.begin(), std::next(copy));
}

}  // namespace geomap::mapping
