// SPDX-License-Identifier: BSD-3-Clause
#include "logs/run_statistics.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace geomap::logs {
namespace {

struct KnownSet {
  std::string_view name;
  std::string_view title;
};

constexpr std::array<KnownSet, 10> kSets = {{{"n0", "kitchen, no noise"},
                                             {"n005", "kitchen, noise 5 mm"},
                                             {"n02", "kitchen, noise 20 mm"},
                                             {"n0obj", "kitchen with objects"},
                                             {"kinect", "kitchen, Kinect's noise"},
                                             {"turn360", "kitchen, full turn, Kinect's noise"},
                                             {"redkitchen", "red kitchen, recorded"},
                                             {"corridor", "corridor"},
                                             {"office", "office"},
                                             {"kitchen_tables", "kitchen with tables"}}};

std::size_t rank(std::string_view set) {
  const auto found = std::find_if(kSets.begin(), kSets.end(),
                                  [&](const KnownSet& known) { return known.name == set; });
  return static_cast<std::size_t>(found - kSets.begin());
}

}  // namespace

std::vector<RunGroup> group_runs(const RunCollection& collection) {
  std::vector<RunGroup> groups;
  for (const Run& run : collection.runs) {
    const bool same =
        !groups.empty() && groups.back().set == run.set && groups.back().variant == run.variant;
    if (!same) groups.push_back({run.set, run.variant, {}});
    groups.back().runs.push_back(&run);
  }
  std::stable_sort(groups.begin(), groups.end(),
                   [](const RunGroup& a, const RunGroup& b) { return rank(a.set) < rank(b.set); });
  return groups;
}

std::vector<const RunGroup*> groups_of(std::span<const RunGroup> groups, std::string_view set) {
  std::vector<const RunGroup*> found;
  for (const RunGroup& group : groups) {
    if (group.set == set) found.push_back(&group);
  }
  return found;
}

std::vector<const RunGroup*> first_groups_of(std::span<const RunGroup> groups,
                                             std::initializer_list<std::string_view> sets) {
  for (const std::string_view set : sets) {
    std::vector<const RunGroup*> found = groups_of(groups, set);
    if (!found.empty()) return found;
  }
  return {};
}

const RunGroup* moments_group_of(std::span<const RunGroup> groups,
                                 std::initializer_list<std::string_view> sets) {
  for (const RunGroup* group : first_groups_of(groups, sets)) {
    if (group->uses_moments()) return group;
  }
  return nullptr;
}

std::string set_title(std::string_view set) {
  const std::size_t index = rank(set);
  return std::string(index < kSets.size() ? kSets.at(index).title : set);
}

std::optional<Spread> spread_of(std::span<const double> values) {
  if (values.empty()) return std::nullopt;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  return Spread{sum / static_cast<double>(values.size()), *least, *most, values.size()};
}

std::optional<Spread> spread_of(const RunGroup& group,
                                const std::function<std::optional<double>(const Run&)>& figure) {
  std::vector<double> values;
  for (const Run* run : group.runs) {
    if (const std::optional<double> value = figure(*run)) values.push_back(*value);
  }
  return spread_of(values);
}

std::optional<Spread> spread_of(const RunGroup& group,
                                std::optional<double> AccuracyFigures::*figure) {
  return spread_of(group, [&](const Run& run) { return run.figures.*figure; });
}

std::span<const FigureKind> paper_figures() {
  static constexpr std::array<FigureKind, 6> kKinds = {{
      {"d_coeff", "d_coeff", &AccuracyFigures::d_coeff, 1.0, 4},
      {"d_angle", "d_angle [rad]", &AccuracyFigures::d_angle, 1.0, 4},
      {"d_dist", "d_dist [mm]", &AccuracyFigures::d_dist, 1e3, 1},
      {"d_dist_local", "d_dist, local [mm]", &AccuracyFigures::d_dist_local, 1e3, 1},
      {"rms_p", "RMS_p [mm]", &AccuracyFigures::rms_p, 1e3, 1},
      {"reduction_ratio", "planes per feature", &AccuracyFigures::reduction_ratio, 1.0, 1},
  }};
  return kKinds;
}

std::span<const FigureKind> further_figures() {
  static constexpr std::array<FigureKind, 7> kKinds = {{
      {"recall", "recall", &AccuracyFigures::recall, 1.0, 3},
      {"precision", "precision", &AccuracyFigures::precision, 1.0, 3},
      {"features_per_component", "features per component", &AccuracyFigures::features_per_component,
       1.0, 2},
      {"area_iou", "area IoU", &AccuracyFigures::area_iou, 1.0, 3},
      {"hull_distance_mean", "outline, mean [mm]", &AccuracyFigures::hull_distance_mean, 1e3, 1},
      {"hull_distance_max", "outline, max [mm]", &AccuracyFigures::hull_distance_max, 1e3, 1},
      {"ate_rmse", "ATE rmse [mm]", &AccuracyFigures::ate_rmse, 1e3, 1},
  }};
  return kKinds;
}

std::optional<Spread> PlaneStatistics::spread(
    std::optional<double> AccuracyFigures::*figure) const {
  std::vector<double> values;
  for (const PlaneResult* result : results) {
    if (const std::optional<double>& value = result->figures.*figure) values.push_back(*value);
  }
  return spread_of(values);
}

std::optional<Spread> PlaneStatistics::features() const {
  std::vector<double> values;
  for (const PlaneResult* result : results) values.push_back(result->features);
  return spread_of(values);
}

std::vector<PlaneStatistics> planes_of(const RunGroup& group) {
  std::vector<PlaneStatistics> planes;
  for (const Run* run : group.runs) {
    for (const PlaneResult& result : run->planes) {
      if (!result.seen || result.components == 0.0) continue;
      const auto found =
          std::find_if(planes.begin(), planes.end(),
                       [&](const PlaneStatistics& plane) { return plane.name == result.name; });
      if (found == planes.end()) {
        planes.push_back({result.name, {&result}});
      } else {
        found->results.push_back(&result);
      }
    }
  }
  return planes;
}

}  // namespace geomap::logs
