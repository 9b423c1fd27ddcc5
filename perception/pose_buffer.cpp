// SPDX-License-Identifier: BSD-3-Clause
#include "perception/pose_buffer.hpp"

#include <algorithm>

#include "perception/rigid_transform.hpp"

namespace geomap::perception {

bool PoseBuffer::add(std::int64_t utime, const Eigen::Isometry3d& T) {
  ++counts_.received;
  if (!is_valid_utime(utime) || !is_rigid(T)) {
    ++counts_.invalid;
    return false;
  }
  bool restarted = false;
  if (!samples_.empty() && utime <= samples_.back().utime) {
    if (utime >= samples_.back().utime - kRestartAfter) {
      ++counts_.out_of_order;
      return false;
    }
    ++counts_.restarts;
    samples_.clear();
    restarted = true;
  }
  const bool connected = !samples_.empty() && connects(samples_.back(), utime, T);
  samples_.push_back({utime, T, connected});
  if (samples_.size() > kCapacity) {
    samples_.pop_front();
    samples_.front().connected = false;
  }
  return restarted;
}

bool PoseBuffer::connects(const Sample& before, std::int64_t utime, const Eigen::Isometry3d& T) {
  if (utime - before.utime > limits_.max_gap) return false;
  const bool jumped = (T.translation() - before.T.translation()).norm() > limits_.jump_distance ||
                      angle_between(before.T, T) > limits_.jump_angle;
  if (jumped) ++counts_.jumps;
  return !jumped;
}

std::size_t PoseBuffer::first_at_or_after(std::int64_t utime) const {
  const auto found =
      std::lower_bound(samples_.begin(), samples_.end(), utime,
                       [](const Sample& sample, std::int64_t t) { return sample.utime < t; });
  return static_cast<std::size_t>(found - samples_.begin());
}

PoseBuffer::Estimate PoseBuffer::extrapolate(std::size_t anchor, std::size_t neighbour,
                                             bool connected, std::int64_t utime) const {
  const Sample& a = samples_[anchor];
  if (!connected) return {a.T, Source::kHeld};
  const Sample& b = samples_[neighbour];
  const double fraction =
      static_cast<double>(utime - a.utime) / static_cast<double>(b.utime - a.utime);
  return {interpolate(a.T, b.T, fraction), Source::kExtrapolated};
}

std::optional<PoseBuffer::Estimate> PoseBuffer::at(std::int64_t utime) const {
  const std::size_t after = first_at_or_after(utime);
  const bool has_after = after < samples_.size();
  if (has_after && samples_[after].utime == utime) {
    return Estimate{samples_[after].T, Source::kInterpolated};
  }
  if (has_after && after > 0 && samples_[after].connected) {
    const Sample& a = samples_[after - 1];
    const Sample& b = samples_[after];
    const double fraction =
        static_cast<double>(utime - a.utime) / static_cast<double>(b.utime - a.utime);
    return Estimate{interpolate(a.T, b.T, fraction), Source::kInterpolated};
  }
  constexpr std::int64_t kNever = INT64_MAX;
  const std::int64_t since = after > 0 ? utime - samples_[after - 1].utime : kNever;
  const std::int64_t until = has_after ? samples_[after].utime - utime : kNever;
  if (std::min(since, until) > limits_.max_gap) return std::nullopt;
  if (since <= until) {
    return extrapolate(after - 1, after - 2, samples_[after - 1].connected, utime);
  }
  const bool connected = after + 1 < samples_.size() && samples_[after + 1].connected;
  return extrapolate(after, after + 1, connected, utime);
}

std::optional<Eigen::Isometry3d> PoseBuffer::latest_until(std::int64_t utime) const {
  std::size_t after = first_at_or_after(utime);
  if (after < samples_.size() && samples_[after].utime == utime) ++after;
  if (after == 0) return std::nullopt;
  return samples_[after - 1].T;
}

}  // namespace geomap::perception
