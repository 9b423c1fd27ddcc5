// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include "perception/point_map.hpp"

namespace geomap::testing {

/// @brief Two point maps that are equal to the last bit.
inline void expect_same(const perception::PointMap& a, const perception::PointMap& b) {
  const auto points_a = a.points();
  const auto points_b = b.points();
  ASSERT_EQ(points_a.size(), points_b.size());
  for (std::size_t i = 0; i < points_a.size(); ++i) {
    EXPECT_EQ(points_a[i].position, points_b[i].position);
    EXPECT_EQ(points_a[i].covariance, points_b[i].covariance);
    EXPECT_EQ(points_a[i].color, points_b[i].color);
  }
  EXPECT_EQ(a.keyframes(), b.keyframes());
  EXPECT_EQ(a.memory_bytes(), b.memory_bytes());
}

}  // namespace geomap::testing
