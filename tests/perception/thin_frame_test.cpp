// SPDX-License-Identifier: BSD-3-Clause
#include "perception/thin_frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <stdexcept>
#include <utility>

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

/// The definition, pair by pair. @return 0 where the centre is no reading.
std::uint16_t mean_of_pairs(const DepthImage& depth, int u, int v, int radius) {
  const auto at = [&](int column, int row) -> int {
    const bool inside = column >= 0 && row >= 0 && column < depth.width && row < depth.height;
    const std::uint16_t value = inside ? depth.at(column, row) : DepthImage::kNoReading;
    return DepthImage::is_reading(value) ? value : 0;
  };
  const int centre = at(u, v);
  double sum = centre, count = centre > 0 ? 1.0 : 0.0;
  const auto belongs = [&](int value) {
    return value > 0 && centre > 0 && std::abs(value - centre) <= 10 + centre / 64;
  };
  for (int dv = -radius; dv <= radius; ++dv) {
    for (int du = -radius; du <= radius; ++du) {
      const int pixel = at(u + du, v + dv);
      if ((du == 0 && dv == 0) || !belongs(pixel) || !belongs(at(u - du, v - dv))) continue;
      sum += pixel;
      count += 1.0;
    }
  }
  return count > 0.0 ? static_cast<std::uint16_t>(std::floor(sum / count + 0.5)) : std::uint16_t{0};
}

TEST(ThinFrame, EveryReadingIsTheMeanOfThePairsOnItsSurfaceAtAnyStep) {
  std::mt19937 random(3);
  for (const auto& [width, height] : {std::pair{640, 480}, std::pair{633, 475}}) {
    RgbdFrame frame;
    frame.depth_camera = {width, height, 500.0, 500.0, 300.0, 200.0};
    frame.depth = {width, height, {}};
    for (int i = 0; i < width * height; ++i) {
      // Surfaces that change now and then, readings around them, holes, and the range's ends.
      const auto surface = static_cast<unsigned>(300 + i / 97 % 5 * 40 + i / 9001 * 1700);
      const auto kind = random() % 40;
      const unsigned odd[] = {0, 0xffff, 1, 65534};
      frame.depth.millimetres.push_back(
          static_cast<std::uint16_t>(kind < 4 ? odd[kind] : surface % 65000 + random() % 30));
    }
    for (const std::size_t max_bytes : {70'000U, 26'000U, 14'000U, 8'000U, 2'000U}) {
      const RgbdFrame thin = thin_frame(frame, max_bytes);
      const auto step = static_cast<int>(std::lround(frame.depth_camera.fx / thin.depth_camera.fx));
      ASSERT_GT(step, 1);
      for (int v = 0; v < thin.depth.height; ++v) {
        for (int u = 0; u < thin.depth.width; ++u) {
          ASSERT_EQ(thin.depth.at(u, v),
                    mean_of_pairs(frame.depth, step * u + step / 2, step * v + step / 2, step / 2))
              << "step " << step << " at " << u << ", " << v;
        }
      }
    }
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
