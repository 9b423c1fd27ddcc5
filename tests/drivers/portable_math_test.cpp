// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/portable_math.hpp"

#include <cmath>
#include <numbers>

namespace geomap::drivers {
namespace {

TEST(PortableMath, SineAndCosineAreTheLibrarys) {
  for (double angle = -20.0; angle < 20.0; angle += 0.000977) {
    EXPECT_NEAR(portable_sincos(angle).sine, std::sin(angle), 3e-16) << angle;
    EXPECT_NEAR(portable_sincos(angle).cosine, std::cos(angle), 3e-16) << angle;
  }
}

TEST(PortableMath, SineAndCosineKeepTheirDigitsAfterManyTurns) {
  for (double angle = 1e-9; angle < 1e5; angle *= 1.01) {
    EXPECT_NEAR(portable_sincos(angle).sine, std::sin(angle), 1e-15) << angle;
    EXPECT_NEAR(portable_sincos(-angle).cosine, std::cos(-angle), 1e-15) << angle;
  }
}

TEST(PortableMath, QuarterTurnsAreExactUpToTheDigitsOfPi) {
  for (int quarter = -9; quarter <= 9; ++quarter) {
    const double angle = quarter * (std::numbers::pi / 2.0);
    EXPECT_NEAR(portable_sincos(angle).sine, std::sin(angle), 1e-30) << quarter;
    EXPECT_NEAR(portable_sincos(angle).cosine, std::cos(angle), 1e-30) << quarter;
  }
  EXPECT_EQ(portable_sincos(0.0).sine, 0.0);
  EXPECT_EQ(portable_sincos(0.0).cosine, 1.0);
}

TEST(PortableMath, TheLogarithmIsTheLibrarysToTheLastDigits) {
  for (double x = 1e-300; x < 1e300; x *= 1.37) {
    EXPECT_NEAR(portable_log(x), std::log(x), 4e-16 * std::abs(std::log(x))) << x;
  }
  EXPECT_EQ(portable_log(1.0), 0.0);
}

}  // namespace
}  // namespace geomap::drivers
