// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/depth_correction.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "distorted_views.hpp"
#include "perception/point_map.hpp"

namespace geomap::perception {
namespace {

using Eigen::Isometry3d;
using geometry::CameraModel;
using geometry::RgbdFrame;
using Terms = geometry::DepthCorrection::Terms;

TEST(DepthCorrection, ItsTermsAreTheMonomialsOfDegreeOneToFour) {
  constexpr double kX = 0.55, kY = 0.41;  // of the ray at the border, see depth_correction.cpp
  for (const auto& [x, y] : {std::pair{1.0, 1.0}, std::pair{0.7, -0.4}, std::pair{-0.3, 0.9}}) {
    const Terms terms = geometry::DepthCorrection::terms(kX * x, kY * y);
    int k = 0;
    for (int degree = 1; degree <= 4; ++degree) {
      for (int of_y = 0; of_y <= degree; ++of_y, ++k) {
        EXPECT_NEAR(terms(k), std::pow(x, degree - of_y) * std::pow(y, of_y), 1e-12) << k;
      }
    }
    EXPECT_EQ(k, geometry::DepthCorrection::kTerms);
  }
}

TEST(DepthCorrection, ItsShareIsTheSumOfTheTermsAndZeroInTheMiddle) {
  Terms coefficients;
  for (int k = 0; k < geometry::DepthCorrection::kTerms; ++k) coefficients(k) = 0.001 * (k + 1);
  const geometry::DepthCorrection correction(coefficients);
  EXPECT_EQ(correction.share(0.0, 0.0), 0.0);
  EXPECT_NEAR(correction.share(0.55, 0.41), 0.001 * 105.0, 1e-12);  // all terms are 1
  EXPECT_NEAR(correction.share(0.55, 0.0), 0.001 * (1 + 3 + 6 + 10), 1e-12);
  EXPECT_FALSE(correction.is_none());
  EXPECT_TRUE(geometry::DepthCorrection().is_none());
}

TEST(DepthCorrection, TheLargestDifferenceIsThatOverTheImage) {
  const CameraModel camera = testing::kinect_camera();
  Terms slope = Terms::Zero();
  slope(0) = 0.003;
  const double border = 320.0 / 585.0 / 0.55;  // x of the first column
  EXPECT_NEAR(
      geometry::DepthCorrection::largest_difference(geometry::DepthCorrection(slope), {}, camera),
      0.003 * border, 1e-9);
  EXPECT_EQ(geometry::DepthCorrection::largest_difference(bowl(), bowl(), camera), 0.0);
}

TEST(DepthCorrection, CorrectsEachReadingByItsShare) {
  const auto rendering = testing::render(testing::small_room(), testing::kinect_camera(7),
                                         poses_around_the_room().front());
  const RgbdFrame frame = corrected(distorted(rendering, bowl()), bowl());
  int readings = 0;
  for (std::size_t i = 0; i < rendering.depth.size(); ++i) {
    if (rendering.depth[i] == 0.0) continue;
    ++readings;
    EXPECT_NEAR(frame.depth.millimetres[i], 1e3 * rendering.depth[i], 1.02);  // rounded twice
  }
  EXPECT_GT(readings, 4000);
}

TEST(DepthCorrection, LeavesPixelsWithoutAReadingAndWhatWouldLeaveTheRange) {
  Terms slope = Terms::Zero();
  slope(0) = 0.5;
  RgbdFrame frame;
  frame.depth_camera = {5, 1, 2.0, 2.0, 2.0, 0.0};  // s: -0.9, -0.5, 0, 0.5, 0.9
  frame.depth = {5, 1, {0xffff, 1000, 0, 0xffff, 65000}};
  const RgbdFrame better = corrected(frame, geometry::DepthCorrection(slope));
  EXPECT_THAT(better.depth.millimetres, ::testing::ElementsAre(0xffff, 545, 0, 0xffff, 65000));
}

TEST(DepthCorrection, NoneLeavesTheFrameAsItIs) {
  const auto frame = testing::render(testing::small_room(), testing::kinect_camera(7),
                                     poses_around_the_room().front())
                         .frame;
  EXPECT_EQ(corrected(frame, geometry::DepthCorrection()).depth.millimetres,
            frame.depth.millimetres);
}

TEST(DepthCorrection, ThrowsWhereImageAndCameraDisagree) {
  auto frame = testing::render(testing::small_room(), testing::kinect_camera(7),
                               poses_around_the_room().front())
                   .frame;
  frame.depth_camera = testing::kinect_camera(4);
  EXPECT_THROW(corrected(frame, bowl()), std::invalid_argument);
}

TEST(DepthCorrection, ThrowsWhereTheImageLacksReadings) {
  auto frame = testing::render(testing::small_room(), testing::kinect_camera(7),
                               poses_around_the_room().front())
                   .frame;
  frame.depth.millimetres.pop_back();
  EXPECT_THROW(corrected(frame, bowl()), std::invalid_argument);
}

class CorrectedMap : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::vector<Isometry3d> all = poses_around_the_room();
    for (std::size_t i = 0; i < 3; ++i) {
      frames_.push_back(distorted(
          testing::render(testing::small_room(), testing::kinect_camera(4), all[i]), bowl()));
      map_.insert(static_cast<std::int64_t>(i), frames_.back(), all[i]);
    }
  }
  void correct(const geometry::DepthCorrection& correction) {
    map_.set_depth_correction(correction);
    map_.refresh(map_.keyframes(), 0.0);
  }
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  static void expect_same(const PointMap& a, const PointMap& b) {
    const auto points_a = a.points(), points_b = b.points();
    ASSERT_EQ(points_a.size(), points_b.size());
    for (std::size_t i = 0; i < points_a.size(); ++i) {
      ASSERT_EQ(points_a[i].position, points_b[i].position);
      ASSERT_EQ(points_a[i].covariance, points_b[i].covariance);
      ASSERT_EQ(points_a[i].color, points_b[i].color);
    }
  }
  std::vector<RgbdFrame> frames_;
  PointMap map_;
};

