// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "viewer/drawing_scene.hpp"
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

}  // namespace
}  // namespace geomap::viewer
