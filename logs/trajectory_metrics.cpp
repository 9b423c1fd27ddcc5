// SPDX-License-Identifier: BSD-3-Clause
#include "logs/trajectory_metrics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "drivers/tum_files.hpp"

namespace geomap::logs {
namespace {

constexpr double kLongestDifference = 10.0;         // [s]
constexpr std::size_t kFewestPairs = 3;             // less does not fix a rotation
constexpr std::int64_t kSecond = 1'000'000;         // [us]
constexpr std::int64_t kSecondTolerance = 250'000;  // [us]
// Ten steps of 0.1 m are a metre, whatever their sum rounds to.
constexpr double kMetre = 1.0 - 1e-9;

using IndexPairs = std::vector<std::pair<std::size_t, std::size_t>>;

std::vector<std::int64_t> utimes_of(const Trajectory& trajectory) {
  std::vector<std::int64_t> utimes;
  for (const auto& [utime, T] : trajectory) utimes.push_back(utime);
  return utimes;
}

PoseDifference difference(const Eigen::Isometry3d& T) {
  return {T.translation().norm(), Eigen::AngleAxisd(T.linear()).angle()};
}

AbsoluteError error_after(const Eigen::Isometry3d& T_reference_estimate,
                          const std::vector<PosePair>& pairs) {
  AbsoluteError result;
  result.T_reference_estimate = T_reference_estimate;
  for (const PosePair& pair : pairs) {
    const Eigen::Vector3d moved = T_reference_estimate * pair.T_world_estimate.translation();
    result.errors.push_back((moved - pair.T_world_reference.translation()).norm());
  }
  result.statistics = error_statistics(result.errors);
  return result;
}

RelativeError error_between(const std::vector<PosePair>& pairs, const IndexPairs& steps) {
  std::vector<double> translations;
  std::vector<double> rotations;
  for (const auto& [i, j] : steps) {
    const Eigen::Isometry3d P = pairs[i].T_world_estimate.inverse() * pairs[j].T_world_estimate;
    const Eigen::Isometry3d Q = pairs[i].T_world_reference.inverse() * pairs[j].T_world_reference;
    const PoseDifference error = difference(Q.inverse() * P);
    translations.push_back(error.translation);
    rotations.push_back(error.rotation);
  }
  return {error_statistics(std::move(translations)), error_statistics(std::move(rotations))};
}

}  // namespace

ErrorStatistics error_statistics(std::vector<double> errors) {
  if (errors.empty()) return {};
  std::sort(errors.begin(), errors.end());
  const auto count = static_cast<double>(errors.size());
  ErrorStatistics result;
  result.count = errors.size();
  result.mean = std::accumulate(errors.begin(), errors.end(), 0.0) / count;
  result.median = (errors[(errors.size() - 1) / 2] + errors[errors.size() / 2]) / 2.0;
  result.max = errors.back();
  double squares = 0.0;
  double squares_about_mean = 0.0;
  for (const double error : errors) {
    squares += error * error;
    squares_about_mean += (error - result.mean) * (error - result.mean);
  }
  result.rmse = std::sqrt(squares / count);
  result.deviation = std::sqrt(squares_about_mean / count);
  return result;
}

std::vector<PosePair> match_poses(const Trajectory& estimate, const Trajectory& reference,
                                  double max_difference) {
  if (!(max_difference > 0.0 && max_difference <= kLongestDifference)) {
    throw std::invalid_argument(
        fmt::format("the time difference between matched poses must be above 0 and at most {} s",
                    kLongestDifference));
  }
  const auto max_gap = static_cast<std::int64_t>(std::llround(1e6 * max_difference));
  std::vector<PosePair> pairs;
  for (const auto& [i, k] :
       drivers::associate(utimes_of(estimate), utimes_of(reference), max_gap)) {
    pairs.push_back({reference[k].first, estimate[i].second, reference[k].second});
  }
  // Pairs farther apart than the poses of a trajectory may cross.
  std::sort(pairs.begin(), pairs.end(),
            [](const PosePair& a, const PosePair& b) { return a.utime < b.utime; });
  return pairs;
}

AbsoluteError aligned_error(const std::vector<PosePair>& pairs) {
  if (pairs.empty()) return {};
  Eigen::Matrix3Xd estimate(3, static_cast<Eigen::Index>(pairs.size()));
  Eigen::Matrix3Xd reference(3, estimate.cols());
  for (Eigen::Index i = 0; i < estimate.cols(); ++i) {
    const PosePair& pair = pairs[static_cast<std::size_t>(i)];
    estimate.col(i) = pair.T_world_estimate.translation();
    reference.col(i) = pair.T_world_reference.translation();
  }
  constexpr bool kWithScaling = false;
  return error_after(Eigen::Isometry3d(Eigen::umeyama(estimate, reference, kWithScaling)), pairs);
}

AbsoluteError anchored_error(const std::vector<PosePair>& pairs) {
  if (pairs.empty()) return {};
  const PosePair& first = pairs.front();
  return error_after(first.T_world_reference * first.T_world_estimate.inverse(), pairs);
}

RelativeError error_per_second(const std::vector<PosePair>& pairs) {
  IndexPairs steps;
  std::size_t j = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::int64_t wanted = pairs[i].utime + kSecond;
    if (wanted > pairs.back().utime) break;
    const auto gap = [&](std::size_t k) { return std::abs(pairs[k].utime - wanted); };
    while (j + 1 < pairs.size() && gap(j + 1) < gap(j)) ++j;
    if (gap(j) <= kSecondTolerance) steps.emplace_back(i, j);
  }
  return error_between(pairs, steps);
}

RelativeError error_per_metre(const std::vector<PosePair>& pairs) {
  std::vector<double> path(pairs.size(), 0.0);  // length up to each pair [m]
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    path[i] = path[i - 1] + (pairs[i].T_world_reference.translation() -
                             pairs[i - 1].T_world_reference.translation())
                                .norm();
  }
  IndexPairs steps;
  for (std::size_t i = 0, j = 0; i < pairs.size(); ++i) {
    while (j < pairs.size() && path[j] - path[i] < kMetre) ++j;
    if (j == pairs.size()) break;
    steps.emplace_back(i, j);
  }
  return error_between(pairs, steps);
}

TrajectoryMetrics compare_trajectories(const Trajectory& estimate, const Trajectory& reference,
                                       double max_difference) {
  TrajectoryMetrics metrics;
  metrics.pairs = match_poses(estimate, reference, max_difference);
  if (metrics.pairs.size() < kFewestPairs) {
    throw std::runtime_error(fmt::format(
        "only {} of {} poses match one of the reference's {} within {} s, and {} are needed: check "
        "that both have the same clock, or allow a larger difference",
        metrics.pairs.size(), estimate.size(), reference.size(), max_difference, kFewestPairs));
  }
  metrics.aligned = aligned_error(metrics.pairs);
  metrics.anchored = anchored_error(metrics.pairs);
  const PosePair& last = metrics.pairs.back();
  metrics.end = difference(last.T_world_reference.inverse() *
                           metrics.anchored.T_reference_estimate * last.T_world_estimate);
  metrics.per_second = error_per_second(metrics.pairs);
  metrics.per_metre = error_per_metre(metrics.pairs);
  return metrics;
}

}  // namespace geomap::logs
