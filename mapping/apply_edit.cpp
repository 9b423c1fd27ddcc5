// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/apply_edit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "geometry/angles.hpp"
#include "geometry/polygon_clip.hpp"
#include "mapping/drawn_polygon.hpp"
#include "mapping/map_event.hpp"

namespace geomap::mapping {
namespace {

constexpr const char* kOutOfReach = "it would reach farther than a map can hold";
constexpr double kLargestMergeAngleDeg = 30.0;  // of what can be one plane at all

std::int64_t count_common(std::span<const ObservationId> a, std::span<const ObservationId> b) {
  std::int64_t count = 0;
  auto i = a.begin();
  auto j = b.begin();
  while (i != a.end() && j != b.end()) {
    if (*i == *j) ++count;
    const bool steps_a = *i <= *j;
    const bool steps_b = *j <= *i;
    if (steps_a) ++i;
    if (steps_b) ++j;
  }
  return count;
}

// One application of one edit. Everything is decided before anything is changed.
class Application {
 public:
  Application(const Edit& edit, const Eigen::Isometry3d& T_world_anchor, const Merger& merger,
              const MergeConfig& config, MapState& state)
      : edit_(edit),
        T_world_anchor_(T_world_anchor),
        merger_(merger),
        config_(config),
        state_(state) {
    std::set<FeatureId> found;
    for (const auto& target : edit.targets) {
      if (const auto id = holder_of(target, state.store.features())) found.insert(*id);
    }
    targets_.assign(found.begin(), found.end());
  }

  std::string run() {
    if (edit_.kind == EditKind::kAdd) return add();
    if (targets_.empty()) return "what it speaks of is gone";
    switch (edit_.kind) {
      case EditKind::kDelete:
        return remove();
      case EditKind::kMove:
        return move();
      case EditKind::kMerge:
        return merge();
      case EditKind::kLabel:
        return label();
      case EditKind::kLock:
        return lock();
      case EditKind::kSplit:
        return split();
      case EditKind::kCut:
        return cut();
      default:
        return "it is no edit of a feature";
    }
  }

 private:
  const MapFeature& at(const FeatureId& id) const { return state_.store.at(id); }

  std::vector<Eigen::Vector3d> world_points() const {
    std::vector<Eigen::Vector3d> points;
    for (const Eigen::Vector3d& point : edit_.points) points.push_back(T_world_anchor_ * point);
    return points;
  }

  // What is held already lies where nothing observed it, or is closed to observations.
  void close_to_observations(const MapFeature& feature, VetoCause cause) {
    if (feature.is_held()) return;
    add_veto(edit_.number, cause, feature, config_, state_.vetoes);
  }

  // Where a held feature was put, something else may be seen once it is gone from there.
  void open_place_of(const FeatureId& id) {
    std::erase_if(state_.vetoes, [&](const auto& veto) {
      return veto.first.feature == id && veto.first.cause == VetoCause::kPlaced;
    });
  }

  void put_held(MapFeature feature) {
    feature.held_by.push_back(edit_.number);
    state_.store.put(std::move(feature));
  }

  std::string remove() {
    for (const FeatureId& id : targets_) {
      close_to_observations(at(id), VetoCause::kDeleted);
      open_place_of(id);
      state_.store.erase(id);
    }
    return "";
  }

  std::string move() {
    const Eigen::Isometry3d T_world_moved =
        T_world_anchor_ * edit_.T_anchor_moved * T_world_anchor_.inverse();
    std::vector<MapFeature> moved;
    for (const FeatureId& id : targets_) {
      moved.push_back(at(id));
      moved.back().surface = moved.back().surface.transformed(T_world_moved);
      if (find_fault(moved.back().surface) != EventFault::kNone) return kOutOfReach;
    }
    for (MapFeature& feature : moved) {
      close_to_observations(at(feature.id), VetoCause::kObserved);
      open_place_of(feature.id);
      add_veto(edit_.number, VetoCause::kPlaced, feature, config_, state_.vetoes);
      put_held(std::move(feature));
    }
    return "";
  }

