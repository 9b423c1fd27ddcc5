// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation_quality.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

namespace geomap::bench {
namespace {

using geometry::RgbdFrame;

constexpr int kWidth = 640, kHeight = 480;

using Readings = std::function<double(int u, int v)>;  // [mm]
using Labels = std::function<int(int u, int v)>;

RgbdFrame frame_of(const Readings& millimetres) {
  RgbdFrame frame;
  frame.depth_camera = {kWidth, kHeight, 585.0, 585.0, 320.0, 240.0};
  frame.depth = {kWidth, kHeight, {}};
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      frame.depth.millimetres.push_back(static_cast<std::uint16_t>(std::lround(millimetres(u, v))));
    }
  }
  return frame;
}

SegmentationQuality measure(const Readings& millimetres, const Labels& label_of) {
  std::vector<std::int16_t> label;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) label.push_back(static_cast<std::int16_t>(label_of(u, v)));
  }
  return measure_segmentation(frame_of(millimetres), label);
}

double wall(int, int) { return 1000.0; }
int left_half(int u, int) { return u < 320 ? 0 : -1; }
int two_halves(int u, int) { return u < 320 ? 0 : 1; }

TEST(SegmentationQuality, HalfOfAWallLabelledIsHalfCoveredAndFlat) {
  const SegmentationQuality quality = measure(wall, left_half);
  EXPECT_EQ(quality.bins[1].valid, kWidth * kHeight) << "1 m is in the bin that begins there";
  EXPECT_DOUBLE_EQ(quality.cover(), 0.5);
  EXPECT_EQ(quality.planes, 1);
  EXPECT_EQ(quality.blocks, 600);
  EXPECT_EQ(quality.mismatched, 0);
  EXPECT_EQ(quality.splits, 0);
  EXPECT_NEAR(quality.rms(), 0.0, 1e-6);
}

TEST(SegmentationQuality, PixelsWithoutAReadingCountNowhere) {
  const auto striped = [](int u, int) { return u < 160 ? 0.0 : u < 320 ? 65535.0 : 1000.0; };
  const SegmentationQuality quality = measure(striped, two_halves);
  EXPECT_EQ(quality.valid(), kWidth * kHeight / 2);
  EXPECT_DOUBLE_EQ(quality.cover(), 1.0);
  EXPECT_EQ(quality.planes, 1);
  EXPECT_EQ(quality.blocks, 600);
}

TEST(SegmentationQuality, ALabelCountsFromAThousandPixelsOn) {
  const auto first_pixels = [](int count) {
    return [count](int u, int v) { return v * kWidth + u < count ? 0 : -1; };
  };
  EXPECT_EQ(measure(wall, first_pixels(999)).labelled(), 0);
  EXPECT_EQ(measure(wall, first_pixels(999)).planes, 0);
  EXPECT_EQ(measure(wall, first_pixels(1000)).labelled(), 1000);
}

TEST(SegmentationQuality, AWallCutInTwoIsSplitOnce) {
  EXPECT_EQ(measure(wall, two_halves).splits, 1);
  EXPECT_EQ(measure(wall, [](int u, int v) { return two_halves(v, u); }).splits, 1);
  EXPECT_EQ(measure(wall, [](int u, int) { return u / 214; }).splits, 2);
}

TEST(SegmentationQuality, LabelsApartOrTouchingInFewPixelsAreNotAdjacent) {
  const auto gap = [](int width) {
    return [width](int u, int) { return u < 320 ? 0 : u < 320 + width ? -1 : 1; };
  };
  EXPECT_EQ(measure(wall, gap(2)).splits, 1);
  EXPECT_EQ(measure(wall, gap(3)).splits, 0);
  const auto contact = [](int rows) {
    return [rows](int u, int v) { return u < 320 ? 0 : u < 330 && v >= rows ? -1 : 1; };
  };
  EXPECT_EQ(measure(wall, contact(19)).splits, 0);
  EXPECT_EQ(measure(wall, contact(20)).splits, 1);
}

