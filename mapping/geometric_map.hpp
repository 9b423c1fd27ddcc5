// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mapping/edit.hpp"
#include "mapping/event_history.hpp"
#include "mapping/map_contents.hpp"
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

/// @brief What a command did.
struct EditResult {
  std::shared_ptr<const Edit> edit = nullptr;  // as the map keeps it; null when it was refused
  std::string refusal = {};                    // why, in words
  bool is_repeated = false;                    // it had been done before: nothing happened now
  MapChange change = {};
};

/// @brief Everything needed to go on with a map later: the result and the events it can be folded
/// from.
struct SavedMap {
  MergeConfig merge;
  HistoryConfig history;
  std::int64_t revision = 0;
  MapContents contents;
  std::optional<std::int64_t> base_keyframe;  // last key frame of the base state, if any
  MapContents base;
  std::int64_t last_edit = 0;    // number of the newest edit, also of those before the base state
  std::vector<MapEvent> events;  // since the base state
};

/// @brief The geometric map: planar polygons as a fold over events.
///
/// The map is a function of its events alone and changes only by apply() and edit(), which makes an
/// event of a command. Copies of the state are kept along the way, so a key frame that is removed,
/// corrected or arrives late, or an edit that is undone, folds again from the last copy before it.
class GeometricMap {
 public:
  /// @throws std::invalid_argument when a configuration is not valid.
  GeometricMap(const MergeConfig& merge, const HistoryConfig& history);
  /// @brief The map as it was saved. @throws std::invalid_argument when an event is refused.
  explicit GeometricMap(const SavedMap& saved);

  ApplyResult apply(const MapEvent& event);

  /// @brief Does what an operator asks for, or says why not.
  /// @param after key frame behind which the edit has its place: a replay names that of the first
  /// time. By default, and at most, the newest.
  EditResult edit(const EditCommand& command, std::optional<std::int64_t> after = {});

  /// @brief Folds all events again, upon the base: after other settings than those it was made
  /// with.
  void fold_anew();

  const FeatureSet& features() const { return state_.store.features(); }
  const VetoSet& vetoes() const { return state_.vetoes; }
  /// @brief Edits that do nothing as things are: number -> why.
  const std::map<std::int64_t, std::string>& idle_edits() const { return state_.idle_edits; }
  /// @brief Number of events that changed the map.
  std::int64_t revision() const { return revision_; }
  const EventHistory& history() const { return history_; }
  SavedMap saved() const;

 private:
  // These return candidates, as ApplyResult.
  std::int64_t fold(const Observation& observation, MapState& state) const;
  std::int64_t fold_onwards(std::optional<std::int64_t> copied, std::int64_t through,
                            MapState& state,
                            const std::function<void(std::int64_t)>& note_keyframe) const;
  std::int64_t fold_again_from(std::int64_t time);

  void fold(const Edit& edit, MapState& state) const;
  MapState state_after(std::int64_t keyframe) const;
  bool is_last(const MapEvent& event) const;
  void note_folded(std::int64_t keyframe);
  void keep_copy(std::int64_t keyframe);
  void compact();

  MergeConfig merge_config_;
  HistoryConfig history_config_;
  std::shared_ptr<const Merger> merger_;
  EventHistory history_;
  MapState state_;
  MapContents base_;
  std::map<std::int64_t, MapContents> copies_;  // after folding the key frame, before later edits
  int folds_since_copy_ = 0;
  std::int64_t revision_ = 0;
};

}  // namespace geomap::mapping
