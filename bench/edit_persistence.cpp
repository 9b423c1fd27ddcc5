// SPDX-License-Identifier: BSD-3-Clause
// Do edits survive further mapping? Each feature of a map is deleted, or moved, after the first
// drive; then come the key frames of further drives through the same place.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/polygon_clip.hpp"
#include "mapping/geometric_map.hpp"
#include "mapping/map_hash.hpp"
#include "mapping/map_journal.hpp"
#include "messaging/program.hpp"

namespace {

using namespace geomap;
using mapping::EditKind;
using mapping::GeometricMap;
using mapping::MapFeature;
using mapping::Observation;
using Drive = std::vector<std::shared_ptr<const Observation>>;

constexpr double kNear = 0.08;        // of a plane that would be the deleted one again [m]
constexpr double kLeastCosine = 0.9;  // of its normal

Drive drive_of(const std::string& file, std::int64_t& next) {
  Drive drive;
  for (const mapping::MapEvent& event : mapping::load_map(file).events) {
    const auto* seen = std::get_if<std::shared_ptr<const Observation>>(&event);
    if (seen == nullptr) continue;
    auto copy = std::make_shared<Observation>(**seen);
    copy->keyframe = next += 33'333;
    drive.push_back(std::move(copy));
  }
  return drive;
}

GeometricMap folded(const Drive& drive) {
  GeometricMap map(mapping::MergeConfig{}, mapping::HistoryConfig{});
  for (const auto& observation : drive) map.apply(observation);
  return map;
}

// Area [m²] of the old surface that features cover again.
double covered_again(const MapFeature& old, const GeometricMap& map) {
  double area = 0.0;
  for (const auto& [id, feature] : map.features()) {
    const geometry::PlanarPolygon& surface = feature->surface;
    if (surface.plane.normal.dot(old.surface.plane.normal) < kLeastCosine) continue;
    const geometry::Polygon common =
        geometry::intersect(old.surface.polygon, surface.in_frame(old.surface.frame));
    if (common.empty()) continue;
    const Eigen::Vector3d middle = old.surface.lift(geometry::area_moments(common).centroid);
    if (std::abs(surface.plane.signed_distance(middle)) < kNear) area += geometry::area(common);
  }
  return area;
}

int run(const std::vector<std::string>& maps) {
  std::int64_t next = 1'000'000;
  const GeometricMap before = folded(drive_of(maps.front(), next));
  Drive later;
  for (std::size_t i = 1; i < maps.size(); ++i) {
    const Drive drive = drive_of(maps[i], next);
    later.insert(later.end(), drive.begin(), drive.end());
  }
  GeometricMap never = before;
  for (const auto& observation : later) never.apply(observation);
  const std::string never_hash = map_hash(never.features(), never.vetoes());
  std::printf("%zu features; %zu further key frames, then %zu features without an edit\n",
              before.features().size(), later.size(), never.features().size());
  std::printf("%-24s %8s %12s %10s %10s %10s\n", "feature", "area m2", "covered m2", "features",
              "restored", "unlocked");
  bool is_good = true;
  for (const auto& [id, feature] : before.features()) {
    GeometricMap deleted = before, moved = before;
    const auto edit = deleted.edit({.kind = EditKind::kDelete, .targets = {id}});
    Eigen::Isometry3d T_world_moved = Eigen::Isometry3d::Identity();
    T_world_moved.translation() = Eigen::Vector3d(0.1, -0.2, 0.05);
    moved.edit({.kind = EditKind::kMove, .targets = {id}, .T_world_moved = T_world_moved});
    const std::string put = mapping::map_hash({{id, moved.features().at(id)}});
    for (const auto& observation : later) {
      deleted.apply(observation);
      moved.apply(observation);
    }
    const double covered = covered_again(*feature, deleted);
    const std::size_t features = deleted.features().size();
    const bool is_held = mapping::map_hash({{id, moved.features().at(id)}}) == put;
    deleted.edit({.kind = EditKind::kRestore, .edits = {edit.edit->number}});
    moved.edit({.kind = EditKind::kUnlock, .targets = {id}});
    const bool is_restored = map_hash(deleted.features(), deleted.vetoes()) == never_hash;
    const bool is_unlocked = map_hash(moved.features(), moved.vetoes()) == never_hash;
    std::printf("%-24s %8.2f %12.4f %10zu %10s %10s\n", mapping::to_string(id).c_str(),
                geometry::area(feature->surface.polygon), covered, features,
                is_restored ? "yes" : "NO",
                !is_held      ? "MOVED"
                : is_unlocked ? "yes"
                              : "NO");
    is_good = is_good && is_restored && is_unlocked && is_held;
  }
  return is_good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> maps;
  return messaging::run_program(
      argc, argv,
      {.name = "edit_persistence",
       .description = "Deletes or moves each feature of the first map, sees the key frames of the "
                      "others, and tells what has come back.",
       .uses_config = false},
      [&](messaging::OptionParser& parser) {
        parser.positionals("MAP", maps, "saved maps of drives through the same place");
      },
      [&](const messaging::CommonOptions&) { return run(maps); });
}
