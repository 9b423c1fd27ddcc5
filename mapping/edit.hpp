// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mapping/map_feature.hpp"

namespace geomap::mapping {

/// @brief What an operator can do to a map.
enum class EditKind : std::int8_t {
  kDelete,        // takes features out and keeps their surfaces out
  kMove,          // moves features, and holds them there
  kMerge,         // makes one feature of several
  kLabel,         // gives features a label
  kLock,          // holds features as they are
  kUnlock,        // lets go of held features: they are again what is observed
  kDropKeyframe,  // takes out everything that a key frame contributed
  kSplit,         // cuts a feature in two along a line; both are held
  kCut,           // takes a polygon out of a feature and keeps it out
  kAdd,           // puts in a polygon that was drawn by hand, and holds it
  kRestore,       // lets the surfaces come back that deletions and cuts keep out
  kUndo,          // makes edits as if they had never been
  kRedo,          // makes undone edits again
};
inline constexpr EditKind kLastEditKind = EditKind::kRedo;

/// @brief "delete", "drop key frame", ...
std::string to_string(EditKind kind);

/// @brief True for an edit that only speaks of other edits.
bool is_about_edits(EditKind kind);
/// @brief True for an edit of features, which counts from its place among the key frames on.
bool has_place_in_fold(EditKind kind);

/// @brief Most that one edit may hold.
inline constexpr std::size_t kMostTargets = 1000, kMostCorners = 1000, kMostEdits = 1000;
inline constexpr std::size_t kLongestLabel = 100, kLongestAuthor = 100;  // [byte]

/// @brief What an operator asks for, in terms of the map that he sees. World frame, metres.
struct EditCommand {
  EditKind kind = EditKind::kDelete;
  std::string author = {};   // who: name and host
  std::int64_t command = 0;  // his number of it; the same one twice is done once; 0: has none
  std::int64_t utime = 0;    // his clock [us]; nothing is decided by it
  std::vector<FeatureId> targets = {};
  /// Of kMove: maps a target's points to where they shall be.
  Eigen::Isometry3d T_world_moved = Eigen::Isometry3d::Identity();
  /// Of kSplit: two points of the line. Of kCut and kAdd: the corners, of kAdd counter-clockwise as
  /// seen from where the surface is visible.
  std::vector<Eigen::Vector3d> points = {};
  std::string label = {};     // of kLabel and kAdd; empty: none
  std::int64_t keyframe = 0;  // of kDropKeyframe: id [us]
  /// Of kRestore, kUndo and kRedo: numbers. None: of kUndo the newest, of kRedo the last undone.
  std::vector<std::int64_t> edits = {};
};

/// @brief An edit as the map keeps it, for good: what it speaks of is named by observations and
/// placed in the camera frame of a key frame, so that it follows when poses are corrected or
/// features get another id.
struct Edit {
  std::int64_t number = 0;  // in the map, from 1
  std::int64_t after = 0;   // newest key frame in the map when it was made [us]
  EditKind kind = EditKind::kDelete;
  std::string author;
  std::int64_t command = 0;
  std::int64_t utime = 0;
  std::vector<std::vector<ObservationId>> targets;  // of each one the observations, ascending
  std::int64_t anchor = 0;                          // key frame that the geometry hangs on [us]
  Eigen::Isometry3d T_world_anchor = Eigen::Isometry3d::Identity();  // its camera, at that time
  Eigen::Isometry3d T_anchor_moved = Eigen::Isometry3d::Identity();  // as T_world_moved
  std::vector<Eigen::Vector3d> points;                               // anchor's camera frame
  std::string label;
  std::int64_t keyframe = 0;
  std::vector<std::int64_t> edits;  // also of kUnlock: those that hold the targets
};

/// @brief Id of the n-th feature that an edit makes, as an observation by hand: no camera's planes
/// have negative numbers. n from 0, below kMostMade.
FeatureId made_by(const Edit& edit, int n);
inline constexpr std::int64_t kMostMade = 1000;

/// @brief What is wrong with a command in its own right, in words; empty when nothing is.
std::string find_fault(const EditCommand& command);

}  // namespace geomap::mapping
