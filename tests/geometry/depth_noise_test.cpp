// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/depth_noise.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace geomap::geometry {
namespace {

TEST(DepthNoise, TheDefaultIsNguyensModelOfTheKinect) {
  const DepthNoise noise;
  EXPECT_NEAR(noise.sigma(0.4), 0.0012, 1e-12);
  EXPECT_NEAR(noise.sigma(1.4), 0.0031, 1e-12);
  EXPECT_NEAR(noise.sigma(3.4), 0.0012 + 0.0019 * 9.0, 1e-12);
}

TEST(DepthNoise, TheFactorOfAFrameScalesIt) {
  DepthNoise noise;
  noise.factor = 2.5;
  EXPECT_NEAR(noise.sigma(2.0), 2.5 * DepthNoise{}.sigma(2.0), 1e-12);
}

TEST(DepthNoise, NeverFallsBelowWhatRoundingLeaves) {
  DepthNoise noise;
  noise.factor = 0.0;
  EXPECT_NEAR(noise.sigma(1.0), 0.001 / std::sqrt(12.0), 1e-12);
  noise.quantisation = 0.01;
  EXPECT_NEAR(noise.sigma(5.0), 0.01 / std::sqrt(12.0), 1e-12);
}

}  // namespace
}  // namespace geomap::geometry
