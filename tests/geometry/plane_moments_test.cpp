// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane_moments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/camera_model.hpp"
#include "geometry/random_polygons.hpp"

namespace geomap::geometry {
namespace {

using Eigen::Vector3d;
using testing::RandomShapes;

constexpr double kSigma = 0.02;  // white noise on depth [m]
const CameraModel kCoarseCamera{160,   120,  146.0,
                                146.0, 79.5, 59.5};  // a Kinect's, every fourth pixel

// A rectangle about `center`, turned by `tilt` [rad] about the camera's x axis.
struct Patch {
  Vector3d center = {0.1, 0.05, 1.5};
  double tilt = 0.0;
  double half_width = 0.2, half_height = 0.2;  // [m]

  Plane plane() const { return Plane::through(center, {0.0, std::sin(tilt), -std::cos(tilt)}); }
};

// Moments of what the camera sees of the patch with true noise `sigma`, given as `claimed`.
PlaneMoments observe(const Patch& patch, double sigma, double claimed, RandomShapes& random) {
  const Plane plane = patch.plane();
  const Vector3d up = plane.normal.cross(Vector3d::UnitX());
  PlaneMoments moments;
  for (int v = 0; v < kCoarseCamera.height; ++v) {
    for (int u = 0; u < kCoarseCamera.width; ++u) {
      const Vector3d ray = kCoarseCamera.ray(u, v);
      const double z = -plane.d / plane.normal.dot(ray);
      const Vector3d from_center = z * ray - patch.center;
      if (std::abs(from_center.x()) > patch.half_width ||
          std::abs(from_center.dot(up)) > patch.half_height) {
        continue;
      }
      moments.add((z + sigma * random.normal()) * ray, claimed);
    }
  }
  return moments;
}

PlaneFit fitted(const PlaneMoments& moments) { return moments.fit(-moments.centroid()).value(); }

// Turn of the fit about the camera's x axis against the truth [rad].
double tilt_error(const PlaneFit& fit, const Plane& truth) {
  return fit.plane.normal.cross(truth.normal).x();
}

Eigen::Isometry3d any_motion(const Vector3d& translation) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.rotate(Eigen::AngleAxisd(1.1, Vector3d(0.3, -0.4, 1.0).normalized()));
  T.pretranslate(translation);
  return T;
}

TEST(PlaneMoments, SumsAreThoseOfThePoints) {
  RandomShapes random(1);
  PlaneMoments moments;
  double weight = 0.0;
  Vector3d first = Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero(), noise = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 50; ++i) {
    const Vector3d p(random.normal(), random.normal(), 2.0 + random.between(0.0, 1.0));
    const double sigma = random.between(0.001, 0.02), w = 1.0 / (sigma * sigma);
    moments.add(p, sigma);
    weight += w;
    first += w * p;
    second += w * p * p.transpose();
    noise += w * sigma * sigma * (p / p.z()) * (p / p.z()).transpose();
  }
  EXPECT_NEAR(moments.weight / weight, 1.0, 1e-12);
  EXPECT_LT((moments.first - first).norm(), 1e-9 * first.norm());
  EXPECT_LT((moments.second - second).norm(), 1e-9 * second.norm());
  EXPECT_LT((moments.noise - noise).norm(), 1e-9 * noise.norm());
}

TEST(PlaneMoments, ArrayRoundTripIsExactAndMatricesAreSymmetric) {
  RandomShapes random(2);
  const PlaneMoments moments =
      observe({}, kSigma, kSigma, random).transformed(any_motion({3.0, -1.0, 0.5}));
  EXPECT_EQ(moments.second, moments.second.transpose());
  EXPECT_EQ(moments.noise, moments.noise.transpose());
  const PlaneMoments again = PlaneMoments::from_array(moments.to_array());
  EXPECT_EQ(again.weight, moments.weight);
  EXPECT_EQ(again.first, moments.first);
  EXPECT_EQ(again.second, moments.second);
  EXPECT_EQ(again.noise, moments.noise);
}

TEST(PlaneMoments, AddingScalingAndCapping) {
  RandomShapes random(3);
  const PlaneMoments a = observe({}, kSigma, kSigma, random), b = observe({}, kSigma, 0.01, random);
  PlaneMoments sum = a;
  sum += b;
  EXPECT_EQ(sum.weight, a.weight + b.weight);
  EXPECT_EQ(sum.second, a.second + b.second);
  EXPECT_EQ(sum.noise, a.noise + b.noise);
  const PlaneMoments capped = a.capped(a.weight / 4.0);
  EXPECT_NEAR(capped.weight, a.weight / 4.0, 1e-9 * a.weight);
  EXPECT_EQ(a.capped(2.0 * a.weight).weight, a.weight) << "never scaled up";
  const PlaneFit full = fitted(a), less = fitted(capped);
  EXPECT_LT(angle_between(full.plane, less.plane), 1e-9);
  EXPECT_NEAR(less.sigma_angle(), 2.0 * full.sigma_angle(), 1e-6 * full.sigma_angle());
}

