// SPDX-License-Identifier: BSD-3-Clause
#include "logs/evaluation_bounds.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace geomap::logs {
namespace {

constexpr double kExact = 1e-9;

// How far a value lies beyond the bound; negative or zero when it is met.
double excess(const Bound& bound, double value) {
  switch (bound.kind) {
    case BoundKind::kAtMost:
      return value - bound.value;
    case BoundKind::kAtLeast:
      return bound.value - value;
    case BoundKind::kExactly:
      return std::abs(value - bound.value);
  }
  return 0.0;
}

BoundResult check(const Bound& bound, const RunGroup& group) {
  const FigureKind& kind = figure_kind(bound.figure);
  BoundResult result{bound, group.variant, "", std::nullopt, false};
  double most = -std::numeric_limits<double>::infinity();
  for (const Run* run : group.runs) {
    const std::optional<double>& value = run->figures.*kind.member;
    if (!value) {
      result.worst_seed = run->seed;
      result.worst.reset();
      result.met = false;
      return result;
    }
    const double beyond = excess(bound, *value);
    if (beyond <= most) continue;
    most = beyond;
    result.worst = value;
    result.worst_seed = run->seed;
    result.met = beyond <= kExact;
  }
  return result;
}

}  // namespace

std::string_view words_of(BoundKind kind) {
  switch (kind) {
    case BoundKind::kAtMost:
      return "at most";
    case BoundKind::kAtLeast:
      return "at least";
    case BoundKind::kExactly:
      return "exactly";
  }
  return "";
}

std::span<const Bound> accuracy_bounds() {
  using enum BoundKind;
  static constexpr std::array<Bound, 33> kBounds = {{
      {"n0", "d_angle", kAtMost, 0.002},
      {"n0", "d_dist", kAtMost, 0.003},
      {"n0", "d_dist_local", kAtMost, 0.003},
      {"n0", "rms_p", kAtMost, 0.003},
      {"n0", "recall", kAtLeast, 1.0},
      {"n0", "precision", kAtLeast, 1.0},
      {"n0", "features_per_component", kExactly, 1.0},
      {"n0", "area_iou", kAtLeast, 0.92},
      {"n005", "d_angle", kAtMost, 0.003},
      {"n005", "d_dist", kAtMost, 0.006},
      {"n005", "d_dist_local", kAtMost, 0.006},
      {"n005", "rms_p", kAtMost, 0.005},
      {"n005", "recall", kAtLeast, 1.0},
      {"n005", "precision", kAtLeast, 1.0},
      {"n005", "features_per_component", kExactly, 1.0},
      {"n005", "area_iou", kAtLeast, 0.88},
      {"n02", "d_angle", kAtMost, 0.008},
      {"n02", "d_dist", kAtMost, 0.015},
      {"n02", "d_dist_local", kAtMost, 0.015},
      {"n02", "rms_p", kAtMost, 0.010},
      {"n02", "recall", kAtLeast, 1.0},
      {"n02", "precision", kAtLeast, 0.9},
      {"n02", "features_per_component", kAtMost, 1.2},
      {"n02", "area_iou", kAtLeast, 0.80},
      {"n0obj", "d_angle", kAtMost, 0.002},
      {"n0obj", "d_dist", kAtMost, 0.003},
      {"n0obj", "d_dist_local", kAtMost, 0.003},
      {"n0obj", "rms_p", kAtMost, 0.003},
      {"n0obj", "recall", kAtLeast, 1.0},
      {"n0obj", "precision", kAtLeast, 1.0},
      {"n0obj", "features_per_component", kExactly, 1.0},
      {"n0obj", "area_iou", kAtLeast, 0.92},
      {"kinect", "rms_p", kAtMost, 0.015},
  }};
  return kBounds;
}

std::vector<BoundResult> check_bounds(std::span<const RunGroup> groups) {
  std::vector<BoundResult> results;
  for (const RunGroup& group : groups) {
    if (!group.uses_moments()) continue;
    for (const Bound& bound : accuracy_bounds()) {
      if (bound.set == group.set) results.push_back(check(bound, group));
    }
  }
  return results;
}

const FigureKind& figure_kind(std::string_view key) {
  for (const auto& kinds : {paper_figures(), further_figures()}) {
    for (const FigureKind& kind : kinds) {
      if (kind.key == key) return kind;
    }
  }
  throw std::invalid_argument("figure_kind: no figure " + std::string(key));
}

}  // namespace geomap::logs
