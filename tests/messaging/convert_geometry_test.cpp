// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/convert_geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "messaging/encode.hpp"
#include "messaging/safe_decode.hpp"

namespace geomap::messaging {
namespace {

Eigen::Isometry3d random_transform(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
                   .normalized()
                   .toRotationMatrix();
  T.translation() = 10.0 * Eigen::Vector3d(normal(random), normal(random), normal(random));
  return T;
}

/// Over the wire and back: what a reader in another process gets.
template <class Message>
Message sent(const Message& message) {
  const std::vector<std::uint8_t> bytes = encode(message);
  auto result = safe_decode<Message>(bytes.data(), bytes.size());
  if (!result.message) throw std::runtime_error(to_string(result.reason));
  return *result.message;
}

geometry::PlaneObservation some_plane(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  geometry::PlaneObservation plane;
  const Eigen::Isometry3d T = random_transform(random);
  plane.surface.plane = {T.linear().col(2), uniform(random)};
  plane.surface.frame = {T.translation(), T.linear().col(0), T.linear().col(2)};
  plane.surface.polygon.parts = {
      {{{0, 0}, {10000, 0}, {10000, 8000}, {0, 8000}},
       {{{1000, 1000}, {1000, 2000}, {2000, 2000}, {2000, 1000}}}},
      {{{-5000, -5000}, {-4000, -5000}, {-4000, -4000}}, {}},
  };
  for (int i = 0; i < 100; ++i) {
    plane.moments.add({uniform(random), uniform(random), 2.0 + uniform(random)}, 0.003);
  }
  plane.inliers = 12345;
  plane.rms = 0.1 / 3.0;
  plane.color = {1.0 / 3.0, 128.1, 255.0};
  return plane;
}

TEST(ConvertGeometry, RigidTransformsSurviveTheWire) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Isometry3d T = random_transform(random);
    EXPECT_TRUE(from_message(sent(to_rigid_transform(7, T))).isApprox(T, 1e-14));
    EXPECT_TRUE(from_message(sent(to_pose(7, T))).isApprox(T, 1e-14));
  }
}

TEST(ConvertGeometry, TheQuaternionOnTheWireStartsWithW) {
  const Eigen::Isometry3d T(Eigen::AngleAxisd(std::numbers::pi / 2.0, Eigen::Vector3d::UnitZ()));
  const bot_core::rigid_transform_t message = to_rigid_transform(42, T);
  EXPECT_EQ(message.utime, 42);
  EXPECT_NEAR(std::abs(message.quat[0]), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(message.quat[0], message.quat[3], 1e-15);
  EXPECT_EQ(message.quat[1], 0.0);
  // Turning by +90° about z takes x to y.
  const Eigen::Vector3d turned = from_message(message) * Eigen::Vector3d::UnitX();
  EXPECT_TRUE(turned.isApprox(Eigen::Vector3d::UnitY(), 1e-15));
}

TEST(ConvertGeometry, AQuaternionThatIsOffByRoundingBecomesARotation) {
  bot_core::pose_t message = to_pose(0, Eigen::Isometry3d::Identity());
  message.orientation[0] = 0.999;
  EXPECT_NEAR(from_message(message).linear().determinant(), 1.0, 1e-15);
}

TEST(ConvertGeometry, AZeroQuaternionIsRefused) {
  EXPECT_THROW(from_message(bot_core::pose_t{}), std::invalid_argument);
  bot_core::rigid_transform_t message{};
  message.quat[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(from_message(message), std::invalid_argument);
}

TEST(ConvertGeometry, ExactTransformsAreTheSameToTheLastBit) {
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Isometry3d T = random_transform(random);
    const Eigen::Isometry3d back = from_message(sent(to_message(T)));
    EXPECT_EQ(back.linear(), T.linear());
    EXPECT_EQ(back.translation(), T.translation());
  }
}

TEST(ConvertGeometry, TheExactRotationIsWrittenRowByRow) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const transform_t message = to_message(T);
  EXPECT_EQ(message.rotation[1], -1.0);
  EXPECT_EQ(message.rotation[3], 1.0);
}

TEST(ConvertGeometry, CamerasAreTheSameAfterARoundTrip) {
  const geometry::CameraModel camera{640, 480, 585.1, 584.9, 320.25, 239.75};
  EXPECT_EQ(from_message(sent(to_message(camera))), camera);
}

