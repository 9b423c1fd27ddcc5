// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/projector_shadow.hpp"

#include <algorithm>
#include <numeric>

namespace geomap::drivers {
namespace {

constexpr int kColumns = 320;
constexpr double kFocalTimesBaseline = 40.0;  // [pixel m]

using Row = std::vector<double>;

Row wall_row(double z) { return Row(kColumns, z); }

Row with_box(Row row, int first, int last, double z) {
  std::fill(row.begin() + first, row.begin() + last + 1, z);
  return row;
}

std::vector<std::uint8_t> shadows(const Row& depth) {
  std::vector<std::uint8_t> shadowed(depth.size());
  ProjectorShadow(kColumns, kFocalTimesBaseline).find(depth, shadowed);
  return shadowed;
}

// First and last column in the shadow.
std::pair<int, int> extent(const std::vector<std::uint8_t>& shadowed) {
  const auto first = std::find(shadowed.begin(), shadowed.end(), 1);
  const auto last = std::find(shadowed.rbegin(), shadowed.rend(), 1);
  return {static_cast<int>(first - shadowed.begin()), static_cast<int>(shadowed.rend() - last) - 1};
}

int count(const std::vector<std::uint8_t>& shadowed) {
  return std::accumulate(shadowed.begin(), shadowed.end(), 0);
}

TEST(ProjectorShadow, LiesAtTheLeftOfABoxAndIsAsWideAsTheDisparitiesDiffer) {
  for (const double near : {0.8, 1.0, 1.37, 1.9}) {
    const double width = kFocalTimesBaseline * (1.0 / near - 1.0 / 2.5);
    const auto shadowed = shadows(with_box(wall_row(2.5), 150, 250, near));
    EXPECT_NEAR(count(shadowed), width, 1.0) << near;
    EXPECT_EQ(extent(shadowed), std::pair(150 - count(shadowed), 149)) << near;
  }
}

TEST(ProjectorShadow, BehindAThinPoleThereIsLightOnBothSides) {
  // 40 pixels of disparity against 16: the shadow is as wide as the pole, 24 pixels to its left.
  const auto shadowed = shadows(with_box(wall_row(2.5), 200, 204, 1.0));
  EXPECT_EQ(extent(shadowed), std::pair(176, 180));
  EXPECT_EQ(count(shadowed), 5);
}

TEST(ProjectorShadow, ASmoothSurfaceHasNone) {
  Row depth(kColumns);
  for (const double slope : {-0.008, -0.002, 0.0, 0.002, 0.008}) {
    for (std::size_t u = 0; u < depth.size(); ++u) {
      depth[u] = 2.0 + slope * (static_cast<double>(u) - kColumns / 2);
    }
    EXPECT_EQ(count(shadows(depth)), 0) << slope;
  }
}

TEST(ProjectorShadow, ASlantedBoxLetsNoLightThrough) {
  Row depth = wall_row(4.0);  // disparity 10
  // The box's disparity falls from 50 to 30: the projector sees it 1.2 times as wide.
  for (int u = 200; u <= 300; ++u) {
    depth[static_cast<std::size_t>(u)] = kFocalTimesBaseline / (50.0 - 0.2 * (u - 200));
  }
  EXPECT_EQ(extent(shadows(depth)), std::pair(160, 199));
  EXPECT_EQ(count(shadows(depth)), 40);
}

TEST(ProjectorShadow, WithoutABaselineOrADepthThereIsNone) {
  std::vector<std::uint8_t> shadowed(kColumns, 1);
  ProjectorShadow(kColumns, 0.0).find(with_box(wall_row(2.0), 100, 200, 0.5), shadowed);
  EXPECT_EQ(count(shadowed), 0);
  EXPECT_EQ(count(shadows(wall_row(0.0))), 0);
}

TEST(ProjectorShadow, WhatIsTooNearForTheProjectorIsLeftAlone) {
  EXPECT_EQ(count(shadows(with_box(wall_row(2.0), 0, 100, 1e-9))), 0);
}

}  // namespace
}  // namespace geomap::drivers