TEST_F(CorrectedMap, IsTheMapThatHadTheCorrectionFromTheStart) {
  PointMap from_the_start;
  from_the_start.set_depth_correction(bowl());
  for (std::size_t i = 0; i < 3; ++i) {
    from_the_start.insert(static_cast<std::int64_t>(i), frames_[i], poses_around_the_room()[i]);
  }
  const Eigen::Vector3d before = map_.points().front().position;
  correct(bowl());
  EXPECT_NE(map_.points().front().position, before);
  expect_same(map_, from_the_start);
}

TEST_F(CorrectedMap, IsTheSameAfterTheSameCorrectionAgainAndAfterTakingItBack) {
  const PointMap plain = map_;
  correct(bowl());
  const PointMap once = map_;
  correct(bowl());
  expect_same(map_, once);
  correct({});
  expect_same(map_, plain);
}

TEST_F(CorrectedMap, IsEmptyOnceAllKeyFramesAreRemoved) {
  correct(bowl());
  for (const std::int64_t id : {1, 0, 2}) EXPECT_TRUE(map_.remove(id));
  EXPECT_EQ(map_.size(), 0U);
  EXPECT_TRUE(map_.voxels().blocks().empty());
  EXPECT_EQ(map_.memory_bytes(), 0U);
}

TEST_F(CorrectedMap, ChangesOneKeyFrameAtATimeTheMostOutdatedFirst) {
  const PointMap plain = map_;
  map_.set_depth_correction(bowl());
  expect_same(map_, plain);
  EXPECT_EQ(map_.refresh(1, 0.0), 1U);  // the newest: all are as outdated
  PointMap mixed;
  mixed.set_depth_correction(bowl());
  mixed.insert(2, frames_[2], poses_around_the_room()[2]);
  mixed.set_depth_correction({});
  for (const int i : {0, 1}) mixed.insert(i, frames_[at(i)], poses_around_the_room()[at(i)]);
  expect_same(map_, mixed);
  // Half of the way back: key frame 2 and the others are equally far from it now.
  map_.set_depth_correction(geometry::DepthCorrection(0.4 * bowl().coefficients()));
  EXPECT_EQ(map_.refresh(1, 0.0), 1U);
  mixed.remove(2);
  mixed.set_depth_correction(geometry::DepthCorrection(0.4 * bowl().coefficients()));
  mixed.insert(2, frames_[2], poses_around_the_room()[2]);
  expect_same(map_, mixed);
  EXPECT_EQ(map_.refresh(9, 0.0), 2U);
  EXPECT_EQ(map_.refresh(9, 0.0), 0U);
}

TEST_F(CorrectedMap, LeavesAKeyFrameAsItIsWhereTheChangeIsTooSmall) {
  const double change =
      geometry::DepthCorrection::largest_difference(bowl(), {}, map_.view_of(0)->thin.depth_camera);
  map_.set_depth_correction(bowl());
  EXPECT_EQ(map_.refresh(9, 1.01 * change), 0U);
  EXPECT_EQ(map_.refresh(9, 0.99 * change), 3U);
}

TEST_F(CorrectedMap, OutdatedKeyFramesAreRemovedAndMovedAsTheyAre) {
  map_.set_depth_correction(bowl());
  map_.refresh(1, 0.0);
  const PointMap before = map_;
  const Isometry3d T = poses_around_the_room()[0];
  EXPECT_TRUE(map_.move(0, Eigen::Translation3d(0.5, 0.0, 0.0) * T));
  EXPECT_TRUE(map_.move(0, T));
  expect_same(map_, before);
  for (const std::int64_t id : {1, 0, 2}) EXPECT_TRUE(map_.remove(id));
  EXPECT_EQ(map_.size(), 0U);
  EXPECT_EQ(map_.refresh(9, 0.0), 0U);
  map_.set_depth_correction({});
  EXPECT_TRUE(map_.depth_correction().is_none());
}

}  // namespace
}  // namespace geomap::perception
