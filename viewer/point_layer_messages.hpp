// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>

#include "geomap/point_map_update_t.hpp"
#include "viewer/scene_model.hpp"
#include "viewer/taken.hpp"

namespace geomap::viewer {

/// @brief The point map, put together from the updates of POINT_MAP.
///
/// The whole map comes as a burst of updates. A block that is not in it stays until the burst has
/// come whole, so that the picture does not flicker. Updates may overtake each other.
class PointUpdates {
 public:
  Taken take(const geomap::point_map_update_t& message, Clock::time_point now, PointLayer& layer);

  /// @brief Takes out what a whole map that has come does not hold. @return true when there was.
  bool drop_outdated(Clock::time_point now, PointLayer& layer);

  /// @brief Nothing is known of the map any more, for example since the sender was started anew.
  void note_loss();
  /// @brief True when it is time to ask for the whole map: when something is missing, is not on its
  /// way, and has not merely been overtaken. At most once a second, and ever more seldom while no
  /// answer comes whole, so that a lossy link is not filled with answers.
  bool should_ask(Clock::time_point now);

  /// @brief Updates that are missing by their numbers.
  std::int64_t missing() const { return missing_; }

 private:
  struct Burst {
    std::int64_t utime = 0;  // that all its updates have [us]
    Clock::time_point began, heard;
  };

  bool follow(const geomap::point_map_update_t& message);
  void note_gap(std::int64_t first, std::int64_t end);
  void note_burst(const geomap::point_map_update_t& message, Clock::time_point now);
  bool is_outdated(const BlockKey& block) const;
  bool is_whole() const { return first_ && absent_.empty(); }

  std::optional<std::int64_t> sequence_;  // highest of any update
  std::int64_t session_ = 0;
  std::int64_t missing_ = 0;
  std::optional<std::int64_t> first_;         // update of the newest whole map; none: begun amid
  std::set<std::int64_t> absent_;             // numbers since then that have not come
  std::map<BlockKey, std::int64_t> writers_;  // by which update each block was last written
  std::optional<Burst> burst_;                // that is coming in
  bool must_drop_ = false;                    // outdated blocks, as soon as it is whole
  Clock::duration patience_ = std::chrono::seconds(1);  // between two requests
  std::optional<Clock::time_point> asked_, incomplete_since_;
};

}  // namespace geomap::viewer
