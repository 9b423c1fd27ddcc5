// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/edit.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "mapping/clean_text.hpp"
#include "mapping/map_event.hpp"

namespace geomap::mapping {
namespace {

constexpr double kFarthestCorner = 1e6;  // from the world's origin [m]

constexpr std::array<std::string_view, 13> kNames = {
    "delete", "move", "merge", "label",   "lock", "unlock", "drop key frame",
    "split",  "cut",  "add",   "restore", "undo", "redo"};

std::string target_fault(const EditCommand& command) {
  const std::size_t count = command.targets.size();
  switch (command.kind) {
    case EditKind::kDelete:
    case EditKind::kMove:
    case EditKind::kLabel:
    case EditKind::kLock:
    case EditKind::kUnlock:
      return count == 0 ? "names no feature" : "";
    case EditKind::kMerge:
      return count < 2 ? "needs two features or more" : "";
    case EditKind::kSplit:
    case EditKind::kCut:
      return count != 1 ? "needs one feature" : "";
    default:
      return count != 0 ? "is not about features" : "";
  }
}

std::string point_fault(const EditCommand& command) {
  for (const Eigen::Vector3d& point : command.points) {
    if (!point.allFinite()) return "has a corner that is not finite";
    if (point.norm() > kFarthestCorner) return "has a corner that is out of range";
  }
  const std::size_t count = command.points.size();
  switch (command.kind) {
    case EditKind::kSplit:
      if (count != 2) return "needs the two ends of a line";
      return (command.points[0] - command.points[1]).norm() < 1e-3 ? "has a line of no length" : "";
    case EditKind::kCut:
    case EditKind::kAdd:
      return count < 3 ? "needs three corners or more" : "";
    default:
      return count != 0 ? "takes no corners" : "";
  }
}

std::string size_fault(const EditCommand& command) {
  if (command.targets.size() > kMostTargets) {
    return fmt::format("names over {} features", kMostTargets);
  }
  if (command.points.size() > kMostCorners) return fmt::format("has over {} corners", kMostCorners);
  if (command.edits.size() > kMostEdits) return fmt::format("names over {} edits", kMostEdits);
  if (command.label.size() > kLongestLabel) {
    return fmt::format("has a label of over {} bytes", kLongestLabel);
  }
  if (command.author.size() > kLongestAuthor) {
    return fmt::format("has an author of over {} bytes", kLongestAuthor);
  }
  for (const std::string& text : {command.label, command.author}) {
    if (clean_text(text) != text) return "has a text with control characters or invalid UTF-8";
  }
  return "";
}

}  // namespace

std::string to_string(EditKind kind) {
  return std::string(kNames.at(static_cast<std::size_t>(kind)));
}

bool is_about_edits(EditKind kind) {
  return kind == EditKind::kUnlock || kind == EditKind::kRestore || kind == EditKind::kUndo ||
         kind == EditKind::kRedo;
}

bool has_place_in_fold(EditKind kind) {
  return !is_about_edits(kind) && kind != EditKind::kDropKeyframe;
}

FeatureId made_by(const Edit& edit, int n) {
  return {edit.after, static_cast<std::int32_t>(-1 - n - kMostMade * (edit.number % 2'000'000))};
}

std::string find_fault(const EditCommand& command) {
  std::string fault = size_fault(command);
  if (fault.empty()) fault = target_fault(command);
  if (fault.empty()) fault = point_fault(command);
  if (fault.empty() && command.kind == EditKind::kMove) {
    const EventFault pose = find_fault(command.T_world_moved);
    if (pose != EventFault::kNone) fault = "has a motion that is " + to_string(pose);
  }
  if (fault.empty() && command.kind == EditKind::kRestore && command.edits.empty()) {
    fault = "names no edit";
  }
  return fault.empty() ? "" : to_string(command.kind) + " " + fault;
}

}  // namespace geomap::mapping
