// SPDX-License-Identifier: BSD-3-Clause
#include "perception/voxel_rows.hpp"

#include "geometry/multiversion.hpp"
#include "geometry/rgbd_frame.hpp"

namespace geomap::perception {
namespace {

[[gnu::always_inline]] inline std::int32_t rounded_down(double value) {
  const auto whole = static_cast<std::int32_t>(value);
  return whole - (value < whole ? 1 : 0);
}

}  // namespace

GEOMAP_MULTIVERSION void place_readings(const VoxelRow& row,
                                        const std::uint16_t* __restrict millimetres, int count,
                                        const std::array<std::int32_t*, 3>& places,
                                        std::uint8_t* __restrict counts) {
  const VoxelRow r = row;
  std::int32_t* __restrict x = places[0], * __restrict y = places[1], * __restrict z = places[2];
#pragma GCC ivdep
  for (int u = 0; u < count; ++u) {
    const double mm = millimetres[u];
    x[u] = rounded_down(r.origin[0] + mm * (r.ray[0] + u * r.step[0]));
    y[u] = rounded_down(r.origin[1] + mm * (r.ray[1] + u * r.step[1]));
    z[u] = rounded_down(r.origin[2] + mm * (r.ray[2] + u * r.step[2]));
  }
  for (int u = 0; u < count; ++u) {
    const int mm = millimetres[u];
    counts[u] = (mm != geometry::DepthImage::kNoReading) & (mm != geometry::DepthImage::kInvalid) &
                (mm >= r.nearest) & (mm <= r.farthest);
  }
}

}  // namespace geomap::perception
