// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/geometric_map.hpp"

#include <iterator>
#include <stdexcept>
#include <utility>

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
  base_ = saved.base_features;
  if (saved.base_keyframe) history_.forget_through(*saved.base_keyframe);
  for (const MapEvent& event : saved.events) {
    EventFault fault = find_fault(event);
    if (fault == EventFault::kNone) fault = history_.record(event).fault;
    if (fault != EventFault::kNone) {
      throw std::invalid_argument("saved map holds an event that is refused: " + to_string(fault));
    }
  }
  store_ = FeatureStore(saved.features);
  revision_ = saved.revision;
}

ApplyResult GeometricMap::apply(const MapEvent& event) {
  ApplyResult result;
  result.fault = find_fault(event);
  if (result.fault != EventFault::kNone) return result;
  const EventHistory::Recorded recorded = history_.record(event);
  result.fault = recorded.fault;
  if (!recorded.changed_from) return result;

  const EventHistory::Keyframes& keyframes = history_.keyframes();
  const bool appended = std::holds_alternative<std::shared_ptr<const Observation>>(event) &&
                        keyframes.rbegin()->first == *recorded.changed_from;
  if (appended) {
    result.candidates = fold(*keyframes.rbegin()->second);
    result.change = store_.take_change();
    compact();
  } else {
    const FeatureSet before = store_.features();
    result.candidates = fold_again_from(*recorded.changed_from);
    result.change = difference(before, store_.features());
  }
  ++revision_;
  return result;
}

SavedMap GeometricMap::saved() const {
  return {
      merge_config_, history_config_,  revision_, store_.features(), history_.forgotten_through(),
      base_,         history_.events()};
}

std::int64_t GeometricMap::fold(const Observation& observation) {
  std::int64_t candidates = 0;
  const auto planes = static_cast<std::int32_t>(observation.planes.size());
  for (std::int32_t i = 0; i < planes; ++i) {
    if (auto feature = feature_of(observation, i, merge_config_)) {
      candidates += merger_->insert(std::move(*feature), store_);
    }
  }
  if (++folds_since_copy_ >= history_config_.copy_every) keep_copy(observation.keyframe);
  return candidates;
}

std::int64_t GeometricMap::fold_again_from(std::int64_t keyframe) {
  const EventHistory::Keyframes& keyframes = history_.keyframes();
  copies_.erase(copies_.lower_bound(keyframe), copies_.end());
  auto next = keyframes.begin();
  if (copies_.empty()) {
    store_ = FeatureStore(base_);
  } else {
    const auto& [copied_through, features] = *copies_.rbegin();
    store_ = FeatureStore(features);
    next = keyframes.upper_bound(copied_through);
  }
  folds_since_copy_ = 0;
  std::int64_t candidates = 0;
  for (; next != keyframes.end(); ++next) candidates += fold(*next->second);
  store_.take_change();
  return candidates;
}

void GeometricMap::keep_copy(std::int64_t keyframe) {
  folds_since_copy_ = 0;
  copies_.emplace(keyframe, store_.features());
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
