// SPDX-License-Identifier: BSD-3-Clause
#include "perception/label_rings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <string>

namespace geomap::perception {
namespace {

// Letters are labels (a = 0), dots none.
std::vector<std::int16_t> image_of(const std::vector<std::string>& rows) {
  std::vector<std::int16_t> label;
  for (const std::string& row : rows) {
    for (const char c : row) label.push_back(static_cast<std::int16_t>(c == '.' ? -1 : c - 'a'));
  }
  return label;
}

std::vector<LabelRing> trace(const std::vector<std::string>& rows) {
  return trace_labels(image_of(rows), static_cast<int>(rows[0].size()),
                      static_cast<int>(rows.size()));
}

double shoelace(const std::vector<PixelCorner>& ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const PixelCorner a = ring[i], b = ring[(i + 1) % ring.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return 0.5 * twice;
}

TEST(LabelRings, ARectangleHasFourCorners) {
  const auto rings = trace({"....", ".aa.", ".aa.", "...."});
  ASSERT_EQ(rings.size(), 1u);
  EXPECT_EQ(rings[0].area, 4);
  EXPECT_EQ(rings[0].corners, (std::vector<PixelCorner>{{3, 1}, {3, 3}, {1, 3}, {1, 1}}));
}

TEST(LabelRings, AHoleIsARingOfItsOwnWithNegativeArea) {
  const auto rings = trace({"aaaa", "a.ba", "aaaa"});
  ASSERT_EQ(rings.size(), 3u);
  std::map<std::int64_t, int> areas;
  for (const LabelRing& ring : rings) areas[ring.area] = ring.label;
  EXPECT_EQ(areas, (std::map<std::int64_t, int>{{-2, 0}, {1, 1}, {12, 0}}));
}

TEST(LabelRings, PixelsThatTouchAtACornerAreNotConnected) {
  EXPECT_EQ(trace({"a.", ".a"}).size(), 2u);
  // And what surrounds such a pair is one hole.
  const auto rings = trace({"aaaa", "a.aa", "aa.a", "aaaa"});
  ASSERT_EQ(rings.size(), 2u);
  EXPECT_EQ(rings[0].area + rings[1].area, 14);
}

TEST(LabelRings, AreasOfRandomImagesAreTheirPixelCounts) {
  std::mt19937 generator(5);
  for (int round = 0; round < 50; ++round) {
    constexpr int kWidth = 23, kHeight = 17;
    std::vector<std::int16_t> label(kWidth * kHeight);
    for (auto& l : label) l = static_cast<std::int16_t>(static_cast<int>(generator() % 4) - 1);
    std::map<int, std::int64_t> pixels, traced;
    for (const auto l : label) {
      if (l >= 0) ++pixels[l];
    }
    for (const LabelRing& ring : trace_labels(label, kWidth, kHeight)) {
      traced[ring.label] += ring.area;
      EXPECT_EQ(static_cast<double>(ring.area), shoelace(ring.corners));
    }
    EXPECT_EQ(traced, pixels);
  }
}

double distance(PixelCorner p, PixelCorner a, PixelCorner b) {
  const double dx = b.x - a.x, dy = b.y - a.y, length = dx * dx + dy * dy;
  const double t =
      length > 0.0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

TEST(LabelRings, SimplifyingLeavesNoCornerFartherThanTheTolerance) {
  constexpr int kSize = 120;
  std::vector<std::int16_t> label(kSize * kSize, -1);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {  // a wavy disk
      const double angle = std::atan2(y - 60.0, x - 60.0);
      if (std::hypot(x - 60.0, y - 60.0) < 45.0 + 6.0 * std::sin(5.0 * angle)) {
        label[static_cast<std::size_t>(y * kSize + x)] = 0;
      }
    }
  }
  const auto rings = trace_labels(label, kSize, kSize);
  ASSERT_EQ(rings.size(), 1u);
  for (const double tolerance : {0.8, 1.5, 4.0}) {
    const auto simple = simplify_ring(rings[0].corners, tolerance);
    EXPECT_LT(simple.size(), rings[0].corners.size() / 2);
    EXPECT_GE(simple.size(), 3u);
    for (const PixelCorner corner : rings[0].corners) {
      double least = 1e9;
      for (std::size_t i = 0; i < simple.size(); ++i) {
        least = std::min(least, distance(corner, simple[i], simple[(i + 1) % simple.size()]));
      }
      EXPECT_LE(least, tolerance + 1e-9);
    }
    for (const PixelCorner corner : simple) {
      EXPECT_NE(std::find(rings[0].corners.begin(), rings[0].corners.end(), corner),
                rings[0].corners.end());
    }
  }
}

}  // namespace
}  // namespace geomap::perception
