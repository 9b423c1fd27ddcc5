// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mapping/event_history.hpp"
#include "mapping/feature_store.hpp"
#include "mapping/map_event.hpp"
#include "mapping/merge_config.hpp"
#include "mapping/merger.hpp"

namespace geomap::mapping {

/// @brief How a map keeps its history.
struct HistoryConfig {
  int copy_every = 16;         // key frames between two copies of the state
  int max_copies = 64;         // beyond, every second one is dropped
  int max_keyframes = 100000;  // beyond, the older half is compacted into a base state

  std::vector<std::string> validate() const;

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& visitor) {
    visitor("copy_every", self.copy_every);
    visitor("max_copies", self.max_copies);
    visitor("max_keyframes", self.max_keyframes);
  }
};

/// @brief What one event did.
struct ApplyResult {
  EventFault fault = EventFault::kNone;  // why it was refused; the map is then unchanged
  MapChange change;
  std::int64_t candidates = 0;  // features that new ones were compared with, one counted each time
};

/// @brief Everything needed to go on with a map later: the result and the events it can be folded
/// from.
struct SavedMap {
  MergeConfig merge;
  HistoryConfig history;
  std::int64_t revision = 0;
  FeatureSet features;
  std::optional<std::int64_t> base_keyframe;  // last key frame of the base state, if any
  FeatureSet base_features;
  std::vector<MapEvent> events;  // since the base state
};

/// @brief The geometric map: planar polygons as a fold over events.
///
/// The map is a function of its events alone and changes only by apply(). Copies of the state are
/// kept along the way, so a key frame that is removed, corrected or arrives late folds again from
/// the last copy before it.
class GeometricMap {
 public:
  /// @throws std::invalid_argument when a configuration is not valid.
  GeometricMap(const MergeConfig& merge, const HistoryConfig& history);
  /// @brief The map as it was saved. @throws std::invalid_argument when an event is refused.
  explicit GeometricMap(const SavedMap& saved);

  ApplyResult apply(const MapEvent& event);

  const FeatureSet& features() const { return store_.features(); }
  /// @brief Number of events that changed the map.
  std::int64_t revision() const { return revision_; }
  const EventHistory& history() const { return history_; }
  SavedMap saved() const;

 private:
  std::int64_t fold(const Observation& observation);  // returns candidates, as ApplyResult
  std::int64_t fold_again_from(std::int64_t keyframe);
  void keep_copy(std::int64_t keyframe);
  void compact();

  MergeConfig merge_config_;
  HistoryConfig history_config_;
  std::unique_ptr<Merger> merger_;
  EventHistory history_;
  FeatureStore store_;
  FeatureSet base_;
  std::map<std::int64_t, FeatureSet> copies_;  // state after folding the key frame
  int folds_since_copy_ = 0;
  std::int64_t revision_ = 0;
};

}  // namespace geomap::mapping
