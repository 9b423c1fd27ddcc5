// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "logs/run_statistics.hpp"

namespace geomap::logs {

enum class BoundKind { kAtMost, kAtLeast, kExactly };

std::string_view words_of(BoundKind kind);  // "at most", ...

/// @brief What every run of a set must reach with merging by moments.
struct Bound {
  std::string_view set;
  std::string_view figure;  // key of a FigureKind
  BoundKind kind = BoundKind::kAtMost;
  double value = 0.0;  // [m], [rad] or a ratio
};

std::span<const Bound> accuracy_bounds();

/// @brief A bound and the run that comes closest to breaking it, or breaks it the most.
struct BoundResult {
  Bound bound;
  std::string variant;
  std::string worst_seed;
  std::optional<double> worst;  // nothing where a run could not be measured
  bool met = false;
};

/// @brief The bounds of all sets that were run, for each variant that merges by moments.
std::vector<BoundResult> check_bounds(std::span<const RunGroup> groups);

/// @brief The figure with a key; throws std::invalid_argument for an unknown one.
const FigureKind& figure_kind(std::string_view key);

}  // namespace geomap::logs
