// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/depth_sensor_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace geomap::drivers {
namespace {

using geometry::DepthImage;

constexpr int kWidth = 200;
constexpr int kHeight = 150;
constexpr geometry::CameraModel kCamera{kWidth, kHeight, 180.0, 180.0, 100.0, 75.0};

ExactDepth wall(double z, float cosine = 1.0F) {
  return {kWidth, kHeight, std::vector<double>(kWidth * kHeight, z),
          std::vector<float>(kWidth * kHeight, cosine)};
}

// A box over the columns from `first` to `last` in front of a wall.
ExactDepth box_and_wall(int first, int last, double near, double far) {
  ExactDepth exact = wall(far);
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const bool on_box = first <= i % kWidth && i % kWidth <= last;
    if (on_box) exact.depth[static_cast<std::size_t>(i)] = near;
  }
  return exact;
}

DepthSensorConfig white(double sigma) {
  DepthSensorConfig config;
  config.sigma = sigma;
  return config;
}

DepthSensorConfig kinect() {
  DepthSensorConfig config;
  config.noise = SensorNoise::kKinect;
  return config;
}

// A Kinect without any fault but those a test adds.
DepthSensorConfig faultless_kinect() {
  DepthSensorConfig config = kinect();
  config.lateral_sigma = 0.0;
  config.disparity_step = 1e-6;
  config.baseline = 0.0;
  config.bias_at_corner = 0.0;
  config.grazing_cosine = 0.0;
  config.axial.factor = 0.0;
  config.axial.quantisation = 0.0;
  return config;
}

std::vector<std::uint16_t> read(const DepthSensorConfig& config, const ExactDepth& exact,
                                std::uint64_t seed = 1) {
  return DepthSensorModel(kCamera, config).read(exact, seed).millimetres;
}

double mean(const std::vector<std::uint16_t>& readings) {
  double sum = 0.0;
  for (const std::uint16_t reading : readings) sum += reading;
  return sum / static_cast<double>(readings.size());
}

double deviation(const std::vector<std::uint16_t>& readings) {
  const double centre = mean(readings);
  double sum = 0.0;
  for (const std::uint16_t reading : readings) sum += (reading - centre) * (reading - centre);
  return std::sqrt(sum / static_cast<double>(readings.size()));
}

double share_without_reading(const std::vector<std::uint16_t>& readings) {
  return static_cast<double>(std::count(readings.begin(), readings.end(), DepthImage::kNoReading)) /
         static_cast<double>(readings.size());
}

// FNV-1a over the readings, low byte first.
std::uint64_t checksum(const std::vector<std::uint16_t>& readings) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const std::uint16_t reading : readings) {
    for (const int shift : {0, 8}) hash = (hash ^ ((reading >> shift) & 0xff)) * 0x100000001b3ULL;
  }
  return hash;
}

TEST(WhiteNoise, WithoutNoiseAReadingIsTheNearestMillimetre) {
  EXPECT_THAT(read(white(0.0), wall(1.2344)), ::testing::Each(1234));
  EXPECT_THAT(read(white(0.0), wall(1.2346)), ::testing::Each(1235));
}

TEST(WhiteNoise, HasMeanZeroAndTheConfiguredDeviation) {
  const auto readings = read(white(0.02), wall(2.0));
  // Five standard errors of 30 000 readings; rounding adds 1/12 mm² to 400.
  EXPECT_NEAR(mean(readings), 2000.0, 5.0 * 20.0 / std::sqrt(30000.0));
  EXPECT_NEAR(deviation(readings), std::sqrt(400.0 + 1.0 / 12.0), 5.0 * 20.0 / std::sqrt(60000.0));
}

TEST(WhiteNoise, TheExactDepthDecidesAboutTheRange) {
  EXPECT_THAT(read(white(0.0), wall(0.499)), ::testing::Each(DepthImage::kNoReading));
  EXPECT_THAT(read(white(0.0), wall(0.5)), ::testing::Each(500));
  EXPECT_THAT(read(white(0.0), wall(5.0)), ::testing::Each(5000));
  EXPECT_THAT(read(white(0.0), wall(5.001)), ::testing::Each(DepthImage::kNoReading));
  EXPECT_EQ(share_without_reading(read(white(0.02), wall(5.0))), 0.0);
}

