// SPDX-License-Identifier: BSD-3-Clause
#include "perception/trust_prior.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "support/plane_renderer.hpp"

namespace geomap::perception {
namespace {

FrameView view_with_readings(int readings) {
  geometry::RgbdFrame frame;
  frame.depth_camera = testing::kinect_camera(8);
  frame.depth.width = frame.depth_camera.width;
  frame.depth.height = frame.depth_camera.height;
  frame.depth.millimetres.assign(static_cast<std::size_t>(frame.depth.width * frame.depth.height),
                                 geometry::DepthImage::kInvalid);
  std::fill_n(frame.depth.millimetres.begin(), readings, std::uint16_t{1500});
  return {frame, frame, SurfaceImage(frame, 0.4, 5.0)};
}

RegistrationResult align(const TrustPrior& registration, int readings,
                         const Eigen::Isometry3d& prior = Eigen::Isometry3d::Identity(),
                         PriorSource source = PriorSource::kMeasured) {
  return registration.align(view_with_readings(readings), VoxelMap(), prior, source);
}

TEST(TrustPrior, TakesARigidPriorAsThePose) {
  const Eigen::Isometry3d prior = testing::look_at({900.0, -20.0, 1.5}, {903.0, -19.0, 1.0});
  TrustPrior registration;
  const RegistrationResult result = align(registration, 400, prior);
  EXPECT_TRUE(result.accepted);
  EXPECT_EQ(result.reason, RegistrationReason::kPriorTrusted);
  EXPECT_EQ(result.T_world_camera.matrix(), prior.matrix());
  EXPECT_EQ(result.T_world_camera_prior.matrix(), prior.matrix());
  EXPECT_EQ(result.readings, 400);
}

TEST(TrustPrior, ClaimsNoMeasurementThatItHasNotMade) {
  TrustPrior registration;
  EXPECT_FALSE(align(registration, 400).alignment.has_value());
}

TEST(TrustPrior, RejectsAFrameWithTooFewReadings) {
  TrustPrior registration(TrustPriorConfig{100});
  EXPECT_TRUE(align(registration, 100).accepted);
  for (const int readings : {99, 0}) {
    const auto result = align(registration, readings);
    EXPECT_FALSE(result.accepted);
    EXPECT_EQ(to_string(result.reason), "too_few_readings");
  }
}

TEST(TrustPrior, DoesNotTrustAGuess) {
  TrustPrior registration;
  const auto result =
      align(registration, 400, Eigen::Isometry3d::Identity(), PriorSource::kGuessed);
  EXPECT_FALSE(result.accepted);
  EXPECT_EQ(to_string(result.reason), "underconstrained");
}

TEST(TrustPrior, RejectsAPriorThatIsNoRigidMotion) {
  Eigen::Isometry3d not_finite = Eigen::Isometry3d::Identity();
  not_finite.translation().y() = std::numeric_limits<double>::infinity();
  Eigen::Isometry3d scaled = Eigen::Isometry3d::Identity();
  scaled.linear() *= 1.001;
  Eigen::Isometry3d mirrored = Eigen::Isometry3d::Identity();
  mirrored.linear()(2, 2) = -1.0;
  TrustPrior registration;
  for (const auto& prior : {not_finite, scaled, mirrored}) {
    const auto result = align(registration, 400, prior);
    EXPECT_FALSE(result.accepted);
    EXPECT_EQ(to_string(result.reason), "invalid_prior");
  }
}

TEST(TrustPrior, RefusesToTrustBlindFrames) {
  EXPECT_THROW(TrustPrior(TrustPriorConfig{0}), std::invalid_argument);
}

}  // namespace
}  // namespace geomap::perception
