// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/random_operator.hpp"

#include <algorithm>
#include <iterator>
#include <numbers>

namespace geomap::testing {

using mapping::EditCommand;
using mapping::EditKind;
using mapping::FeatureId;
using mapping::GeometricMap;
using mapping::MapFeature;

FeatureId RandomOperator::any_feature(const GeometricMap& map) {
  return std::next(map.features().begin(), below(map.features().size()))->first;
}

std::vector<std::int64_t> RandomOperator::any_edit(const GeometricMap& map) {
  const auto& entries = map.history().edits().entries();
  if (entries.empty()) return {};
  return {std::next(entries.begin(), below(entries.size()))->first};
}

// Around the middle of the surface, on its plane.
std::vector<Eigen::Vector3d> RandomOperator::drawn_on(const MapFeature& feature, int corners) {
  const geometry::AreaMoments area = geometry::area_moments(feature.surface.polygon);
  const Eigen::Vector2d middle = area.centroid + Eigen::Vector2d(metres(0.3), metres(0.3));
  const double radius = 0.05 + std::abs(metres(0.5)), turn = metres(std::numbers::pi);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = turn + 2.0 * std::numbers::pi * i / corners;
    points.push_back(feature.surface.lift(
        Eigen::Vector2d(middle + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)))));
  }
  return points;
}

EditCommand RandomOperator::next(const GeometricMap& map) {
  EditCommand command;
  command.kind = static_cast<EditKind>(below(static_cast<std::size_t>(mapping::kLastEditKind) + 1));
  command.author = below(2) == 0 ? "ann" : "bob";
  command.command = ++command_;
  const bool is_empty = map.features().empty();
  switch (command.kind) {
    case EditKind::kMerge:
      if (!is_empty) command.targets = {any_feature(map), any_feature(map)};
      break;
    case EditKind::kDelete:
    case EditKind::kMove:
    case EditKind::kLabel:
    case EditKind::kLock:
    case EditKind::kUnlock:
    case EditKind::kSplit:
    case EditKind::kCut:
      if (!is_empty) command.targets = {any_feature(map)};
      break;
    case EditKind::kDropKeyframe: {
      const auto& keyframes = map.history().keyframes();
      if (!keyframes.empty()) {
        command.keyframe = std::next(keyframes.begin(), below(keyframes.size()))->first;
      }
      break;
    }
    case EditKind::kRestore:
    case EditKind::kUndo:
    case EditKind::kRedo:
      command.edits = any_edit(map);
      break;
    default:
      break;
  }
  if (command.kind == EditKind::kLabel) command.label = below(2) == 0 ? "wall" : "table";
  if (command.kind == EditKind::kMove) {
    command.T_world_moved =
        Eigen::Translation3d(metres(0.5), metres(0.5), metres(0.5)) *
        Eigen::AngleAxisd(metres(0.3), Eigen::Vector3d(metres(1), metres(1), 2).normalized());
  }
  if (!is_empty && command.kind == EditKind::kAdd) {
    command.points = drawn_on(*map.features().at(any_feature(map)), 3 + below(3));
  }
  if (!command.targets.empty() && command.kind == EditKind::kSplit) {
    command.points = drawn_on(*map.features().at(command.targets[0]), 2);
  }
  if (!command.targets.empty() && command.kind == EditKind::kCut) {
    command.points = drawn_on(*map.features().at(command.targets[0]), 3 + below(3));
  }
  return command;
}

int RandomOperator::edit(GeometricMap& map, int count) {
  int done = 0;
  for (int tries = 0; done < count && tries < 20 * count; ++tries) {
    if (map.edit(next(map)).edit) ++done;
  }
  return done;
}

bool RandomOperator::undo_all(GeometricMap& map, bool in_random_order) {
  for (;;) {
    std::vector<std::int64_t> left;
    for (const auto& [number, entry] : map.history().edits().entries()) {
      const EditKind kind = entry.edit->kind;
      const bool is_undoable = kind != EditKind::kUndo && kind != EditKind::kRedo;
      if (is_undoable && !entry.is_undone) left.push_back(number);
    }
    if (left.empty()) return true;
    EditCommand undo{.kind = EditKind::kUndo, .author = "ann", .command = ++command_};
    if (in_random_order) undo.edits = {left[static_cast<std::size_t>(below(left.size()))]};
    if (!map.edit(undo).edit) return false;
  }
}

}  // namespace geomap::testing
