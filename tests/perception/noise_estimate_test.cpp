// SPDX-License-Identifier: BSD-3-Clause
#include "perception/noise_estimate.hpp"

#include <cmath>
#include <functional>
#include <random>

#include "support/plane_renderer.hpp"

namespace geomap::perception {
namespace {

using geometry::DepthNoise;

testing::Rendering room() {
  return testing::render(testing::small_room(), testing::kinect_camera(),
                         testing::look_at({1.2, -1.2, 1.5}, {-0.4, 1.2, 0.6}));
}

// The estimate from the room with noise of the given standard deviation by depth and image column.
DepthNoise estimate(const std::function<double(double, int)>& sigma) {
  testing::Rendering rendering = room();
  std::mt19937 generator(17);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (std::size_t i = 0; i < rendering.depth.size(); ++i) {
    const double z = rendering.depth[i];
    if (z == 0.0) continue;
    const int column = static_cast<int>(i) % rendering.frame.depth.width;
    rendering.frame.depth.millimetres[i] = static_cast<std::uint16_t>(
        std::lround(1000.0 * (z + sigma(z, column) * normal(generator))));
  }
  return estimate_noise(DepthCells(rendering.frame.depth, rendering.frame.depth_camera, 0.3, 8.0),
                        DepthNoise{});
}

TEST(NoiseEstimate, NoiseOfTheModelAtAFactorGivesThatFactor) {
  for (const double factor : {0.5, 1.0, 2.0, 4.0}) {
    DepthNoise model;
    model.factor = factor;
    const DepthNoise found = estimate([&](double z, int) { return model.sigma(z); });
    EXPECT_NEAR(found.factor, factor, 0.08 * factor);
    EXPECT_EQ(found.slope, DepthNoise{}.slope);
  }
}

TEST(NoiseEstimate, WhiteNoiseGivesItsOwnDeviationAtAllDepths) {
  for (const double sigma : {0.005, 0.020}) {
    const DepthNoise found = estimate([&](double, int) { return sigma; });
    for (const double z : {1.0, 2.0, 4.0}) EXPECT_NEAR(found.sigma(z), sigma, 0.1 * sigma);
  }
}

TEST(NoiseEstimate, RoundedDepthWithoutNoiseGivesTheLeastFactor) {
  EXPECT_EQ(estimate([](double, int) { return 0.0; }).factor, kLeastNoiseFactor);
}

TEST(NoiseEstimate, AThirdOfTheImageGoneWildChangesLittle) {
  const DepthNoise model;
  const DepthNoise found =
      estimate([&](double z, int column) { return (column < 213 ? 10.0 : 1.0) * model.sigma(z); });
  EXPECT_NEAR(found.factor, 1.0, 0.15);
}

TEST(NoiseEstimate, AFrameWithoutWholeBlocksLeavesTheModelAsItIs) {
  DepthNoise model;
  model.factor = 1.7;
  const geometry::DepthImage empty{64, 64, std::vector<std::uint16_t>(64 * 64, 0)};
  const DepthCells cells(empty, {64, 64, 60.0, 60.0, 32.0, 32.0}, 0.3, 8.0);
  EXPECT_EQ(estimate_noise(cells, model).factor, 1.7);
}

}  // namespace
}  // namespace geomap::perception
