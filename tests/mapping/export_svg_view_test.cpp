// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/export_svg_view.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mapping/example_map.hpp"
#include "mapping/export_svg_label.hpp"

namespace geomap::mapping {
namespace {

using geomap::testing::crowd;
using geomap::testing::example_map;
using geomap::testing::make_feature;
using geomap::testing::rectangle_ring;

TEST(SvgView, TheFrontViewFacesTheLargestUprightFeature) {
  MapSnapshot map = example_map();
  EXPECT_NEAR(front_heading(map.features), std::numbers::pi / 2.0, 1e-12);
  map.features.push_back(make_feature(
      {.id = {9000, 0}, .origin = {-3, 0, 1}, .normal = {1, 0, 0}, .x_axis = {0, 1, 0}},
      {{{rectangle_ring(-3, -1, 3, 1), {}}}}));
  EXPECT_NEAR(std::abs(front_heading(map.features)), std::numbers::pi, 1e-12);
  EXPECT_NEAR(front_heading({}), std::numbers::pi / 2.0, 1e-12);
}

TEST(SvgView, TheTopViewHasXRightAndYUpWhenTheFrontLooksAlongY) {
  const ViewAxes axes = view_axes(SvgView::kTop, std::numbers::pi / 2.0, 0.5);
  EXPECT_LT((axes.right - Eigen::Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((axes.up - Eigen::Vector3d::UnitY()).norm(), 1e-12);
  EXPECT_LT((axes.forward + Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(SvgView, AxesAreRightHandedUnitVectors) {
  for (const SvgView view : {SvgView::kTop, SvgView::kFront, SvgView::kOblique}) {
    const ViewAxes axes = view_axes(view, 0.7, -0.4);
    EXPECT_LT((axes.right.cross(axes.forward) - axes.up).norm(), 1e-12);
    EXPECT_NEAR(axes.right.norm() * axes.up.norm() * axes.forward.norm(), 1.0, 1e-12);
  }
}

TEST(SvgView, TheObliqueViewTurnsToTheSideThatShowsMore) {
  const double ahead = std::numbers::pi / 2.0;
  const auto wall = [](double nx) {
    return make_feature({.id = {1, 0}, .normal = {nx, 0, 0}, .x_axis = {0, 1, 0}},
                        {{{rectangle_ring(-1, -1, 1, 1), {}}}});
  };
  const MapFeature on_the_left = wall(1.0);
  const MapFeature on_the_right = wall(-1.0);
  EXPECT_GT(oblique_turn({&on_the_left, 1}, ahead), 0.0);
  EXPECT_LT(oblique_turn({&on_the_right, 1}, ahead), 0.0);
}

std::vector<std::int64_t> painted_ids(const MapSnapshot& map, const ViewAxes& axes) {
  const auto projected = project_features(map.features, axes);
  std::vector<std::int64_t> ids;
  for (const std::size_t i : paint_order(projected)) {
    ids.push_back(projected[i].feature->id.keyframe);
  }
  return ids;
}

TEST(SvgView, ASmallTableIsPaintedOverTheFloorThoughTheFloorsMiddleIsNearer) {
  MapSnapshot map;
  // Far at the back of a long floor: its depth alone would put it behind.
  map.features.push_back(make_feature({.id = {1, 0}, .origin = {0, 4, 0.7}},
                                      {{{rectangle_ring(-0.5, -0.5, 0.5, 0.5), {}}}}));
  map.features.push_back(make_feature({.id = {2, 0}}, {{{rectangle_ring(-2, -5, 2, 5), {}}}}));
  const ViewAxes axes = view_axes(SvgView::kOblique, std::numbers::pi / 2.0, 0.0);
  EXPECT_THAT(painted_ids(map, axes), ::testing::ElementsAre(2, 1));
}

TEST(SvgView, EveryFeatureOfATangleIsPaintedOnce) {
  const MapSnapshot tangle = crowd(300);  // full of features that cover each other in circles
  const ViewAxes axes = view_axes(SvgView::kTop, 0.0, 0.0);
  std::vector<std::int64_t> ids = painted_ids(tangle, axes);
  std::sort(ids.begin(), ids.end());
  for (std::size_t i = 0; i < 300; ++i) EXPECT_EQ(ids.at(i), static_cast<std::int64_t>(i));
}

TEST(SvgView, HorizontalFeaturesArePaintedFromTheLowestUpInTheTopView) {
  MapSnapshot map;
  for (const int height : {3, 0, 4, 1, 2}) {
    map.features.push_back(make_feature({.id = {height, 0}, .origin = {0.0, 0.0, 0.2 * height}},
                                        {{{rectangle_ring(-1, -1, 1, 1), {}}}}));
  }
  const ViewAxes axes = view_axes(SvgView::kTop, 0.0, 0.0);
  EXPECT_THAT(painted_ids(map, axes), ::testing::ElementsAre(0, 1, 2, 3, 4));
}

TEST(SvgLabel, SpotsOfARingShapedAreaLieOnItAndNotInItsHole) {
  const PictureRings frame = {{{0, 0}, {100, 0}, {100, 80}, {0, 80}},
                              {{20, 20}, {20, 60}, {70, 60}, {70, 20}}};
  const std::vector<LabelSpot> spots = label_spots(frame);
  ASSERT_FALSE(spots.empty());
  // The right-hand bar, 30 wide, is the roomiest; a corner's bisector gives a little more.
  EXPECT_GT(spots.front().clearance, 14.0);
  for (const LabelSpot& spot : spots) {
    const bool in_hole =
        spot.point.x() > 20 && spot.point.x() < 70 && spot.point.y() > 20 && spot.point.y() < 60;
    EXPECT_FALSE(in_hole);
    EXPECT_NEAR(spot.clearance, clearance(frame, spot.point), 1e-12);
  }
}

TEST(SvgLabel, AmpleRoomPrefersTheMiddleToTheRoomiestPlace) {
  const PictureRings wedge = {{{0, 100}, {900, 0}, {900, 400}, {0, 300}}};
  EXPECT_LT((label_spots(wedge).front().point - Eigen::Vector2d(450, 200)).norm(), 60.0);
}

TEST(SvgLabel, ALineOffersNoSpot) {
  EXPECT_TRUE(label_spots({{{0, 0}, {50, 0}, {100, 0}}}).empty());
  EXPECT_TRUE(label_spots({}).empty());
}

}  // namespace
}  // namespace geomap::mapping
