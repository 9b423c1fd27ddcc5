// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/portable_random.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace geomap::drivers {
namespace {

double below(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

// The sequence of seed 1234567 that implementations of SplitMix64 are compared by.
TEST(PortableRandom, BitsAreThoseOfSplitMix64) {
  PortableRandom random(1234567);
  for (const std::uint64_t expected :
       {6457827717110365317ULL, 3203168211198807973ULL, 9817491932198370423ULL,
        4593380528125082431ULL, 16408922859458223821ULL}) {
    EXPECT_EQ(random.next(), expected);
  }
}

TEST(PortableRandom, UniformFillsTenthsEvenly) {
  PortableRandom random(3);
  constexpr int kDraws = 1000000;
  std::array<int, 10> counts{};
  for (int i = 0; i < kDraws; ++i) {
    const double value = random.uniform();
    ASSERT_GE(value, 0.0);
    ASSERT_LT(value, 1.0);
    ++counts[static_cast<std::size_t>(10.0 * value)];
  }
  for (const int count : counts) EXPECT_NEAR(count, kDraws / 10, 5.0 * 300.0);
}

TEST(PortableRandom, TheQuantileInvertsTheDistributionFunctionFarIntoTheTails) {
  for (double x = -8.2; x < 0.0; x += 0.01) {
    EXPECT_NEAR(normal_quantile(below(x)), x, 2e-14 * std::abs(x) + 1e-15) << x;
  }
  for (double x = 0.0; x < 5.0; x += 0.01) {
    // 1 - p has lost digits: what is left of them counts.
    EXPECT_NEAR(below(normal_quantile(below(x))), below(x), 3e-16) << x;
  }
}

TEST(PortableRandom, TheQuantileIsOdd) {
  for (double p = 1.0 / 1024; p < 0.5; p += 1.0 / 1024) {
    EXPECT_EQ(normal_quantile(p), -normal_quantile(1.0 - p));
  }
  EXPECT_EQ(normal_quantile(0.5), 0.0);
}

TEST(PortableRandom, NormalHasTheMomentsOfTheNormalDistribution) {
  PortableRandom random(7);
  constexpr int kDraws = 4000000;
  std::array<double, 5> sums{};
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.normal();
    double power = 1.0;
    for (double& sum : sums) {
      sum += power;
      power *= x;
    }
  }
  // Bounds of five standard errors: the variances of x, x², x³, x⁴ are 1, 2, 15, 96.
  const double root = std::sqrt(kDraws);
  EXPECT_NEAR(sums[1] / kDraws, 0.0, 5.0 / root);
  EXPECT_NEAR(sums[2] / kDraws, 1.0, 5.0 * std::sqrt(2.0) / root);
  EXPECT_NEAR(sums[3] / kDraws, 0.0, 5.0 * std::sqrt(15.0) / root);
  EXPECT_NEAR(sums[4] / kDraws, 3.0, 5.0 * std::sqrt(96.0) / root);
}

TEST(PortableRandom, NormalHasTheTailsOfTheNormalDistribution) {
  PortableRandom random(11);
  constexpr int kDraws = 10000000;
  std::array<int, 6> above{}, under{};
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.normal();
    for (std::size_t k = 0; k < above.size() && std::abs(x) > static_cast<double>(k); ++k) {
      ++(x > 0.0 ? above : under)[k];
    }
  }
  for (std::size_t k = 0; k < above.size(); ++k) {
    const double expected = kDraws * below(-static_cast<double>(k));
    const double bound = 5.0 * std::sqrt(expected) + 1.0;
    EXPECT_NEAR(above[k], expected, bound) << k;
    EXPECT_NEAR(under[k], expected, bound) << k;
  }
}

TEST(PortableRandom, NeighbouringSeedsHaveNothingInCommon) {
  constexpr int kDraws = 100000;
  PortableRandom first(41), second(42);
  double product = 0.0;
  for (int i = 0; i < kDraws; ++i) product += first.normal() * second.normal();
  EXPECT_NEAR(product / kDraws, 0.0, 5.0 / std::sqrt(kDraws));
}

}  // namespace
}  // namespace geomap::drivers
