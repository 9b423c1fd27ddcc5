// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/odometry_drift.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <unsupported/Eigen/MatrixFunctions>

#include "drivers/data_set_writer.hpp"

namespace geomap::drivers {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

OdometryDriftConfig config(double m_per_m, double deg_per_m, int seed = 1) {
  OdometryDriftConfig result;
  result.drift_m_per_m = m_per_m;
  result.drift_deg_per_m = deg_per_m;
  result.seed = seed;
  return result;
}

Eigen::Matrix4d hat(const Vector6d& xi) {
  Eigen::Matrix4d M = Eigen::Matrix4d::Zero();
  M.topLeftCorner<3, 3>() << 0.0, -xi[5], xi[4], xi[5], 0.0, -xi[3], -xi[4], xi[3], 0.0;
  M.topRightCorner<3, 1>() = xi.head<3>();
  return M;
}

// A straight walk of `steps` steps of `length` along the body's x from some pose; where it ends.
Eigen::Isometry3d walk(OdometryDrift& drift, int steps, double length) {
  Eigen::Isometry3d T_world_body = testing::some_pose(2);
  Eigen::Isometry3d T_odom_body = drift.next(T_world_body);
  for (int i = 0; i < steps; ++i) {
    T_world_body.translate(Eigen::Vector3d(length, 0.0, 0.0));
    T_odom_body = drift.next(T_world_body);
  }
  return T_odom_body;
}

TEST(OdometryDrift, IsExactAtTheFirstPose) {
  OdometryDrift drift(config(0.5, 30.0));
  EXPECT_EQ(drift.next(testing::some_pose(4)).matrix(), testing::some_pose(4).matrix());
}

TEST(OdometryDrift, BiasHasTheConfiguredSizes) {
  for (int seed = 0; seed < 20; ++seed) {
    const OdometryDrift drift(config(0.03, 2.0, seed));
    EXPECT_NEAR(drift.bias().head<3>().norm(), 0.03, 1e-15);
    EXPECT_NEAR(drift.bias().tail<3>().norm(), 2.0 * std::numbers::pi / 180.0, 1e-15);
  }
}

TEST(OdometryDrift, WithoutRotationTheErrorIsTheBiasTimesThePath) {
  OdometryDrift drift(config(0.02, 0.0));
  const Eigen::Vector3d bias = drift.bias().head<3>();
  const Eigen::Isometry3d end = walk(drift, 50, 0.1);
  const Eigen::Vector3d expected =
      testing::some_pose(2) * Eigen::Vector3d(Eigen::Vector3d(5.0, 0.0, 0.0) + 5.0 * bias);
  EXPECT_LT((end.translation() - expected).norm(), 1e-12);
  EXPECT_LT((end.linear() - testing::some_pose(2).linear()).norm(), 1e-12);
}

TEST(OdometryDrift, AStraightWalkBecomesAPowerOfOneDriftedStep) {
  for (const double degrees : {1e-6, 1.0, 40.0}) {
    OdometryDrift drift(config(0.05, degrees, 7));
    Eigen::Matrix4d step = Eigen::Matrix4d::Identity();
    step(0, 3) = 0.3;
    const Eigen::Matrix4d drifted = step * hat(0.3 * drift.bias()).exp();
    Eigen::Matrix4d expected = testing::some_pose(2).matrix();
    for (int i = 0; i < 20; ++i) expected = expected * drifted;
    EXPECT_LT((walk(drift, 20, 0.3).matrix() - expected).norm(), 1e-10) << degrees;
  }
}

TEST(OdometryDrift, AWalkTurnsByTheConfiguredAngle) {
  OdometryDrift drift(config(0.0, 1.5, 3));
  const Eigen::Matrix3d turned =
      testing::some_pose(2).linear().transpose() * walk(drift, 100, 0.1).linear();
  EXPECT_NEAR(Eigen::AngleAxisd(turned).angle(), 15.0 * std::numbers::pi / 180.0, 1e-9);
}

TEST(OdometryDrift, ARobotThatOnlyTurnsDoesNotDrift) {
  OdometryDrift drift(config(0.5, 30.0));
  Eigen::Isometry3d T_world_body = testing::some_pose(0);
  for (int i = 0; i < 10; ++i) {
    EXPECT_LT((drift.next(T_world_body).matrix() - T_world_body.matrix()).norm(), 1e-12);
    T_world_body.rotate(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitZ()));
  }
}

TEST(OdometryDrift, DoesNotDependOnWhereTheWorldsOriginIs) {
  OdometryDrift here(config(0.05, 3.0)), there(config(0.05, 3.0));
  const Eigen::Isometry3d T_far_world =
      testing::some_pose(9) * Eigen::Translation3d(1000.0, 0.0, 0.0);
  for (int i = 0; i < 10; ++i) {
    const Eigen::Isometry3d expected = T_far_world * here.next(testing::some_pose(i));
    const Eigen::Isometry3d actual = there.next(T_far_world * testing::some_pose(i));
    EXPECT_LT((actual.matrix() - expected.matrix()).norm(), 1e-9);
  }
}

TEST(OdometryDrift, TheSeedAloneDecidesTheDirections) {
  EXPECT_EQ(OdometryDrift(config(0.02, 1.0, 5)).bias(), OdometryDrift(config(0.02, 1.0, 5)).bias());
  EXPECT_NE(OdometryDrift(config(0.02, 1.0, 5)).bias(), OdometryDrift(config(0.02, 1.0, 6)).bias());
}

// From a Mersenne Twister (64 bit) written down in Python, with the same rejection from the cube.
TEST(OdometryDrift, TheNumbersAreThoseOfAnotherImplementation) {
  Vector6d expected;
  expected << -0.001353255651817786, -0.01969072513076348, 0.003231724456933601,
      0.0054148497026252134, -0.016438876170955623, 0.002249482767365794;
  EXPECT_LT((OdometryDrift(config(0.02, 1.0, 1)).bias() - expected).norm(), 1e-16);
}

TEST(OdometryDrift, SettingsOutOfRangeAreRefused) {
  EXPECT_THROW(OdometryDrift(config(-0.01, 1.0)), std::invalid_argument);
  EXPECT_THROW(OdometryDrift(config(0.01, std::numeric_limits<double>::quiet_NaN())),
               std::invalid_argument);
  EXPECT_THROW(OdometryDrift(config(0.01, 1.0, -1)), std::invalid_argument);
}

}  // namespace
}  // namespace geomap::drivers