TEST(PlaneMoments, TransformingIsObservingInTheOtherFrameAndComesBack) {
  RandomShapes random(4);
  const PlaneMoments moments = observe({.tilt = 0.6}, kSigma, kSigma, random);
  const Eigen::Isometry3d T_b_a = any_motion({3.0, -1.0, 0.5});
  const PlaneMoments moved = moments.transformed(T_b_a);
  EXPECT_LT((moved.centroid() - T_b_a * moments.centroid()).norm(), 1e-9);
  const PlaneMoments back = moved.transformed(T_b_a.inverse());
  EXPECT_LT((back.second - moments.second).norm(), 1e-9 * moments.second.norm());
  EXPECT_LT((back.noise - moments.noise).norm(), 1e-9 * moments.noise.norm());
}

TEST(PlaneMoments, TheFitTurnsAndMovesWithTheFrame) {
  RandomShapes random(5);
  const PlaneMoments moments = observe({.tilt = 0.6}, kSigma, kSigma, random);
  const PlaneFit here = fitted(moments);
  struct Case {
    double distance, angle_tolerance, offset_tolerance;
  };
  // A kilometre from the origin some digits are gone: frames belong near their points.
  for (const auto& [distance, angle, offset] : {Case{3.0, 1e-9, 1e-9}, Case{1000.0, 1e-5, 1e-5}}) {
    const Eigen::Isometry3d T_b_a = any_motion(Vector3d(1.0, -0.5, 0.2).normalized() * distance);
    const Plane expected = here.plane.transformed(T_b_a);
    const PlaneFit there = moments.transformed(T_b_a).fit(expected.normal).value();
    EXPECT_LT(angle_between(there.plane, expected), angle) << distance;
    EXPECT_NEAR(there.plane.signed_distance(T_b_a * here.centroid), 0.0, offset) << distance;
    EXPECT_NEAR(there.rms, here.rms, 1e-4 * here.rms + offset) << distance;
    EXPECT_NEAR(there.sigma_angle(), here.sigma_angle(), 1e-3 * here.sigma_angle()) << distance;
  }
}

TEST(PlaneMoments, ExactPointsGiveTheirPlaneOnTheSideAskedFor) {
  RandomShapes random(6);
  const Patch patch{.tilt = 0.9};
  const PlaneMoments moments = observe(patch, 0.0, 1e-4, random);
  const PlaneFit fit = fitted(moments);
  EXPECT_LT(angle_between(fit.plane, patch.plane()), 1e-6);
  EXPECT_NEAR(fit.plane.d, patch.plane().d, 1e-6);
  EXPECT_LT(fit.rms, 1e-6);
  EXPECT_LT(angle_between(moments.fit(-patch.plane().normal)->plane, patch.plane().flipped()),
            1e-6);
}

TEST(PlaneMoments, TheAxesAreRightHandedAndOrderedByExtent) {
  RandomShapes random(7);
  const PlaneFit fit =
      fitted(observe({.half_width = 0.3, .half_height = 0.15}, 0.002, 0.002, random));
  EXPECT_NEAR(fit.axes.determinant(), 1.0, 1e-9);
  EXPECT_GT(std::abs(fit.axes(0, 0)), 0.999) << "the major axis is the wide one";
  EXPECT_NEAR(fit.extent(0), 0.6 * 0.6 / 12.0, 0.002);
  EXPECT_NEAR(fit.extent(1), 0.3 * 0.3 / 12.0, 0.001);
  EXPECT_NEAR(fit.rms, 0.002, 0.0002);
}

// Depth noise lies along the ray: on a 0.4 m patch seen at 60 degrees it tilts the plain fit by
// about sigma² sin 60° cos 60° / (0.4² / 12) = 0.013 rad, however many views are averaged.
TEST(PlaneMoments, CompensationRemovesTheTiltOfObliquePatches) {
  const Patch patch{.tilt = std::numbers::pi / 3.0};
  RandomShapes random(8);
  double plain = 0.0, compensated = 0.0;
  constexpr int kViews = 200;
  for (int view = 0; view < kViews; ++view) {
    PlaneMoments moments = observe(patch, kSigma, kSigma, random);
    compensated += tilt_error(fitted(moments), patch.plane()) / kViews;
    moments.noise.setZero();
    plain += tilt_error(fitted(moments), patch.plane()) / kViews;
  }
  RecordProperty("plain_tilt_rad", std::to_string(plain));
  RecordProperty("compensated_tilt_rad", std::to_string(compensated));
  EXPECT_GT(std::abs(plain), 0.008);
  EXPECT_LT(std::abs(plain), 0.018);
  EXPECT_LT(std::abs(compensated), std::abs(plain) / 6.0);
}

