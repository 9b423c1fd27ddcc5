// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mapping/edit.hpp"

namespace geomap::mapping {

/// @brief An edit and what later ones say of it.
struct EditEntry {
  std::shared_ptr<const Edit> edit;
  bool is_undone = false;
  std::int64_t undone_by = 0;   // number of the newest undo, while it is undone
  std::int64_t revoked_by = 0;  // number of the newest unlock or restore in force; 0: none

  /// @brief Does the fold take it?
  bool is_effective() const { return !is_undone && revoked_by == 0; }
};

/// @brief All edits of a map by number, and which of them count: an undo, redo, unlock or restore
/// only speaks of others.
class EditHistory {
 public:
  /// @brief Adds the next edit; its number must be larger than all before.
  /// @return numbers of the edits that count from now on or no longer do.
  std::set<std::int64_t> add(std::shared_ptr<const Edit> edit);

  const std::map<std::int64_t, EditEntry>& entries() const { return entries_; }
  std::int64_t last_number() const { return last_number_; }
  /// @brief The next number will be larger than this one.
  void number_after(std::int64_t number) { last_number_ = std::max(last_number_, number); }

  /// @brief The edit of an author's command, if it was made; commands of 0 are never the same.
  std::shared_ptr<const Edit> find(const std::string& author, std::int64_t command) const;

  /// @brief Those that have a place in the fold, in its order: after which key frame, then by
  /// number.
  std::vector<std::shared_ptr<const Edit>> in_fold_order() const;
  /// @brief Is the key frame out by an edit?
  bool is_dropped(std::int64_t keyframe) const { return dropped_.contains(keyframe); }

  /// @brief Lets go of the edits that were made before this key frame, and has the others remember
  /// where the key frames up to it were last that they hang on.
  void forget_before(
      std::int64_t keyframe,
      const std::function<std::optional<Eigen::Isometry3d>(std::int64_t)>& last_pose_of);

 private:
  void update_effects();

  std::map<std::int64_t, EditEntry> entries_;
  std::map<std::pair<std::string, std::int64_t>, std::int64_t> commands_;  // to numbers
  std::set<std::int64_t> dropped_;                                         // key frames
  std::int64_t last_number_ = 0;
};

}  // namespace geomap::mapping
