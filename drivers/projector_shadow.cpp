// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/projector_shadow.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace geomap::drivers {
namespace {

constexpr int kNoColumn = std::numeric_limits<int>::min();

}  // namespace

ProjectorShadow::ProjectorShadow(int width, double focal_times_baseline)
    : width_(width),
      focal_times_baseline_(focal_times_baseline),
      shift_(static_cast<std::size_t>(width)),
      column_(static_cast<std::size_t>(width)),
      nearest_(static_cast<std::size_t>(2 * width + 1)) {}

// The projector sees a point of column u at u - focal_times_baseline / z: a depth buffer of its
// columns, with that shift in place of the depth.
void ProjectorShadow::find(std::span<const double> depth, std::span<std::uint8_t> shadowed) {
  std::fill(nearest_.begin(), nearest_.end(), 0.0);
  for (std::size_t u = 0; u < depth.size(); ++u) {
    column_[u] = kNoColumn;
    if (!(depth[u] * width_ > focal_times_baseline_)) continue;  // further left than the buffer
    shift_[u] = focal_times_baseline_ / depth[u];
    column_[u] = static_cast<int>(static_cast<double>(u) - shift_[u] + width_ + 0.5);
    double& nearest = nearest_[static_cast<std::size_t>(column_[u])];
    nearest = std::max(nearest, shift_[u]);
    // A surface that the projector sees wider than the camera must not let light through.
    if (u > 0 && column_[u - 1] == column_[u] - 2 && std::abs(shift_[u] - shift_[u - 1]) < 1.5) {
      double& between = nearest_[static_cast<std::size_t>(column_[u] - 1)];
      between = std::max(between, std::min(shift_[u - 1], shift_[u]));
    }
  }
  for (std::size_t u = 0; u < depth.size(); ++u) {
    // A shadow is as wide as the shifts differ: less than a pixel is none.
    shadowed[u] =
        column_[u] != kNoColumn && nearest_[static_cast<std::size_t>(column_[u])] > shift_[u] + 1.0;
  }
}

}  // namespace geomap::drivers