TEST(PlaneMoments, SummedViewsKeepTheCompensation) {
  const Patch patch{.tilt = std::numbers::pi / 3.0};
  RandomShapes random(9);
  PlaneMoments sum;
  for (int view = 0; view < 200; ++view) sum += observe(patch, kSigma, kSigma, random);
  const double compensated = tilt_error(fitted(sum), patch.plane());
  sum.noise.setZero();
  const double plain = tilt_error(fitted(sum), patch.plane());
  EXPECT_LT(std::abs(compensated), std::abs(plain) / 6.0);
}

TEST(PlaneMoments, OverstatedNoiseDoesNotBreakTheFit) {
  for (const double tilt : {0.0, 0.5, 1.05}) {
    const Patch patch{.tilt = tilt};
    RandomShapes random(10);
    const PlaneFit fit = fitted(observe(patch, 0.0, kSigma, random));
    EXPECT_LT(angle_between(fit.plane, patch.plane()), 1e-4) << tilt;
    const PlaneFit noisy = fitted(observe(patch, 0.002, kSigma, random));
    EXPECT_LT(angle_between(noisy.plane, patch.plane()), 0.004) << tilt;
  }
}

// Scatter of many fits against the covariance that each of them states.
struct Spread {
  Vector3d measured = Vector3d::Zero(), stated = Vector3d::Zero();
};

Spread spread_of_fits(const Patch& patch, std::uint32_t seed) {
  constexpr int kFits = 500;
  RandomShapes random(seed);
  const Plane truth = patch.plane();
  Spread spread;
  for (int i = 0; i < kFits; ++i) {
    const PlaneFit fit = fitted(observe(patch, kSigma, kSigma, random));
    const Vector3d error(fit.axes.col(0).dot(truth.normal), fit.axes.col(1).dot(truth.normal),
                         truth.signed_distance(fit.centroid));
    spread.measured += error.cwiseAbs2() / kFits;
    spread.stated += fit.covariance.diagonal() / kFits;
  }
  return spread;
}

TEST(PlaneMoments, CovarianceIsRightForASurfaceFacingTheCamera) {
  const Spread spread =
      spread_of_fits({.center = {0.0, 0.0, 1.5}, .half_width = 0.35, .half_height = 0.2}, 11);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(spread.stated(i) / spread.measured(i), 1.0, 0.25) << i;
  }
}

TEST(PlaneMoments, CovarianceIsConservativeForAnObliqueSurface) {
  const Spread spread = spread_of_fits({.tilt = 1.0, .half_width = 0.35, .half_height = 0.2}, 12);
  for (int i = 0; i < 3; ++i) EXPECT_GT(spread.stated(i), spread.measured(i)) << i;
}

TEST(PlaneMoments, OffsetIsLessCertainAwayFromTheCentroid) {
  RandomShapes random(13);
  const PlaneFit fit = fitted(observe({}, kSigma, kSigma, random));
  const double at_centroid = fit.sigma_offset(fit.centroid);
  EXPECT_NEAR(at_centroid, std::sqrt(fit.covariance(2, 2)), 1e-12);
  const double aside = fit.sigma_offset(fit.centroid + fit.axes.col(0));
  EXPECT_NEAR(aside, std::sqrt(fit.covariance(2, 2) + fit.covariance(0, 0)), 1e-12);
}

TEST(PlaneMoments, DegeneratePointsGiveNoPlane) {
  const auto fit_of = [](const std::vector<Vector3d>& points, double sigma = 0.001) {
    PlaneMoments moments;
    for (const Vector3d& p : points) moments.add(p, sigma);
    return moments.fit(-Vector3d::UnitZ());
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(fit_of({}));
  EXPECT_FALSE(fit_of({{0.1, 0.2, 1.0}})) << "one point";
  EXPECT_FALSE(fit_of({{0.1, 0.2, 1.0}, {0.3, 0.2, 1.0}})) << "two points";
  EXPECT_FALSE(fit_of({{0, 0, 1}, {0.1, 0.2, 1.1}, {0.2, 0.4, 1.2}, {0.4, 0.8, 1.4}}))
      << "collinear";
  EXPECT_FALSE(fit_of(std::vector<Vector3d>(10, {0.1, 0.2, 1.0}))) << "ten equal points";
  EXPECT_FALSE(fit_of(std::vector<Vector3d>(10, {3.1, 2.2, 5.0}), 0.02)) << "ten equal points, far";
  EXPECT_FALSE(fit_of({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {nan, 0, 1}})) << "not a number";
  EXPECT_TRUE(fit_of({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}})) << "three points";
}

}  // namespace
}  // namespace geomap::geometry
