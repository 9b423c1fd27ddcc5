// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

namespace geomap::perception {

/// @brief An input whose utime goes back by more than this has started anew (a log played again, a
/// clock set back); less is a message out of order [us].
constexpr std::int64_t kRestartAfter = 1'000'000;

/// @brief True for a time stamp that a sensor can have: from 1970 on, and far enough from the ends
/// of the type that differences do not overflow.
constexpr bool is_valid_utime(std::int64_t utime) {
  return utime >= 0 && utime < (std::int64_t{1} << 62);
}

/// @brief What a buffer has been fed.
struct PoseBufferCounts {
  std::int64_t received = 0;
  std::int64_t invalid = 0;       // not finite, not rigid or an impossible utime: ignored
  std::int64_t out_of_order = 0;  // not later than the one before: ignored
  std::int64_t restarts = 0;      // time went back by more than kRestartAfter: buffer emptied first
  std::int64_t jumps = 0;         // farther from the one before than a body can move
};

struct PoseBufferLimits {
  std::int64_t max_gap = 100'000;  // [us]
  double jump_distance = 0.3;      // [m]
  double jump_angle = 0.785;       // [rad]
};

/// @brief The last poses of one moving frame, by time, bounded. Consecutive poses are *connected*
/// when at most max_gap apart and without a jump in between: only along connected poses is motion
/// assumed.
class PoseBuffer {
 public:
  static constexpr std::size_t kCapacity = 4096;  // 20 s at 200 Hz

  enum class Source { kInterpolated, kExtrapolated, kHeld };
  struct Estimate {
    Eigen::Isometry3d T;
    Source source;
  };

  explicit PoseBuffer(const PoseBufferLimits& limits) : limits_(limits) {}

  /// @return true when the stream has restarted with this pose.
  bool add(std::int64_t utime, const Eigen::Isometry3d& T);

  bool empty() const { return samples_.empty(); }
  std::int64_t oldest_utime() const { return samples_.front().utime; }
  std::int64_t newest_utime() const { return samples_.back().utime; }

  /// @brief Exact or between two connected poses, else at constant velocity from the nearest pose
  /// at most max_gap away (the earlier one of two equally near), else nothing.
  std::optional<Estimate> at(std::int64_t utime) const;

  /// @brief The last pose at or before `utime`, however old.
  std::optional<Eigen::Isometry3d> latest_until(std::int64_t utime) const;

  const PoseBufferCounts& counts() const { return counts_; }

 private:
  struct Sample {
    std::int64_t utime;
    Eigen::Isometry3d T;
    bool connected;  // to the sample before
  };

  bool connects(const Sample& before, std::int64_t utime, const Eigen::Isometry3d& T);
  std::size_t first_at_or_after(std::int64_t utime) const;
  Estimate extrapolate(std::size_t anchor, std::size_t neighbour, bool connected,
                       std::int64_t utime) const;

  PoseBufferLimits limits_;
  std::deque<Sample> samples_;  // ascending in utime
  PoseBufferCounts counts_;
};

}  // namespace geomap::perception
