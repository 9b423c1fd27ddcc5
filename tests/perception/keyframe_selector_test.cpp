// SPDX-License-Identifier: BSD-3-Clause
#include "perception/keyframe_selector.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include "geometry/angles.hpp"

namespace geomap::perception {
namespace {

Eigen::Isometry3d moved(double metres, double degrees) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translate(Eigen::Vector3d(1.0, -2.0, 2.0).normalized() * metres);
  T.rotate(
      Eigen::AngleAxisd(geometry::radians(degrees), Eigen::Vector3d(2.0, 1.0, -1.0).normalized()));
  return T;
}

TEST(KeyframeSelector, TheFirstFrameIsAlwaysDue) {
  KeyframeSelector selector;
  EXPECT_TRUE(selector.is_due(moved(0.0, 0.0)));
  selector.accept(moved(0.0, 0.0));
  EXPECT_FALSE(selector.is_due(moved(0.0, 0.0)));
  selector.reset();
  EXPECT_TRUE(selector.is_due(moved(0.0, 0.0)));
}

TEST(KeyframeSelector, EitherDistanceOrTurnMakesAFrameDue) {
  KeyframeSelector selector;
  selector.accept(moved(0.0, 0.0));
  EXPECT_FALSE(selector.is_due(moved(0.099, 4.9)));
  EXPECT_TRUE(selector.is_due(moved(0.101, 0.0)));
  EXPECT_TRUE(selector.is_due(moved(0.0, 5.1)));
  EXPECT_TRUE(selector.is_due(moved(0.0, -5.1)));
  EXPECT_TRUE(selector.is_due(moved(0.0, 180.0)));
}

TEST(KeyframeSelector, ARejectedFrameLeavesTheNextOneDue) {
  KeyframeSelector selector;
  selector.accept(moved(0.0, 0.0));
  EXPECT_TRUE(selector.is_due(moved(0.11, 0.0)));  // registration rejects it: not accepted
  EXPECT_TRUE(selector.is_due(moved(0.12, 0.0)));
  selector.accept(moved(0.12, 0.0));
  EXPECT_FALSE(selector.is_due(moved(0.20, 0.0)));
  EXPECT_TRUE(selector.is_due(moved(0.23, 0.0)));
}

TEST(KeyframeSelector, MotionIsMeasuredFromTheLastKeyFrameWhereverThatIs) {
  const Eigen::Isometry3d far_away = Eigen::Translation3d(1000.0, 0.0, 0.0) * moved(3.0, 70.0);
  KeyframeSelector selector;
  selector.accept(far_away);
  EXPECT_FALSE(selector.is_due(far_away * moved(0.09, 4.5)));
  EXPECT_TRUE(selector.is_due(far_away * moved(0.11, 4.5)));
  EXPECT_TRUE(selector.is_due(far_away * moved(0.09, 5.5)));
}

TEST(KeyframeSelector, ThresholdsOfZeroTakeEveryFrame) {
  KeyframeSelector selector(KeyframeConfig{0.0, 0.0});
  selector.accept(moved(1.0, 1.0));
  EXPECT_TRUE(selector.is_due(moved(1.0, 1.0)));
}

TEST(KeyframeSelector, RefusesAConfigurationThatMakesNoSense) {
  EXPECT_THROW(KeyframeSelector(KeyframeConfig{-0.1, 5.0}), std::invalid_argument);
  EXPECT_THROW(KeyframeSelector(KeyframeConfig{0.1, 181.0}), std::invalid_argument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ((KeyframeConfig{nan, nan}.validate().size()), 2U);
}

}  // namespace
}  // namespace geomap::perception
