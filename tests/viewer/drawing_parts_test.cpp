// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "viewer/drawing_scene.hpp"
#include "viewer/map_level.hpp"
#include "viewer/path_lines.hpp"
#include "viewer/plane_deviation.hpp"
#include "viewer/point_share.hpp"
#include "viewer/view_camera.hpp"

namespace geomap::viewer {
namespace {

using ::testing::ElementsAre;

std::size_t sum(const std::vector<std::size_t>& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

TEST(PointShare, WithEnoughBudgetEveryPointIsTaken) {
  const std::vector<PointClaim> claims = {{100, 1.0}, {50, 0.01}, {0, 1.0}};
  EXPECT_THAT(share_points(claims, 150), ElementsAre(100, 50, 0));
}

TEST(PointShare, ABlockOfTwiceTheWeightGetsTwiceTheShare) {
  const std::vector<PointClaim> claims = {{1000, 2.0}, {1000, 1.0}};
  const auto counts = share_points(claims, 300);
  EXPECT_NEAR(static_cast<double>(counts[0]), 200.0, 2.0);
  EXPECT_NEAR(static_cast<double>(counts[1]), 100.0, 2.0);
}

TEST(PointShare, WhatAFullBlockDoesNotNeedGoesToTheOthers) {
  const std::vector<PointClaim> claims = {{10, 100.0}, {1000, 1.0}, {1000, 1.0}};
  const auto counts = share_points(claims, 500);
  EXPECT_EQ(counts[0], 10U);
  EXPECT_LE(sum(counts), 500U);
  EXPECT_GE(sum(counts), 495U);
}

TEST(PointShare, NoBudgetAndNoBlocksAreNoPoints) {
  EXPECT_TRUE(share_points({}, 100).empty());
  const std::vector<PointClaim> claims = {{10, 1e-8}, {1000, 1.0}};
  EXPECT_EQ(sum(share_points(claims, 0)), 0U);
}

TEST(PointShare, WhatProjectsIntoThePictureIsNeverCulled) {
  for (const ViewCamera& camera :
       {testing::oblique_view(), testing::top_view(), testing::near_view()}) {
    int outside = 0;
    for (const auto& [key, block] : testing::drawing_scene().points.blocks) {
      const bool may = may_be_seen(camera.view_projection(), block.box);
      outside += may ? 0 : 1;
      for (const ScenePoint& point : *block.points) {
        const auto pixel = camera.project(point.position.cast<double>());
        const bool is_inside = pixel && pixel->x() >= 0.0 && pixel->y() >= 0.0 &&
                               pixel->x() <= camera.width() && pixel->y() <= camera.height();
        ASSERT_TRUE(may || !is_inside);
      }
    }
    EXPECT_EQ(outside > 0, camera.viewpoint() == testing::near_view().viewpoint());
  }
}

TEST(PlaneDeviation, IsTheDistanceFromTheSurfaceItLiesOn) {
  const SceneModel scene = testing::drawing_scene();
  const auto& planes = scene.planes.planes;  // wall, floor, and one that the map has not
  const auto wall = distance_from_map(planes[0], scene.map.features);
  const auto floor = distance_from_map(planes[1], scene.map.features);
  ASSERT_TRUE(wall && floor);
  EXPECT_NEAR(*wall, 0.04, 1e-4);
  EXPECT_NEAR(*floor, 0.01, 1e-4);
  EXPECT_FALSE(distance_from_map(planes[2], scene.map.features));
}

TEST(PlaneDeviation, ASurfaceThatFacesTheOtherWayIsNotTheSame) {
  const SceneModel scene = testing::drawing_scene();
  geometry::PlanarPolygon turned = scene.planes.planes[1];
  turned.frame.normal = -turned.frame.normal;
  turned.plane = turned.frame.plane();
  EXPECT_FALSE(distance_from_map(turned, scene.map.features));
}

TEST(PlaneDeviation, APlaneThatIsVeryFarAwayOrNowhereIsNotInTheMap) {
  const SceneModel scene = testing::drawing_scene();
  for (const double value : {2e5, -1e300, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()}) {
    geometry::PlanarPolygon far = scene.planes.planes[1];
    far.frame.origin.x() = value;
    EXPECT_FALSE(distance_from_map(far, scene.map.features)) << value;
  }
}

TEST(MapLevel, IsZeroForAMapThatStandsThere) {
  EXPECT_EQ(lowest_level({}), 0.0);
  EXPECT_EQ(lowest_level(testing::drawing_scene().map.features), 0.0);
  EXPECT_EQ(lowest_level(testing::drawing_scene({0.0, 0.0, -0.25}).map.features), 0.0);
}

TEST(MapLevel, IsTheFloorOfAMapWhoseOriginIsAtEyeHeight) {
  Features features = testing::drawing_scene({0.0, 0.0, -1.553}).map.features;
  EXPECT_NEAR(lowest_level(features), -1.55, 1e-9);
  features.erase(testing::drawn_id(testing::kFloor));
  EXPECT_NEAR(lowest_level(features), -0.80, 1e-9);  // the table
  features.erase(testing::drawn_id(testing::kTable));
  EXPECT_NEAR(lowest_level(features), -1.55, 1e-9);  // where the walls end
}

// A walk of so many steps of 5 cm, on a circle.
std::vector<TrackLayer::Pose> walk(int steps) {
  std::vector<TrackLayer::Pose> poses;
  for (int i = 0; i <= steps; ++i) {
    TrackLayer::Pose pose{.utime = i + 1};
    pose.T_world_camera.translation() =
        10.0 * Eigen::Vector3d(std::cos(0.005 * i), std::sin(0.005 * i), 0.1);
    poses.push_back(pose);
  }
  return poses;
}

TEST(PathLines, ANewPoseAddsOnePieceAndChangesNoOther) {
  PathLines path;
  auto poses = walk(10);
  EXPECT_EQ(path.follow(poses), 0U);
  EXPECT_EQ(path.lines().size(), 20U);
  const std::vector<Vertex> before = path.lines();
  EXPECT_EQ(path.follow(poses), 20U);
  poses = walk(11);
  EXPECT_EQ(path.follow(poses), 20U);
  EXPECT_EQ(path.lines().size(), 22U);
  EXPECT_TRUE(std::equal(before.begin(), before.end(), path.lines().begin()));
}

TEST(PathLines, APathThatHasChangedIsMadeAnew) {
  PathLines path;
  auto poses = walk(10);
  path.follow(poses);
  poses.pop_back();
  poses.back().utime += 5;
  EXPECT_EQ(path.follow(poses), 0U);
  EXPECT_EQ(path.lines().size(), 18U);
  EXPECT_EQ(path.follow({}), 0U);
  EXPECT_TRUE(path.lines().empty());
}

TEST(PathLines, AVeryLongPathHasFewPiecesAndEndsWhereTheRobotIs) {
  PathLines path;
  const auto poses = walk(100'000);
  path.follow(poses);
  EXPECT_LE(path.lines().size(), 2 * PathLines::kMostPieces);
  EXPECT_GT(path.lines().size(), PathLines::kMostPieces / 2);
  const Eigen::Vector3d end = path.origin() + path.lines().back().position.cast<double>();
  EXPECT_LT((end - poses.back().T_world_camera.translation()).norm(), path.step() + 0.001);
  EXPECT_LT(path.step(), 1.0);
}

TEST(PathLines, APoseThatIsNowhereIsLeftOut) {
  PathLines path;
  auto poses = walk(10);
  poses[0].T_world_camera.translation().x() = std::numeric_limits<double>::quiet_NaN();
  poses[4].T_world_camera.translation().y() = std::numeric_limits<double>::infinity();
  path.follow(poses);
  EXPECT_EQ(path.lines().size(), 16U);
}

}  // namespace
}  // namespace geomap::viewer
