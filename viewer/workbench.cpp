// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/workbench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <utility>

#include "mapping/export.hpp"

namespace geomap::viewer {
namespace {

using mapping::EditCommand;
using mapping::EditKind;
using namespace std::chrono_literals;

constexpr std::size_t kMostNotices = 12;
constexpr auto kLongestWait = 3s;  // for a delta after the answer: then the ghost goes

bool hides_targets(EditKind kind) { return kind == EditKind::kDelete || kind == EditKind::kMerge; }

}  // namespace

Workbench::Workbench(std::unique_ptr<MapSource> source)
    : source_(std::move(source)), author_(mapping::operator_name()) {}

bool Workbench::update(Clock::time_point now) {
  bool is_changed = source_->update(scene_, now);
  if (scene_.map.stamp != map_stamp_) {
    map_stamp_ = scene_.map.stamp;
    surfaces_.update(scene_.map);
    const auto is_gone = [&](const mapping::FeatureId& id) { return !surfaces_.find(id); };
    std::erase_if(selection_.selected, is_gone);
    if (selection_.hovered && is_gone(*selection_.hovered)) selection_.hovered.reset();
  }
  update_bounds();
  is_changed |= take_outcomes();
  is_changed |= forget_shown(now);
  return is_changed;
}

bool Workbench::take_outcomes() {
  const std::vector<Outcome> outcomes = source_->take_outcomes();
  for (const Outcome& outcome : outcomes) {
    tell(outcome.is_done ? Level::kGood : Level::kFailing, in_words(outcome.text));
    if (saves_.erase(outcome.command) > 0 && outcome.is_done) unsaved_ = 0;
    const auto pending = std::find_if(pending_.begin(), pending_.end(), [&](const Pending& each) {
      return each.command.command == outcome.command;
    });
    if (pending == pending_.end()) continue;
    if (outcome.is_done) {
      pending->revision = outcome.revision;
      pending->answered = Clock::now();
      ++unsaved_;
      for (const auto& id : pending->command.targets) {
        done_[id].push_back(in_words(outcome.text));
      }
    } else {
      pending_.erase(pending);
      show_pending();
    }
  }
  return !outcomes.empty();
}

// An edit that the map shows by now needs no ghost any more.
bool Workbench::forget_shown(Clock::time_point now) {
  const std::size_t forgotten = std::erase_if(pending_, [&](const Pending& pending) {
    if (!pending.revision) return false;
    return scene_.map.epoch != pending.epoch || scene_.map.revision >= *pending.revision ||
           now - pending.answered > kLongestWait;
  });
  if (forgotten > 0) show_pending();
  return forgotten > 0;
}

void Workbench::update_bounds() {
  const std::array<Stamp, 3> stamps = {scene_.map.stamp, scene_.points.stamp, scene_.track.stamp};
  if (stamps == bounds_stamps_) return;
  bounds_stamps_ = stamps;
  bounds_ = scene_.track_and_points();
  for (const auto& [id, surface] : surfaces_.surfaces()) bounds_.extend(surface.box);
}

// Ids are for programs: people see the numbers of the list.
std::string Workbench::in_words(const std::string& text) const {
  std::string words = text;
  for (const auto& [id, surface] : surfaces_.surfaces()) {
    const std::string name = mapping::to_string(id);
    for (std::size_t at = words.find(name); at != std::string::npos; at = words.find(name, at)) {
      words.replace(at, name.size(), fmt::format("#{}", surface.number));
    }
  }
  return words;
}

void Workbench::show_pending() {
  selection_.motions.clear();
  selection_.pending.clear();
  for (const Pending& pending : pending_) {
    const std::set<mapping::FeatureId> targets(pending.command.targets.begin(),
                                               pending.command.targets.end());
    if (pending.command.kind == EditKind::kMove) {
      selection_.motions.push_back({targets, pending.command.T_world_moved});
    } else if (hides_targets(pending.command.kind)) {
      selection_.pending.insert(targets.begin(), targets.end());
    }
  }
  if (preview_) selection_.motions.push_back({selection_.selected, *preview_});
}

void Workbench::preview(const std::optional<Eigen::Isometry3d>& T_world_moved) {
  preview_ = T_world_moved;
  show_pending();
}

void Workbench::toggle(const mapping::FeatureId& id) {
  if (selection_.selected.erase(id) == 0) selection_.selected.insert(id);
}

void Workbench::add_to_selection(const std::set<mapping::FeatureId>& ids) {
  selection_.selected.insert(ids.begin(), ids.end());
}

EditCommand Workbench::command(EditKind kind) const {
  EditCommand command;
  command.kind = kind;
  command.targets.assign(selection_.selected.begin(), selection_.selected.end());
  return command;
}

void Workbench::ask(EditCommand command) {
  command.utime = command.command = numbers_.next();
  command.author = author_;
  const std::string fault = mapping::find_fault(command);
  if (!fault.empty()) {
    tell(Level::kFailing, fault);
    return;
  }
  pending_.push_back({command, {}, std::nullopt, scene_.map.epoch});
  show_pending();
  source_->edit(command);
}

void Workbench::remove() { ask(command(EditKind::kDelete)); }

void Workbench::move(const Eigen::Isometry3d& T_world_moved) {
  EditCommand motion = command(EditKind::kMove);
  motion.T_world_moved = T_world_moved;
  preview_.reset();
  ask(std::move(motion));
}

void Workbench::merge() { ask(command(EditKind::kMerge)); }

void Workbench::label(const std::string& text) {
  EditCommand labelling = command(EditKind::kLabel);
  labelling.label = text;
  ask(std::move(labelling));
}

void Workbench::lock(bool is_locked) {
  ask(command(is_locked ? EditKind::kLock : EditKind::kUnlock));
}

void Workbench::split(const mapping::FeatureId& id, const Eigen::Vector3d& a,
                      const Eigen::Vector3d& b) {
  EditCommand splitting;
  splitting.kind = EditKind::kSplit;
  splitting.targets = {id};
  splitting.points = {a, b};
  ask(std::move(splitting));
}

void Workbench::cut(const mapping::FeatureId& id, const std::vector<Eigen::Vector3d>& corners) {
  EditCommand cutting;
  cutting.kind = EditKind::kCut;
  cutting.targets = {id};
  cutting.points = corners;
  ask(std::move(cutting));
}

void Workbench::add(const std::vector<Eigen::Vector3d>& corners) {
  EditCommand adding;
  adding.kind = EditKind::kAdd;
  adding.points = corners;
  ask(std::move(adding));
}

void Workbench::undo(std::optional<std::int64_t> number) {
  EditCommand undoing;
  undoing.kind = EditKind::kUndo;
  if (number) undoing.edits = {*number};
  ask(std::move(undoing));
}

void Workbench::redo(std::optional<std::int64_t> number) {
  EditCommand redoing;
  redoing.kind = EditKind::kRedo;
  if (number) redoing.edits = {*number};
  ask(std::move(redoing));
}

void Workbench::restore(std::int64_t number) {
  EditCommand restoring;
  restoring.kind = EditKind::kRestore;
  restoring.edits = {number};
  ask(std::move(restoring));
}

void Workbench::save(const std::string& where) { saves_.insert(source_->save(where)); }

void Workbench::export_to(const std::string& file) {
  try {
    const bool is_all_wanted = std::filesystem::path(file).extension() == ".json";
    mapping::export_map(is_all_wanted ? source_->exact_snapshot(scene_) : source_->snapshot(scene_),
                        file);
    tell(Level::kGood, fmt::format("map exported to {}", file));
  } catch (const std::exception& error) {
    tell(Level::kFailing, error.what());
  }
}

bool Workbench::is_locked(const mapping::FeatureId& id) const {
  const auto found = scene_.map.features.find(id);
  return found != scene_.map.features.end() && found->second.locked;
}

bool Workbench::is_all_locked() const {
  const auto& ids = selection_.selected;
  return !ids.empty() &&
         std::all_of(ids.begin(), ids.end(), [this](const auto& id) { return is_locked(id); });
}

bool Workbench::is_any_locked() const {
  const auto& ids = selection_.selected;
  return std::any_of(ids.begin(), ids.end(), [this](const auto& id) { return is_locked(id); });
}

bool Workbench::is_waiting() const {
  return !saves_.empty() || std::any_of(pending_.begin(), pending_.end(),
                                        [](const Pending& each) { return !each.revision; });
}

std::vector<std::string> Workbench::done_to(const mapping::FeatureId& id) const {
  const auto found = done_.find(id);
  return found == done_.end() ? std::vector<std::string>() : found->second;
}

void Workbench::tell(Level level, const std::string& text) {
  notices_.push_back({level, text, Clock::now()});
  if (notices_.size() > kMostNotices) notices_.pop_front();
}

}  // namespace geomap::viewer