TEST(SegmentationQuality, StepsAreNoSplitsAndSmallOnesAreNotFlush) {
  const auto step = [](double millimetres) {
    return [millimetres](int u, int) { return u < 320 ? 1000.0 : 1000.0 + millimetres; };
  };
  EXPECT_EQ(measure(step(3.0), two_halves).flush_splits, 1);
  EXPECT_EQ(measure(step(15.0), two_halves).flush_splits, 0);
  EXPECT_EQ(measure(step(15.0), two_halves).splits, 1);
  EXPECT_EQ(measure(step(25.0), two_halves).splits, 0);
}

// A wall at 1.5 m up to the image's middle, from where another comes nearer at 45°.
double crease(int u, int) { return u < 320 ? 1500.0 : 1500.0 / (1.0 + (u - 320) / 585.0); }

TEST(SegmentationQuality, RightLabelsOverACreaseMatch) {
  const SegmentationQuality quality = measure(crease, two_halves);
  EXPECT_EQ(quality.blocks, 1200);
  EXPECT_EQ(quality.mismatched, 0);
  EXPECT_EQ(quality.splits, 0);
}

TEST(SegmentationQuality, ALabelThatLeaksOverACreaseMismatchesInEveryBlockOfTheLeak) {
  const auto leaking = [](int u, int) { return u < 320 + 32 ? 0 : 1; };
  const SegmentationQuality quality = measure(crease, leaking);
  EXPECT_EQ(quality.blocks, 1200);
  EXPECT_EQ(quality.mismatched, 60);
  EXPECT_DOUBLE_EQ(quality.mismatch(), 0.05);
}

TEST(SegmentationQuality, BlocksBeyondTwoAndAHalfMetresOrOnNoOneSurfaceAreNotJudged) {
  EXPECT_EQ(measure([](int, int) { return 2600.0; }, two_halves).blocks, 0);
  const auto comb = [](int u, int) { return u % 2 == 0 ? 1000.0 : 1010.0; };
  EXPECT_EQ(measure(comb, two_halves).blocks, 0);
  const auto checked = [](int u, int) { return u % 2; };
  EXPECT_EQ(measure(wall, checked).blocks, 0) << "no label has three quarters of a block";
}

TEST(SegmentationQuality, RmsIsThatOfReadingsAboutTheirLabelsPlane) {
  const auto comb = [](int u, int) { return u % 2 == 0 ? 1000.0 : 1010.0; };
  EXPECT_NEAR(measure(comb, left_half).rms(), 0.005, 1e-5);
}

TEST(SegmentationQuality, CoverIsCountedByDepth) {
  const auto bands = [](int, int v) { return 750.0 + 500.0 * (v / 80); };
  const SegmentationQuality quality = measure(bands, [](int u, int v) {
    return u < 160 * (v / 80 % 5) ? v / 80 : -1;  // 0, 1, 2, 3, 4 and 0 quarters
  });
  for (std::size_t i = 0; i < quality.bins.size(); ++i) {
    EXPECT_EQ(quality.bins[i].valid, 80 * kWidth);
    EXPECT_EQ(quality.bins[i].labelled, 80 * 160 * static_cast<int>(i % 5)) << i;
  }
}

TEST(SegmentationQuality, FramesAddUp) {
  SegmentationQuality sum = measure(wall, left_half);
  sum += measure(crease, two_halves);
  EXPECT_DOUBLE_EQ(sum.cover(), 0.75);
  EXPECT_EQ(sum.planes, 3);
  EXPECT_EQ(sum.blocks, 1800);
}

TEST(SegmentationQuality, AnEmptyFrameHasNoFiguresAndLabelsMustFit) {
  const SegmentationQuality quality = measure_segmentation({}, {});
  EXPECT_EQ(quality.cover(), 0.0);
  EXPECT_EQ(quality.mismatch(), 0.0);
  EXPECT_EQ(quality.rms(), 0.0);
  EXPECT_THROW(measure_segmentation(frame_of(wall), {}), std::invalid_argument);
}

}  // namespace
}  // namespace geomap::bench