TEST(WhiteNoise, WhereNothingIsHitOrNothingIsLeftThereIsNoReading) {
  for (const double z :
       {0.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT(read(white(0.02), wall(z)), ::testing::Each(DepthImage::kNoReading));
    EXPECT_THAT(read(kinect(), wall(z)), ::testing::Each(DepthImage::kNoReading));
  }
  const auto drowned = read(white(100.0), wall(1.0));  // half of the sums are negative
  EXPECT_GT(share_without_reading(drowned), 0.49);
  EXPECT_THAT(drowned, ::testing::Not(::testing::Contains(DepthImage::kInvalid)));
}

TEST(WhiteNoise, APixelsNoiseDoesNotDependOnTheOthers) {
  ExactDepth holes = wall(2.0);
  for (std::size_t i = 0; i < holes.depth.size(); i += 2) holes.depth[i] = 0.0;
  const auto readings = read(white(0.02), holes);
  const auto whole = read(white(0.02), wall(2.0));
  for (std::size_t i = 1; i < whole.size(); i += 2) ASSERT_EQ(readings[i], whole[i]);
}

TEST(KinectNoise, WithoutFaultsAReadingIsTheNearestMillimetre) {
  EXPECT_THAT(read(faultless_kinect(), wall(1.2344)), ::testing::Each(1234));
  EXPECT_THAT(read(faultless_kinect(), wall(4.9996)), ::testing::Each(5000));
}

TEST(KinectNoise, ReadingsAreMultiplesOfTheDisparityStep) {
  DepthSensorConfig config = faultless_kinect();
  config.disparity_step = 0.125;
  // 43.9 / 3 m is 14.633 pixels, nearest multiple 14.625.
  EXPECT_THAT(read(config, wall(3.0)), ::testing::Each(std::lround(43900.0 / 14.625)));
  config.axial = {};
  for (const std::uint16_t reading : read(config, wall(3.0))) {
    const double steps = std::round(43.9 / (0.001 * reading) / 0.125);
    ASSERT_EQ(reading, std::lround(43900.0 / (0.125 * steps)));
  }
}

TEST(KinectNoise, AxialNoiseGrowsAsItsModelSays) {
  DepthSensorConfig config = faultless_kinect();
  config.axial = {};
  for (const double z : {1.0, 2.0, 4.0}) {
    const double sigma = 1000.0 * geometry::DepthNoise{}.sigma(z);
    EXPECT_NEAR(deviation(read(config, wall(z))), std::hypot(sigma, std::sqrt(1.0 / 12.0)),
                0.03 * sigma)
        << z;
  }
}

TEST(KinectNoise, TheBiasGrowsWithTheSquareOfTheDistanceToThePrincipalPoint) {
  DepthSensorConfig config = faultless_kinect();
  config.bias_at_corner = 0.01;
  const DepthImage image = DepthSensorModel(kCamera, config).read(wall(2.0), 1);
  EXPECT_EQ(image.at(100, 75), 2000);
  EXPECT_EQ(image.at(0, 0), 2020);
  EXPECT_EQ(image.at(50, 75), std::lround(2000.0 + 20.0 * 2500.0 / (10000.0 + 5625.0)));
}

TEST(KinectNoise, TheShadowOfABoxLiesAtItsLeft) {
  DepthSensorConfig config = faultless_kinect();
  config.baseline = 0.075;
  const DepthImage image =
      DepthSensorModel(kCamera, config).read(box_and_wall(100, 180, 0.6, 3.0), 1);
  const int width = static_cast<int>(std::lround(180.0 * 0.075 * (1.0 / 0.6 - 1.0 / 3.0)));
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const int wall_or_box = 100 <= u && u <= 180 ? 600 : 3000;
      ASSERT_EQ(image.at(u, v), 100 - width <= u && u < 100 ? 0 : wall_or_box) << u;
    }
  }
}

TEST(KinectNoise, AtGrazingIncidenceReadingsAreLostMoreAndMoreOften) {
  DepthSensorConfig config = faultless_kinect();
  config.grazing_cosine = 0.15;
  const auto lost = [&](float cosine) {
    return share_without_reading(read(config, wall(2.0, cosine)));
  };
  EXPECT_EQ(lost(0.301F), 0.0);
  EXPECT_NEAR(lost(0.2625F), 0.25, 5.0 * std::sqrt(0.25 * 0.75 / 30000.0));
  EXPECT_NEAR(lost(0.1875F), 0.75, 5.0 * std::sqrt(0.25 * 0.75 / 30000.0));
  EXPECT_EQ(lost(0.149F), 1.0);
}

