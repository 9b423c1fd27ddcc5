// SPDX-License-Identifier: BSD-3-Clause
#include "perception/part_curvature.hpp"

#include <cmath>
#include <functional>
#include <random>

namespace geomap::perception {
namespace {

using Height = std::function<double(double s, double t)>;

// Cells of a patch at z = 2 m that is `length` by `width`, heights over its plane given; and the
// plane that fits it best.
struct Patch {
  std::vector<CellPoint> part;
  geometry::PlaneFit fit;

  Patch(double length, double width, const Height& height, double sigma = 0.0, unsigned seed = 1) {
    constexpr int kAlong = 40, kAcross = 12;
    std::mt19937 generator(seed);
    std::normal_distribution<double> noise(0.0, 1.0);
    geometry::PlaneMoments all;
    for (int i = 0; i < kAlong * kAcross; ++i) {
      const double s = length * ((i % kAlong + 0.5) / kAlong - 0.5);
      const double t = width * ((i / kAlong + 0.5) / kAcross - 0.5);
      const Eigen::Vector3d p(s, t, 2.0 - height(s, t) + sigma * noise(generator));
      part.push_back({p, 16.0});
      geometry::PlaneMoments moments;
      moments.weight = 16.0;
      moments.first = 16.0 * p;
      moments.second = 16.0 * p * p.transpose();
      all += moments;
    }
    fit = *all.fit(-all.centroid());
  }
};

TEST(PartCurvature, APlaneHasNone) {
  const Patch patch(0.5, 0.3, [](double s, double t) { return 0.2 * s - 0.1 * t; });
  const auto curvature = curvature_of(patch.part, patch.fit);
  ASSERT_TRUE(curvature);
  EXPECT_LT(curvature->value, 1e-6);
  EXPECT_LT(curvature->sagitta, 1e-9);
}

TEST(PartCurvature, ANarrowStripOfAPillarHasThatOfThePillar) {
  for (const double radius : {0.05, 0.18, 0.5}) {
    const double width = 0.4 * radius;
    const Patch patch(1.4, width,
                      [radius](double, double t) { return std::sqrt(radius * radius - t * t); });
    const auto curvature = curvature_of(patch.part, patch.fit);
    ASSERT_TRUE(curvature);
    EXPECT_NEAR(curvature->value * radius, 1.0, 0.05) << radius;
    EXPECT_NEAR(curvature->sagitta, width * width / (8.0 * radius), 0.06 * width * width / radius);
  }
}

TEST(PartCurvature, ABallHasThatOfTheBallWhicheverWayThePatchLies) {
  const Patch patch(0.08, 0.06, [](double s, double t) { return std::sqrt(0.04 - s * s - t * t); });
  const auto curvature = curvature_of(patch.part, patch.fit);
  ASSERT_TRUE(curvature);
  EXPECT_NEAR(curvature->value, 5.0, 0.4);
}

TEST(PartCurvature, SigmaSaysHowMuchNoiseFeigns) {
  // Of a plane under noise, curvature stays within its sigma most of the time, and the pillar's is
  // told apart where it is far beyond.
  int within = 0;
  for (unsigned seed = 1; seed <= 50; ++seed) {
    const Patch flat(
        0.5, 0.3, [](double, double) { return 0.0; }, 0.002, seed);
    const auto curvature = curvature_of(flat.part, flat.fit);
    ASSERT_TRUE(curvature);
    within += curvature->value < 3.0 * curvature->sigma;
    const Patch pillar(
        1.0, 0.1, [](double, double t) { return std::sqrt(0.0324 - t * t); }, 0.0005, seed);
    const auto bent = curvature_of(pillar.part, pillar.fit);
    ASSERT_TRUE(bent);
    EXPECT_GT(bent->value - 3.0 * bent->sigma, 4.0);
  }
  EXPECT_GE(within, 48);
}

TEST(PartCurvature, OfTooFewCellsNothingIsKnown) {
  const Patch patch(0.5, 0.3, [](double, double) { return 0.0; });
  EXPECT_FALSE(curvature_of({patch.part.begin(), patch.part.begin() + 11}, patch.fit));
}

}  // namespace
}  // namespace geomap::perception
