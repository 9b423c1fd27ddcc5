// SPDX-License-Identifier: BSD-3-Clause
#include "perception/thin_frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "support/plane_renderer.hpp"

namespace geomap::perception {
namespace {

using Eigen::Vector3d;
using geometry::DepthImage;
using geometry::RgbdFrame;

constexpr std::size_t kMaxBytes = 40'000;

/// A wall seen at 60 degrees, 2 m away.
testing::Rendering oblique_wall(double sigma) {
  testing::Rectangle wall;
  wall.half_u = wall.half_v = 50.0;
  const Eigen::Isometry3d T_world_camera =
      testing::look_at({0.0, -std::sqrt(3.0), 1.0}, Vector3d::Zero());
  return testing::render({wall}, testing::kinect_camera(), T_world_camera, sigma, 7);
}

std::size_t bytes(const RgbdFrame& frame) {
  return frame.depth.millimetres.size() * sizeof(std::uint16_t) + frame.color.rgb.size();
}

/// Root of the mean squared difference [mm] between a thin frame's readings and the true depths at
/// the pixels that they stand for; the largest one with `worst`.
double rms_error(const RgbdFrame& thin, const testing::Rendering& full, double* worst = nullptr) {
  const double step = full.frame.depth_camera.fx / thin.depth_camera.fx;
  double sum = 0.0;
  int count = 0;
  for (int v = 0; v < thin.depth.height; ++v) {
    for (int u = 0; u < thin.depth.width; ++u) {
      const std::uint16_t reading = thin.depth.at(u, v);
      if (!DepthImage::is_reading(reading)) continue;
      const auto column = static_cast<int>(std::lround(step * u + std::floor(step / 2)));
      const auto row = static_cast<int>(std::lround(step * v + std::floor(step / 2)));
      const auto pixel = static_cast<std::size_t>(row * full.frame.depth.width + column);
      const double error = reading - 1e3 * full.depth[pixel];
      sum += error * error;
      ++count;
      if (worst != nullptr) *worst = std::max(*worst, std::abs(error));
    }
  }
  EXPECT_GT(count, 1000);
  return std::sqrt(sum / count);
}

TEST(ThinFrame, FitsTheBytesAllowedAndNotMuchLess) {
  const RgbdFrame frame = oblique_wall(0.0).frame;
  ASSERT_FALSE(frame.color.empty());
  const RgbdFrame thin = thin_frame(frame, kMaxBytes);
  EXPECT_LE(bytes(thin), kMaxBytes);
  EXPECT_GT(bytes(thin), kMaxBytes / 2);
  EXPECT_EQ(thin.utime, frame.utime);
  EXPECT_TRUE(thin.depth_camera.valid());
}

TEST(ThinFrame, AFrameThatIsSmallEnoughStaysAsItIs) {
  const RgbdFrame frame = oblique_wall(0.0).frame;
  EXPECT_EQ(thin_frame(frame, 640 * 480 * 5).depth.millimetres, frame.depth.millimetres);
}

TEST(ThinFrame, TheThinCameraSeesAPointAtThePixelThatStandsForIt) {
  const RgbdFrame frame = oblique_wall(0.0).frame;
  const RgbdFrame thin = thin_frame(frame, kMaxBytes);
  const Vector3d point(0.31, -0.2, 1.7);
  const Eigen::Vector2d expected = 7.0 * thin.depth_camera.project(point).array() + 3.0;
  EXPECT_LT((frame.depth_camera.project(point) - expected).norm(), 1e-9);
}

TEST(ThinFrame, APlaneKeepsItsPlaceToTheRoundingOfReadings) {
  const testing::Rendering wall = oblique_wall(0.0);
  double worst = 0.0;
  rms_error(thin_frame(wall.frame, kMaxBytes), wall, &worst);
  EXPECT_LT(worst, 1.6);  // half a millimetre of rounding, and the curve of depth in a block
}

TEST(ThinFrame, APlaneKeepsItsPlaceBesideHoles) {
  testing::Rendering wall = oblique_wall(0.0);
  for (int v = 0; v < wall.frame.depth.height; ++v) {
    if (v % 7 <= 3) continue;  // the lower rows of each block, where the wall is nearer
    const auto row = wall.frame.depth.millimetres.begin() + v * wall.frame.depth.width;
    std::fill_n(row, wall.frame.depth.width, DepthImage::kNoReading);
  }
  double worst = 0.0;
  rms_error(thin_frame(wall.frame, kMaxBytes), wall, &worst);
  EXPECT_LT(worst, 1.6);
}

TEST(ThinFrame, MostOfTheNoiseGoes) {
  const testing::Rendering wall = oblique_wall(0.008);
  EXPECT_NEAR(rms_error(wall.frame, wall), 8.0, 0.5);
  EXPECT_LT(rms_error(thin_frame(wall.frame, kMaxBytes), wall), 2.0);
}

TEST(ThinFrame, NoPointAppearsBetweenTwoSurfaces) {
  testing::Rendering wall = oblique_wall(0.0);
  RgbdFrame& frame = wall.frame;
  for (int v = 0; v < frame.depth.height; ++v) {
    for (int u = 0; u < frame.depth.width; ++u) {
      // A slanting edge, so that it crosses blocks everywhere.
      frame.depth.millimetres[static_cast<std::size_t>(v * frame.depth.width + u)] =
          u + v / 3 < 400 ? std::uint16_t{1500} : std::uint16_t{2100};
    }
  }
  for (const std::uint16_t reading : thin_frame(frame, kMaxBytes).depth.millimetres) {
    EXPECT_TRUE(reading == 1500 || reading == 2100) << reading;
  }
}

TEST(ThinFrame, ColourIsTheMeanOverTheBlock) {
  RgbdFrame frame = oblique_wall(0.0).frame;
  std::fill(frame.depth.millimetres.begin(), frame.depth.millimetres.end(), std::uint16_t{2000});
  for (std::size_t i = 0; i < frame.color.rgb.size(); ++i) {
    frame.color.rgb[i] = static_cast<std::uint8_t>(i / 3 % 2 == 0 ? 100 : 120);
  }
  const RgbdFrame thin = thin_frame(frame, kMaxBytes);
  ASSERT_EQ(thin.color.rgb.size(), 3 * thin.depth.millimetres.size());
  for (const std::uint8_t value : thin.color.rgb) EXPECT_NEAR(value, 110, 2);
}

TEST(ThinFrame, ColourOfAnotherSizeIsLeftOut) {
  RgbdFrame frame = oblique_wall(0.0).frame;
  frame.color.width = 320;
  frame.color.height = 240;
  frame.color.rgb.resize(320 * 240 * 3);
  const RgbdFrame thin = thin_frame(frame, kMaxBytes);
  EXPECT_TRUE(thin.color.empty());
  EXPECT_LE(bytes(thin), kMaxBytes);
}

TEST(ThinFrame, EmptyFramesGiveEmptyFrames) {
  EXPECT_TRUE(thin_frame(RgbdFrame{}, kMaxBytes).depth.empty());
  RgbdFrame blind = oblique_wall(0.0).frame;
  std::fill(blind.depth.millimetres.begin(), blind.depth.millimetres.end(), DepthImage::kInvalid);
  for (const std::uint16_t reading : thin_frame(blind, kMaxBytes).depth.millimetres) {
    EXPECT_FALSE(DepthImage::is_reading(reading));
  }
}

TEST(ThinFrame, RefusesImagesThatContradictTheirCamera) {
  RgbdFrame frame = oblique_wall(0.0).frame;
  EXPECT_THROW(thin_frame(frame, 4), std::invalid_argument);
  frame.depth_camera.width = 320;
  EXPECT_THROW(thin_frame(frame, kMaxBytes), std::invalid_argument);
  frame = oblique_wall(0.0).frame;
  frame.depth.millimetres.pop_back();
  EXPECT_THROW(thin_frame(frame, kMaxBytes), std::invalid_argument);
  frame = oblique_wall(0.0).frame;
  frame.color.rgb.pop_back();
  EXPECT_THROW(thin_frame(frame, kMaxBytes), std::invalid_argument);
}

}  // namespace
}  // namespace geomap::perception
