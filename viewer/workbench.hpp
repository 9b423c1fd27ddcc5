// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "mapping/edit.hpp"
#include "mapping/operator_name.hpp"
#include "viewer/map_source.hpp"
#include "viewer/selection.hpp"
#include "viewer/surface_cache.hpp"

namespace geomap::viewer {

/// @brief A word to the operator: what was done, or why not.
struct Notice {
  Level level = Level::kGood;
  std::string text;
  Clock::time_point at;
};

/// @brief What the operator works on: the scene, what he has selected, and the edits on their way.
/// Knows neither windows nor OpenGL.
class Workbench {
 public:
  explicit Workbench(std::unique_ptr<MapSource> source);

  /// @brief Takes what has come. @return true when something is to be drawn anew.
  bool update(Clock::time_point now);

  const SceneModel& scene() const { return scene_; }
  MapSource& source() { return *source_; }
  const MapSource& source() const { return *source_; }
  const SurfaceCache& surfaces() const { return surfaces_; }

  /// @brief Selected and hovered features, and what waits for the mapper, for the renderers.
  const Selection& selection() const { return selection_; }
  const std::set<mapping::FeatureId>& selected() const { return selection_.selected; }
  void hover(const std::optional<mapping::FeatureId>& id) { selection_.hovered = id; }
  void select(std::set<mapping::FeatureId> ids) { selection_.selected = std::move(ids); }
  void toggle(const mapping::FeatureId& id);
  void add_to_selection(const std::set<mapping::FeatureId>& ids);
  /// @brief A motion that is tried and has not been asked for; nothing: none.
  void preview(const std::optional<Eigen::Isometry3d>& T_world_moved);

  /// @brief Edits of what is selected. What comes of them is told by notices().
  void remove();
  void move(const Eigen::Isometry3d& T_world_moved);
  void merge();
  void label(const std::string& text);
  void lock(bool is_locked);
  void split(const mapping::FeatureId& id, const Eigen::Vector3d& a, const Eigen::Vector3d& b);
  void cut(const mapping::FeatureId& id, const std::vector<Eigen::Vector3d>& corners);
  void add(const std::vector<Eigen::Vector3d>& corners);
  /// @brief Of the newest edit, or one with a number.
  void undo(std::optional<std::int64_t> number = {});
  void redo(std::optional<std::int64_t> number = {});
  /// @brief Lets what an edit keeps out come back.
  void restore(std::int64_t number);
  void save(const std::string& where);
  void export_to(const std::string& file);

  /// @brief True when all that is selected is held by the operator.
  bool is_all_locked() const;
  bool is_any_locked() const;
  /// @brief True while edits have no answer.
  bool is_waiting() const;

  /// @brief What this operator has done to a feature since the start, in words.
  std::vector<std::string> done_to(const mapping::FeatureId& id) const;

  /// @brief Box around map, points and camera path; empty when there is nothing.
  const Eigen::AlignedBox3d& bounds() const { return bounds_; }
  /// @brief True when a saved map has edits that no file holds yet.
  bool has_unsaved_edits() const { return !source_->is_live() && unsaved_ > 0; }

  void tell(Level level, const std::string& text);
  /// @brief The newest ones last; at most some ten.
  const std::deque<Notice>& notices() const { return notices_; }

 private:
  struct Pending {
    mapping::EditCommand command;
    Clock::time_point answered;
    std::optional<std::int64_t> revision;  // from which on it is to be seen; nothing: no answer yet
    std::int64_t epoch = 0;                // of the map when it was asked
  };

  mapping::EditCommand command(mapping::EditKind kind) const;
  void ask(mapping::EditCommand command);
  bool take_outcomes();
  bool forget_shown(Clock::time_point now);
  bool is_locked(const mapping::FeatureId& id) const;
  void show_pending();
  void update_bounds();
  std::string in_words(const std::string& text) const;

  std::unique_ptr<MapSource> source_;
  SceneModel scene_;
  SurfaceCache surfaces_;
  Selection selection_;
  std::optional<Eigen::Isometry3d> preview_;
  std::vector<Pending> pending_;
  std::set<std::int64_t> saves_;  // commands that wait
  std::map<mapping::FeatureId, std::vector<std::string>> done_;
  std::deque<Notice> notices_;
  mapping::CommandNumbers numbers_;
  std::string author_;
  Stamp map_stamp_ = 0;
  std::array<Stamp, 3> bounds_stamps_{};
  Eigen::AlignedBox3d bounds_;
  int unsaved_ = 0;  // edits since the last save
};

}  // namespace geomap::viewer
