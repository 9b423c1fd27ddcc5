// SPDX-License-Identifier: BSD-3-Clause
#include "perception/depth_correction_estimator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "distorted_views.hpp"
#include "registration_scenes.hpp"

namespace geomap::perception {
namespace {

using Eigen::Isometry3d;
using geometry::CameraModel;

/// What the estimator makes of all pairs of views with this error.
/// @param metres, degrees of error of each pose that it is told.
geometry::DepthCorrection learnt(const geometry::DepthCorrection& truth, double metres,
                                 double degrees,
                                 const std::vector<geometry::DepthCorrection>& applied = {
                                     geometry::DepthCorrection()}) {
  std::vector<SurfaceImage> views;
  std::vector<Isometry3d> told;
  std::vector<geometry::DepthCorrection> corrections;
  for (const Isometry3d& T : poses_around_the_room()) {
    const auto rendering = testing::render(testing::small_room(), testing::kinect_camera(7), T);
    corrections.push_back(applied[views.size() % applied.size()]);
    views.emplace_back(corrected(distorted(rendering, truth), corrections.back()), 0.4, 5.0);
    told.push_back(disturbed(T, metres, degrees, static_cast<unsigned>(told.size() + 1)));
  }
  DepthCorrectionEstimator estimator;
  for (std::size_t a = 0; a < views.size(); ++a) {
    for (std::size_t b = a + 1; b < views.size(); ++b) {
      estimator.add({views[a], told[a], corrections[a]}, {views[b], told[b], corrections[b]});
    }
  }
  return estimator.estimate();
}

/// Root mean square over the image.
double rms(const geometry::DepthCorrection& correction) {
  const CameraModel camera = testing::kinect_camera(7);
  double squares = 0.0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d ray = camera.ray(u, v);
      squares += std::pow(correction.share(ray.x(), ray.y()), 2);
    }
  }
  return std::sqrt(squares / (camera.width * camera.height));
}

double relative_error(const geometry::DepthCorrection& found,
                      const geometry::DepthCorrection& truth) {
  return rms(geometry::DepthCorrection(found.coefficients() - truth.coefficients())) / rms(truth);
}

TEST(DepthCorrectionEstimator, WithoutViewsItIsAsUncertainAsThePriorAndLessWithEachPair) {
  const CameraModel camera = testing::kinect_camera(7);
  DepthCorrectionEstimator estimator;
  // All terms are about 1 at the image's corner.
  const DepthCorrectionConfig config;
  const double prior =
      std::sqrt(12.0 * std::pow(config.sigma, 2) + 2.0 * std::pow(config.linear_sigma, 2));
  EXPECT_NEAR(estimator.largest_sigma(camera), prior, 0.1 * prior);
  std::vector<SurfaceImage> views;
  const std::vector<Isometry3d> poses = poses_around_the_room();
  for (std::size_t i = 0; i < 12; ++i) {
    views.emplace_back(testing::render(testing::small_room(), camera, poses[i]).frame, 0.4, 5.0);
  }
  const geometry::DepthCorrection none;
  double before = estimator.largest_sigma(camera);
  for (std::size_t i = 1; i < views.size(); ++i) {
    if (estimator.add({views[i - 1], poses[i - 1], none}, {views[i], poses[i], none}) == 0)
      continue;
    const double after = estimator.largest_sigma(camera);
    EXPECT_LT(after, before);
    before = after;
  }
  EXPECT_LT(before, 0.9 * prior);
}

TEST(DepthCorrectionEstimator, WithoutViewsThereIsNoCorrection) {
  EXPECT_TRUE(DepthCorrectionEstimator().estimate().is_none());
}

TEST(DepthCorrectionEstimator, LearnsAFixedErrorFromViewsWithKnownPoses) {
  const double error = relative_error(learnt(bowl(), 0.0, 0.0), bowl());
  EXPECT_LT(error, 0.3);
  RecordProperty("relative error", std::to_string(error));
}

TEST(DepthCorrectionEstimator, LearnsItAsWellWherePosesAreOffByACentimetre) {
  const double error = relative_error(learnt(bowl(), 0.01, 0.5), bowl());
  EXPECT_LT(error, 0.3);
  RecordProperty("relative error", std::to_string(error));
}

TEST(DepthCorrectionEstimator, FindsTheWholeErrorWhereAPartIsCorrectedAlready) {
  const geometry::DepthCorrection half(0.5 * bowl().coefficients());
  EXPECT_LT(relative_error(learnt(bowl(), 0.0, 0.0, {half}), bowl()), 0.3);
}

TEST(DepthCorrectionEstimator, FindsItFromViewsOfWhichEachWasCorrectedInAnotherWay) {
  const geometry::DepthCorrection half(0.5 * bowl().coefficients()),
      beyond(1.4 * bowl().coefficients());
  EXPECT_LT(relative_error(learnt(bowl(), 0.0, 0.0, {{}, half, beyond}), bowl()), 0.3);
}

TEST(DepthCorrectionEstimator, FindsNothingWhereThereIsNoError) {
  const CameraModel camera = testing::kinect_camera();
  for (const double metres : {0.0, 0.01}) {
    const double largest = geometry::DepthCorrection::largest_difference(
        learnt(geometry::DepthCorrection(), metres, 50.0 * metres), geometry::DepthCorrection(),
        camera);
    EXPECT_LT(largest, 0.001);
    RecordProperty("largest at " + std::to_string(metres) + " m", std::to_string(largest));
  }
}

TEST(DepthCorrectionEstimator, TakesNothingFromViewsThatShareNothing) {
  const RegistrationScene room = room_scene();
  const SurfaceImage view = exact_view(room, room.T_world_camera);
  const Isometry3d elsewhere = Eigen::Translation3d(20.0, 0.0, 0.0) * room.T_world_camera;
  DepthCorrectionEstimator estimator;
  EXPECT_EQ(estimator.add({view, room.T_world_camera, {}}, {view, elsewhere, {}}), 0);
  EXPECT_TRUE(estimator.estimate().is_none());
}

// What the data do not support stays zero: two views say little, and no more than the truth.
TEST(DepthCorrectionEstimator, FewViewsGiveACautiousCorrection) {
  const std::vector<Isometry3d> all = poses_around_the_room();
  std::vector<SurfaceImage> views;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto rendering =
        testing::render(testing::small_room(), testing::kinect_camera(7), all[i]);
    views.emplace_back(distorted(rendering, bowl()), 0.4, 5.0);
  }
  DepthCorrectionEstimator estimator;
  EXPECT_GT(estimator.add({views[0], all[0], {}}, {views[1], all[1], {}}), 500);
  EXPECT_LT(rms(estimator.estimate()), rms(bowl()));
  EXPECT_LT(relative_error(estimator.estimate(), bowl()), 1.0);
}

TEST(DepthCorrectionEstimator, RefusesSettingsThatMakeNoSense) {
  DepthCorrectionConfig config;
  config.sigma = 0.0;
  config.linear_sigma = 1.0;
  config.least_change = -1.0;
  config.correlation = 0.5;
  EXPECT_EQ(config.validate().size(), 4U);
  EXPECT_THROW(DepthCorrectionEstimator{config}, std::invalid_argument);
}

}  // namespace
}  // namespace geomap::perception