TEST(ConvertGeometry, PlanesAreTheSameToTheLastBit) {
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    const geometry::PlaneObservation plane = some_plane(random);
    const auto back = from_message(sent(to_message(plane)));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->surface.plane.normal, plane.surface.plane.normal);
    EXPECT_EQ(back->surface.plane.d, plane.surface.plane.d);
    EXPECT_EQ(back->surface.frame.origin, plane.surface.frame.origin);
    EXPECT_EQ(back->surface.frame.x_axis, plane.surface.frame.x_axis);
    EXPECT_EQ(back->surface.frame.normal, plane.surface.frame.normal);
    EXPECT_EQ(back->surface.polygon, plane.surface.polygon);
    EXPECT_EQ(back->moments.to_array(), plane.moments.to_array());
    EXPECT_EQ(back->inliers, plane.inliers);
    EXPECT_EQ(back->rms, plane.rms);
    EXPECT_EQ(back->color, plane.color);
  }
}

TEST(ConvertGeometry, PlaneSetsAreTheSameToTheLastBit) {
  std::mt19937 random(4);
  const PlaneSet planes{
      1000, 900, 7, random_transform(random), 1.0 / 3.0, {some_plane(random), some_plane(random)}};
  const auto back = from_message(sent(to_message(planes)));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->keyframe, 1000);
  EXPECT_EQ(back->session, 900);
  EXPECT_EQ(back->sequence, 7);
  EXPECT_EQ(back->T_world_camera.matrix(), planes.T_world_camera.matrix());
  EXPECT_EQ(back->noise_factor, planes.noise_factor);
  ASSERT_EQ(back->planes.size(), 2U);
  EXPECT_EQ(encode(to_message(*back)), encode(to_message(planes)));
}

TEST(ConvertGeometry, APlaneWithoutPolygonOrASetWithoutPlanesIsFine) {
  std::mt19937 random(5);
  geometry::PlaneObservation plane = some_plane(random);
  plane.surface.polygon.parts.clear();
  EXPECT_TRUE(from_message(sent(to_message(plane))));
  EXPECT_TRUE(from_message(sent(to_message(PlaneSet{}))));
}

class HostilePlane : public ::testing::Test {
 protected:
  bool accepted() const { return from_message(sent(message_)).has_value(); }
  std::mt19937 random_{6};
  plane_t message_ = to_message(some_plane(random_));
};

TEST_F(HostilePlane, IsAcceptedAsLongAsNothingIsWrong) { EXPECT_TRUE(accepted()); }

TEST_F(HostilePlane, WithABowTieIsRefused) {
  std::swap(message_.polygon.parts[0].outer.x[1], message_.polygon.parts[0].outer.x[2]);
  std::swap(message_.polygon.parts[0].outer.y[1], message_.polygon.parts[0].outer.y[2]);
  EXPECT_FALSE(accepted());
}

TEST_F(HostilePlane, WithACoordinateWhoseSquareOverflowsIsRefused) {
  message_.polygon.parts[0].outer.x[1] = std::numeric_limits<std::int32_t>::max();
  EXPECT_FALSE(accepted());
  message_.polygon.parts[0].outer.x[1] = std::numeric_limits<std::int32_t>::min();
  EXPECT_FALSE(accepted());
}

TEST_F(HostilePlane, WithTooManyVerticesIsRefusedAtOnce) {
  ring_t& ring = message_.polygon.parts[1].outer;
  for (int i = 0; i < 30000; ++i) {
    ring.x.push_back(i);
    ring.y.push_back(i % 2);
  }
  ring.n = static_cast<std::int32_t>(ring.x.size());
  EXPECT_FALSE(accepted());
}

TEST_F(HostilePlane, WithSkewAxesIsRefused) {
  std::copy(std::begin(message_.frame.normal), std::end(message_.frame.normal),
            message_.frame.x_axis);
  EXPECT_FALSE(accepted());
}

TEST_F(HostilePlane, WithNegativeWeightOrInliersIsRefused) {
  plane_t light = message_;
  light.moments[0] = -1.0;
  EXPECT_FALSE(from_message(sent(light)));
  message_.inliers = -1;
  EXPECT_FALSE(accepted());
}

TEST_F(HostilePlane, MakesItsWholeSetRefused) {
  plane_set_t set = to_message(PlaneSet{});
  message_.rms = -1.0;
  set.planes = {to_message(some_plane(random_)), message_};
  set.n_planes = 2;
  EXPECT_FALSE(from_message(sent(set)));
}

}  // namespace
}  // namespace geomap::messaging
