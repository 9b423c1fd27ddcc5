// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "logs/run_collection.hpp"

namespace geomap::logs {

/// @brief Mean and range of a figure over the runs that have it.
struct Spread {
  double mean = 0.0;
  double min = 0.0;
  double max = 0.0;
  std::size_t count = 0;
};

/// @brief The runs of one set and variant, by seed: at least one.
struct RunGroup {
  std::string set;
  std::string variant;
  std::vector<const Run*> runs;

  bool uses_moments() const { return variant.ends_with("moments"); }
};

/// @brief The runs by set (the paper's first, in its order; others by name) and variant. The
/// pointers live as long as the argument.
std::vector<RunGroup> group_runs(const RunCollection& collection);

/// @brief The groups of one set.
std::vector<const RunGroup*> groups_of(std::span<const RunGroup> groups, std::string_view set);

/// @brief The groups of the first of some sets that was run.
std::vector<const RunGroup*> first_groups_of(std::span<const RunGroup> groups,
                                             std::initializer_list<std::string_view> sets);

/// @brief Of these the first that merges by moments; null when there is none.
const RunGroup* moments_group_of(std::span<const RunGroup> groups,
                                 std::initializer_list<std::string_view> sets);

/// @brief What a set is, in a few words; its name for one that is not known.
std::string set_title(std::string_view set);

/// @brief Nothing when no value is given.
std::optional<Spread> spread_of(std::span<const double> values);

/// @brief Of one figure of each run; runs that do not have it are left out.
std::optional<Spread> spread_of(const RunGroup& group,
                                const std::function<std::optional<double>(const Run&)>& figure);

/// @brief Spread of one figure of accuracy.
std::optional<Spread> spread_of(const RunGroup& group,
                                std::optional<double> AccuracyFigures::*figure);

/// @brief A figure of accuracy: its key in evaluation.json, and how people read it.
struct FigureKind {
  const char* key;
  const char* title;  // with the unit shown
  std::optional<double> AccuracyFigures::*member;
  double scale = 1.0;  // from metres, radians or a ratio to the unit shown
  int decimals = 3;
};

/// @brief The figures of the paper's Table 1, d_dist_local added; the plane reduction ratio last.
std::span<const FigureKind> paper_figures();

/// @brief What the paper does not measure.
std::span<const FigureKind> further_figures();

/// @brief One true plane over the runs of a group.
struct PlaneStatistics {
  std::string name;
  std::vector<const PlaneResult*> results;  // of the runs that know the plane

  std::optional<Spread> spread(std::optional<double> AccuracyFigures::*figure) const;
  std::optional<Spread> features() const;
};

/// @brief The planes of which the camera saw enough in at least one run, in the order of the truth.
std::vector<PlaneStatistics> planes_of(const RunGroup& group);

}  // namespace geomap::logs