  std::string merge() {
    if (targets_.size() < 2) return "its features are one already";
    const MapFeature& oldest = at(targets_.front());
    for (const FeatureId& id : targets_) {
      const double angle = std::acos(
          std::clamp(oldest.surface.plane.normal.dot(at(id).surface.plane.normal), -1.0, 1.0));
      if (angle > geometry::radians(kLargestMergeAngleDeg)) {
        return fmt::format("{} and {} face {:.0f} degrees apart", to_string(oldest.id),
                           to_string(id), geometry::degrees(angle));
      }
    }
    MapFeature all = oldest;
    std::set<std::int64_t> holders(oldest.held_by.begin(), oldest.held_by.end());
    for (const FeatureId& id : targets_) {
      if (id == oldest.id) continue;
      all = merger_.merge(all, at(id));
      holders.insert(at(id).held_by.begin(), at(id).held_by.end());
    }
    if (find_fault(all.surface) != EventFault::kNone) return kOutOfReach;
    if (!holders.empty()) {  // what one of them was spared, all of it is
      for (const FeatureId& id : targets_) close_to_observations(at(id), VetoCause::kObserved);
      holders.insert(edit_.number);
    }
    all.held_by.assign(holders.begin(), holders.end());
    for (const FeatureId& id : targets_) state_.store.erase(id);
    state_.store.put(std::move(all));
    return "";
  }

  std::string label() {
    for (const FeatureId& id : targets_) {
      MapFeature feature = at(id);
      feature.label = edit_.label;
      feature.label_edit = edit_.number;
      feature.other_labels.clear();
      state_.store.put(std::move(feature));
    }
    return "";
  }

  std::string lock() {
    std::erase_if(targets_, [this](const FeatureId& id) { return at(id).is_held(); });
    if (targets_.empty()) return "it is held already";
    for (const FeatureId& id : targets_) {
      close_to_observations(at(id), VetoCause::kObserved);
      put_held(at(id));
    }
    return "";
  }

  std::string split() {
    const MapFeature& feature = at(targets_.front());
    const geometry::Polygon& polygon = feature.surface.polygon;
    const std::vector<Eigen::Vector3d> line = world_points();
    const geometry::Polygon half = left_of(line.at(0), line.at(1), feature.surface.frame, polygon);
    MapFeature first = feature, second = feature;
    first.surface.polygon = geometry::intersect(polygon, half);
    second.surface.polygon = geometry::subtract(polygon, half);
    const double smaller =
        std::min(geometry::area(first.surface.polygon), geometry::area(second.surface.polygon));
    if (smaller < kLeastDrawnArea) return "the line does not cross the surface";
    second.id = made_by(edit_, 0);
    second.observations = {second.id};
    close_to_observations(feature, VetoCause::kObserved);
    put_held(std::move(first));
    put_held(std::move(second));
    return "";
  }

  std::string cut() {
    const MapFeature& feature = at(targets_.front());
    const geometry::Polygon drawn = drawn_in_frame(world_points(), feature.surface.frame);
    MapFeature piece = feature, rest = feature;
    piece.surface.polygon = geometry::intersect(feature.surface.polygon, drawn);
    if (geometry::area(piece.surface.polygon) < kLeastDrawnArea) {
      return "the polygon does not meet the surface";
    }
    rest.surface.polygon = geometry::subtract(feature.surface.polygon, drawn);
    if (geometry::area(rest.surface.polygon) < kLeastDrawnArea) {
      return "nothing would be left: delete it instead";
    }
    close_to_observations(piece, VetoCause::kDeleted);
    state_.store.put(std::move(rest));
    return "";
  }

  std::string add() {
    auto feature = drawn_feature(made_by(edit_, 0), world_points(), config_);
    if (!feature) return "the corners make no plane polygon";
    if (find_fault(feature->surface) != EventFault::kNone) return kOutOfReach;
    if (!edit_.label.empty()) {
      feature->label = edit_.label;
      feature->label_edit = edit_.number;
    }
    close_to_observations(*feature, VetoCause::kPlaced);
    put_held(std::move(*feature));
    return "";
  }

  const Edit& edit_;
  const Eigen::Isometry3d& T_world_anchor_;
  const Merger& merger_;
  const MergeConfig& config_;
  MapState& state_;
  std::vector<FeatureId> targets_;  // that are there, ascending
};

}  // namespace

std::optional<FeatureId> holder_of(std::span<const ObservationId> observations,
                                   const FeatureSet& features) {
  std::optional<FeatureId> best;
  std::int64_t most = 0;
  for (const auto& [id, feature] : features) {
    const std::int64_t count = count_common(observations, feature->observations);
    if (count <= most) continue;
    most = count;
    best = id;
  }
  return best;
}

std::string apply_edit(const Edit& edit, const Eigen::Isometry3d& T_world_anchor,
                       const Merger& merger, const MergeConfig& config, MapState& state) {
  try {
    return Application(edit, T_world_anchor, merger, config, state).run();
  } catch (const std::logic_error& error) {  // numbers beyond what polygons can have
    return fmt::format("it cannot be done: {}", error.what());
  }
}

}  // namespace geomap::mapping