TEST(KinectNoise, LateralJitterMovesEdgesAndNothingElse) {
  DepthSensorConfig config = faultless_kinect();
  config.lateral_sigma = 0.8;
  const DepthImage image =
      DepthSensorModel(kCamera, config).read(box_and_wall(100, 180, 1.0, 2.0), 1);
  int displaced = 0;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const bool differs = image.at(u, v) != (100 <= u && u <= 180 ? 1000 : 2000);
      const bool near_edge = std::abs(u - 99.5) < 5.0 || std::abs(u - 180.5) < 5.0;
      ASSERT_TRUE(near_edge || !differs) << u;
      displaced += differs && u == 99 ? 1 : 0;
    }
  }
  // Column 99 reads the box where the offset rounds to 1 or more: beyond 0.5 / 0.8 sigma.
  const double expected = 0.5 * std::erfc(0.625 / std::sqrt(2.0));
  EXPECT_NEAR(displaced / 150.0, expected, 4.0 * std::sqrt(expected * (1.0 - expected) / 150.0));
}

TEST(KinectNoise, TheReadingDecidesAboutTheRange) {
  DepthSensorConfig config = faultless_kinect();
  config.axial.factor = 1.0;
  EXPECT_NEAR(share_without_reading(read(config, wall(5.0))), 0.5, 0.02);
}

TEST(DepthSensorModel, TheSeedAloneDecidesTheReadings) {
  for (const DepthSensorConfig& config : {white(0.02), kinect()}) {
    EXPECT_EQ(read(config, wall(2.0), 5), read(config, wall(2.0), 5));
    EXPECT_NE(read(config, wall(2.0), 5), read(config, wall(2.0), 6));
  }
}

// Every CPU and library must make these bytes. Who changes the model knowingly changes the numbers.
TEST(DepthSensorModel, TheBytesAreThoseOfEveryOtherMachine) {
  ExactDepth exact = box_and_wall(100, 180, 0.8, 2.5);
  for (std::size_t i = 0; i < exact.depth.size(); ++i) {
    exact.depth[i] += static_cast<double>(i) / 16384.0;
    exact.cosine[i] = 1.0F - static_cast<float>(i) / 32768.0F;
  }
  EXPECT_EQ(checksum(read(white(0.02), exact, 9)), 15608103092101072753ULL);
  EXPECT_EQ(checksum(read(kinect(), exact, 9)), 12778304604648486248ULL);
}

TEST(DepthSensorModel, WhatCannotBeIsRefused) {
  const auto refused = [](auto change) {
    DepthSensorConfig config;
    change(config);
    EXPECT_THROW(DepthSensorModel(kCamera, config), std::invalid_argument);
    EXPECT_EQ(config.validate().size(), 1U);
  };
  refused([](auto& config) { config.sigma = std::numeric_limits<double>::quiet_NaN(); });
  refused([](auto& config) { config.min_range = -0.5; });
  refused([](auto& config) { config.max_range = 0.5; });
  refused([](auto& config) { config.max_range = 66.0; });
  refused([](auto& config) { config.lateral_sigma = -1.0; });
  refused([](auto& config) { config.lateral_sigma = 101.0; });
  refused([](auto& config) { config.disparity_step = 0.0; });
  refused([](auto& config) { config.focal_times_baseline = 0.0; });
  refused([](auto& config) { config.baseline = -0.075; });
  refused([](auto& config) { config.bias_at_corner = 1.0; });
  refused([](auto& config) { config.grazing_cosine = 0.6; });
  refused([](auto& config) { config.axial.base = std::numeric_limits<double>::infinity(); });
  EXPECT_THROW(DepthSensorModel(geometry::CameraModel{}, {}), std::invalid_argument);
}

TEST(DepthSensorModel, AnImageOfAnotherSizeIsRefused) {
  ExactDepth exact = wall(2.0);
  exact.cosine.clear();
  EXPECT_NO_THROW(read(white(0.02), exact));
  EXPECT_THROW(read(kinect(), exact), std::invalid_argument);
  exact.depth.pop_back();
  EXPECT_THROW(read(white(0.02), exact), std::invalid_argument);
  EXPECT_THROW(read(white(0.02), ExactDepth{}), std::invalid_argument);
}

}  // namespace
}  // namespace geomap::drivers
