// SPDX-License-Identifier: BSD-3-Clause
#include "logs/map_evaluation.hpp"

#include <cmath>

#include "logs/drawn_truth.hpp"
#include "mapping/example_map.hpp"

namespace geomap::logs {
namespace {

using drivers::Truth;
using Eigen::Vector3d;
using geometry::PlaneFrame;
using mapping::MapFeature;
using testing::draw_feature;
using testing::draw_truth;
using testing::DrawnRectangle;
using testing::raised;
using testing::tilted;

constexpr double kExact = 1e-9;
constexpr double kGrid = 2e-4;  // areas of rectangles on the 0.1 mm grid

const PlaneFrame kTable = {{3, 0, 1}, Vector3d::UnitX(), Vector3d::UnitZ()};
const PlaneFrame kWallFrame = {{0, 4, 1}, Vector3d::UnitX(), -Vector3d::UnitY()};
const PlaneFrame kRamp = {
    {-2, -1, 0.5}, Vector3d(0.6, 0.8, 0), Vector3d(-0.8, 0.6, 1).normalized()};
constexpr DrawnRectangle kWhole = {-1, -0.5, 1, 0.5};  // 2 m²

Truth table() { return {{draw_truth("table", kTable, kWhole, {kWhole})}}; }

Truth room() {
  return {{draw_truth("table", kTable, kWhole, {kWhole}),
           draw_truth("wall", kWallFrame, {-3, -1, 3, 1}, {{-2, -1, 2, 1}}),
           draw_truth("ramp", kRamp, kWhole, {kWhole})}};
}

std::vector<MapFeature> map_of_room() {
  return {draw_feature(1, kTable, {kWhole}), draw_feature(2, kWallFrame, {{-2, -1, 2, 1}}),
          draw_feature(3, kRamp, {kWhole})};
}

MapEvaluation evaluate(const std::vector<MapFeature>& map, const Truth& truth = table()) {
  return evaluate_map(map, truth);
}

TEST(MapEvaluation, APerfectMapHasNoErrors) {
  const MapEvaluation result = evaluate(map_of_room(), room());
  ASSERT_TRUE(result.errors && result.hull_distance && result.false_features);
  EXPECT_LT(result.errors->coeff, kExact);
  EXPECT_LT(result.errors->angle, kExact);
  EXPECT_LT(result.errors->dist, kExact);
  EXPECT_LT(result.errors->dist_local, kExact);
  EXPECT_LT(result.errors->rms_p, kExact);
  EXPECT_EQ(result.recall, 1.0);
  EXPECT_EQ(result.precision, 1.0);
  EXPECT_EQ(result.features_per_component, 1.0);
  EXPECT_NEAR(*result.area_iou, 1.0, kGrid);
  EXPECT_LT(result.hull_distance->max, kGrid);
  EXPECT_EQ(result.hull_distance->vertices, 12U);
  EXPECT_TRUE(result.false_features->empty());
  ASSERT_EQ(result.planes.size(), 3U);
  for (const SurfaceEvaluation& plane : result.planes) {
    EXPECT_EQ(plane.features, 1U) << plane.name;
    EXPECT_NEAR(*plane.area_iou(), 1.0, kGrid) << plane.name;
  }
  EXPECT_NEAR(*result.planes[1].area, 12.0, 1e-3);
  EXPECT_NEAR(*result.planes[1].visible_area, 8.0, 1e-3);
  EXPECT_NEAR(result.planes[1].map_area, 8.0, 1e-3);
}

TEST(MapEvaluation, APlaneTiltedAboutItsCentroidIsWrongAtTheOriginAndRightThere) {
  const double angle = 0.1;
  const MapEvaluation result = evaluate({draw_feature(1, tilted(kTable, angle), {kWhole})});
  ASSERT_TRUE(result.errors);
  // The normal is (sin, 0, cos); the centroid is (3, 0, 1), d was -1.
  const double dist = std::abs(1.0 - 3.0 * std::sin(angle) - std::cos(angle));
  EXPECT_NEAR(result.errors->angle, angle, kExact);
  EXPECT_NEAR(result.errors->dist, dist, kExact);
  EXPECT_NEAR(result.errors->coeff, std::hypot(2.0 * std::sin(angle / 2.0), dist), kExact);
  EXPECT_LT(result.errors->dist_local, 1e-5);
  EXPECT_NEAR(result.errors->rms_p, std::sin(angle), kExact);  // every vertex is 1 m from the axis
  EXPECT_NEAR(*result.area_iou, std::cos(angle), kGrid);
}

TEST(MapEvaluation, APlaneShiftedAlongItsNormalIsWrongByThatEverywhere) {
  for (const double height : {0.02, -0.02}) {
    const MapEvaluation result = evaluate({draw_feature(1, raised(kTable, height), {kWhole})});
    ASSERT_TRUE(result.errors);
    EXPECT_NEAR(result.errors->coeff, 0.02, kExact);
    EXPECT_NEAR(result.errors->dist, 0.02, kExact);
    EXPECT_NEAR(result.errors->dist_local, 0.02, kExact);
    EXPECT_NEAR(result.errors->rms_p, 0.02, kExact);
    EXPECT_LT(result.errors->angle, kExact);
  }
}

TEST(MapEvaluation, RmsCountsTheVerticesOfAllRings) {
  // Tilted about its middle: outer vertices 1 m from the axis, those of the opening 0.5 m.
  MapFeature feature = draw_feature(1, tilted(kTable, 0.1), {kWhole});
  feature.surface.polygon.parts[0].holes.push_back(
      testing::reversed(testing::rectangle_ring(-0.5, -0.25, 0.5, 0.25)));
  EXPECT_NEAR(evaluate({feature}).errors->rms_p, std::sin(0.1) * std::sqrt((1.0 + 0.25) / 2.0),
              kExact);
}

TEST(MapEvaluation, OnlyTheLocalDistanceIsTheSameWhereverTheWorldsOriginIs) {
  const Eigen::Vector3d away(900, -400, 30);
  PlaneErrors errors[2];
  for (const int moved : {0, 1}) {
    PlaneFrame frame = kTable;
    frame.origin += moved * away;
    const PlaneFrame mapped = raised(tilted(frame, 0.02), 0.01);
    const MapEvaluation result = evaluate({draw_feature(1, mapped, {{-1, -0.5, 0.6, 0.5}})},
                                          {{draw_truth("table", frame, kWhole, {kWhole})}});
    ASSERT_TRUE(result.errors);
    errors[moved] = *result.errors;
  }
  EXPECT_GT(errors[0].dist_local, 0.005);
  EXPECT_NEAR(errors[0].dist_local, errors[1].dist_local, 1e-6);
  EXPECT_NEAR(errors[0].angle, errors[1].angle, kExact);
  EXPECT_NEAR(errors[0].rms_p, errors[1].rms_p, kExact);
  EXPECT_GT(errors[1].dist, 15.0);
  EXPECT_LT(errors[0].dist, 0.1);
}

TEST(MapEvaluation, ASurfaceInTwoFeaturesIsFoundButNotWhole) {
  const MapEvaluation result = evaluate({draw_feature(1, kTable, {{-1, -0.5, 0, 0.5}}),
                                         draw_feature(2, kTable, {{-0.1, -0.5, 1, 0.5}})});
  EXPECT_EQ(result.features_per_component, 2.0);
  EXPECT_EQ(result.recall, 1.0);
  EXPECT_EQ(result.precision, 1.0);
  EXPECT_NEAR(*result.area_iou, 1.0, kGrid);
  EXPECT_NEAR(result.planes[0].map_area, 2.0, 1e-3);
}

TEST(MapEvaluation, MeansAreOverFeaturesNotOverSurfaces) {
  std::vector<MapFeature> map = map_of_room();
  map[2] = draw_feature(3, raised(kRamp, 0.04), {kWhole});
  map.push_back(draw_feature(4, kTable, {{-1, -0.5, 0, 0.5}}));
  const MapEvaluation result = evaluate(map, room());
  EXPECT_NEAR(result.errors->dist_local, 0.01, kExact);
  EXPECT_NEAR(result.planes[2].errors->dist_local, 0.04, kExact);
  EXPECT_LT(result.planes[0].errors->dist_local, kExact);
}

TEST(MapEvaluation, AMissingSurfaceCostsRecallAndArea) {
  std::vector<MapFeature> map = map_of_room();
  map.erase(map.begin() + 1);
  const MapEvaluation result = evaluate(map, room());
  EXPECT_NEAR(*result.recall, 2.0 / 3.0, kExact);
  EXPECT_EQ(result.precision, 1.0);
  EXPECT_NEAR(*result.area_iou, 4.0 / 12.0, kGrid);
  EXPECT_FALSE(result.planes[1].errors);
  EXPECT_EQ(result.planes[1].area_iou(), 0.0);
  EXPECT_NEAR(*result.features_per_component, 2.0 / 3.0, kExact);
}

TEST(MapEvaluation, AFeatureWhereNothingIsIsFalse) {
  std::vector<MapFeature> map = map_of_room();
  map.push_back(draw_feature(9, raised(kTable, 0.5), {{3, 3, 4, 3.5}}));
  const MapEvaluation result = evaluate(map, room());
  EXPECT_NEAR(*result.precision, 0.75, kExact);
  ASSERT_EQ(result.false_features->size(), 1U);
  EXPECT_EQ(result.false_features->at(0).id, (mapping::FeatureId{9, 0}));
  EXPECT_NEAR(result.false_features->at(0).area, 0.5, kExact);
  EXPECT_EQ(result.features_counted, 4U);
  EXPECT_EQ(result.features_associated, 3U);
  EXPECT_LT(result.errors->dist_local, kExact);
}

TEST(MapEvaluation, TheOtherSideIsAnotherSurface) {
  const PlaneFrame below = {kTable.origin, kTable.x_axis, -kTable.normal};
  const MapEvaluation result = evaluate({draw_feature(1, below, {kWhole})});
  EXPECT_EQ(result.recall, 0.0);
  EXPECT_EQ(result.precision, 0.0);
  EXPECT_FALSE(result.errors);
  EXPECT_FALSE(result.hull_distance);
}

TEST(MapEvaluation, BeyondTwentyFiveDegreesAFeatureIsFalse) {
  EXPECT_EQ(evaluate({draw_feature(1, tilted(kTable, 0.43), {kWhole})}).recall, 1.0);
  EXPECT_EQ(evaluate({draw_feature(1, tilted(kTable, 0.44), {kWhole})}).recall, 0.0);
}

TEST(MapEvaluation, HalfOfAFeatureMustLieOnTheSurface) {
  EXPECT_EQ(evaluate({draw_feature(1, kTable, {{0, -0.5, 1.98, 0.5}})}).recall, 1.0);
  EXPECT_EQ(evaluate({draw_feature(1, kTable, {{0, -0.5, 2.02, 0.5}})}).recall, 0.0);
}

TEST(MapEvaluation, OfTwoSurfacesTheNearerOneIsMeant) {
  const Truth boards = {{draw_truth("lower", kTable, kWhole, {kWhole}),
                         draw_truth("upper", raised(kTable, 0.05), kWhole, {kWhole})}};
  for (const std::size_t nearer : {0U, 1U}) {
    const double height = nearer == 0 ? 0.02 : 0.03;
    const MapEvaluation result =
        evaluate({draw_feature(1, raised(kTable, height), {kWhole})}, boards);
    EXPECT_EQ(result.planes[nearer].features, 1U);
    EXPECT_EQ(result.planes[1 - nearer].features, 0U);
    EXPECT_NEAR(result.errors->dist_local, 0.02, kExact);
  }
}

TEST(MapEvaluation, OpeningsBelongToTheOutline) {
  const DrawnRectangle door = {-0.5, -0.25, 0.5, 0.25};  // 0.5 of 2 m²
  const Truth wall = {{draw_truth("wall", kWallFrame, kWhole, {kWhole}, {door})}};
  MapFeature feature = draw_feature(1, kWallFrame, {kWhole});
  const MapEvaluation closed = evaluate({feature}, wall);
  EXPECT_NEAR(*closed.area_iou, 0.75, kGrid);
  EXPECT_NEAR(*closed.planes[0].visible_area, 1.5, 1e-3);
  feature.surface.polygon.parts[0].holes.push_back(
      testing::reversed(testing::rectangle_ring(-0.5, -0.25, 0.5, 0.25)));
  EXPECT_NEAR(*evaluate({feature}, wall).area_iou, 1.0, kGrid);
}

TEST(MapEvaluation, AreaBeyondWhatWasVisibleCountsAgainstTheMap) {
  const Truth half = {{draw_truth("table", kTable, kWhole, {{-1, -0.5, 0, 0.5}})}};
  const MapEvaluation result = evaluate({draw_feature(1, kTable, {kWhole})}, half);
  EXPECT_NEAR(*result.area_iou, 0.5, kGrid);
  EXPECT_EQ(result.precision, 1.0);
}

TEST(MapEvaluation, VisiblePartsWithinTheGapAreOneComponent) {
  const auto components = [](double gap) {
    const Truth truth = {
        {draw_truth("table", kTable, kWhole, {{-1, -0.5, 0, 0.5}, {gap, -0.5, 1, 0.5}})}};
    return evaluate({draw_feature(1, kTable, {kWhole})}, truth).planes[0].components;
  };
  EXPECT_EQ(components(0.01), 1U);
  EXPECT_EQ(components(0.05), 2U);
}

TEST(MapEvaluation, PartsTooSmallToBeMappedAreNotAskedFor) {
  const Truth truth = {
      {draw_truth("table", kTable, kWhole, {{-1, -0.5, 0, 0.5}, {0.5, 0, 0.6, 0.19}}),
       draw_truth("wall", kWallFrame, kWhole, {{0, 0, 0.1, 0.19}})}};
  const MapEvaluation result = evaluate({draw_feature(1, kTable, {{-1, -0.5, 0, 0.5}})}, truth);
  EXPECT_EQ(result.planes[0].components, 1U);
  EXPECT_EQ(result.planes[1].components, 0U);
  EXPECT_EQ(result.recall, 1.0);
  EXPECT_EQ(result.features_per_component, 1.0);
}

TEST(MapEvaluation, TinyFeaturesAreIgnored) {
  const MapEvaluation result = evaluate({draw_feature(1, kTable, {{0, 0, 0.1, 0.19}}),
                                         draw_feature(2, kWallFrame, {{0, 0, 0.1, 0.19}})});
  EXPECT_EQ(result.features_counted, 0U);
  EXPECT_EQ(result.recall, 0.0);
  EXPECT_FALSE(result.precision);
}

TEST(MapEvaluation, WhatNobodyCouldSeeIsNotAskedFor) {
  Truth truth = table();
  truth.planes.push_back(draw_truth("ramp", kRamp, kWhole, {}));
  const MapEvaluation result =
      evaluate({draw_feature(1, kTable, {kWhole}), draw_feature(2, kRamp, {kWhole})}, truth);
  EXPECT_EQ(result.recall, 1.0);
  EXPECT_NEAR(*result.area_iou, 1.0, kGrid);
  EXPECT_EQ(result.precision, 0.5);
  EXPECT_FALSE(result.planes[1].seen);
}

TEST(MapEvaluation, VerticesAreMeasuredToTheNearestBorder) {
  // 5 cm inside on three sides, 20 cm on the right one; holes are borders too.
  const DrawnRectangle door = {0.5, 0.3, 0.7, 0.4};
  const Truth truth = {{draw_truth("table", kTable, kWhole, {kWhole}, {door})}};
  const MapEvaluation result =
      evaluate({draw_feature(1, kTable, {{-0.95, -0.45, 0.8, 0.4}})}, truth);
  ASSERT_TRUE(result.hull_distance);
  EXPECT_EQ(result.hull_distance->vertices, 4U);
  // Left: 5 cm each; bottom right 5 cm; top right 10 cm, from the opening and from the edge.
  EXPECT_NEAR(result.hull_distance->max, 0.10, kGrid);
  EXPECT_NEAR(result.hull_distance->mean, (0.05 + 0.05 + 0.05 + 0.10) / 4.0, kGrid);
}

TEST(MapEvaluation, AReferenceWithoutOutlineIsFoundAtItsCentroid) {
  drivers::TruthPlane floor;
  floor.name = "floor";
  floor.plane = kTable.plane();
  floor.seen = true;
  floor.centroid = kTable.origin + Vector3d(0.2, 0.1, 0.004);
  const Truth truth = {{floor}};
  const auto recall = [&](const PlaneFrame& frame, const DrawnRectangle& part) {
    return evaluate({draw_feature(1, frame, {part})}, truth).recall;
  };
  EXPECT_EQ(recall(kTable, kWhole), 1.0);
  EXPECT_EQ(recall(kTable, {0.34, -0.5, 1, 0.5}), 1.0);
  EXPECT_EQ(recall(kTable, {0.36, -0.5, 1, 0.5}), 0.0);
  EXPECT_EQ(recall(raised(kTable, 0.15), kWhole), 1.0);
  EXPECT_EQ(recall(raised(kTable, 0.16), kWhole), 0.0);
  EXPECT_EQ(recall(tilted(kTable, 0.44), kWhole), 0.0);

  const MapEvaluation result = evaluate(
      {draw_feature(1, raised(kTable, 0.01), {kWhole}), draw_feature(2, kWallFrame, {kWhole})},
      truth);
  EXPECT_NEAR(result.errors->dist_local, 0.01, kExact);
  EXPECT_NEAR(result.planes[0].map_area, 2.0, kExact);
  EXPECT_FALSE(result.precision || result.false_features || result.area_iou);
  EXPECT_FALSE(result.features_per_component || result.hull_distance);
  EXPECT_FALSE(result.planes[0].components || result.planes[0].area);
}

TEST(MapEvaluation, TwoMapsAreComparedTheSameWay) {
  const std::vector<MapFeature> other = {
      draw_feature(5, kTable, {{-1, -0.5, 0, 0.5}, {0.2, -0.5, 1, 0.5}}),
      draw_feature(4, kRamp, {kWhole}), draw_feature(6, kWallFrame, {{0, 0, 0.1, 0.1}})};
  const std::vector<MapFeature> map = {draw_feature(1, raised(kTable, 0.02), {kWhole})};
  const MapEvaluation result = evaluate_map(map, reference_surfaces(other));
  EXPECT_EQ(result.recall, 0.5);  // the third is too small to count
  EXPECT_EQ(result.precision, 1.0);
  EXPECT_NEAR(result.errors->dist_local, 0.02, kExact);
  EXPECT_EQ(result.planes[0].name, "4-0");
  EXPECT_EQ(result.planes[1].components, 2U);
  EXPECT_NEAR(*result.planes[1].area_iou(), 0.9, kGrid);
  EXPECT_NEAR(*result.features_per_component, 1.0 / 3.0, kExact);

  const MapEvaluation same = evaluate_map(other, reference_surfaces(other));
  EXPECT_EQ(same.recall, 1.0);
  EXPECT_NEAR(*same.area_iou, 1.0, kGrid);
  EXPECT_LT(same.errors->coeff, kExact);
}

TEST(MapEvaluation, NothingAgainstNothingMeasuresNothing) {
  const MapEvaluation result = evaluate({}, {});
  EXPECT_FALSE(result.recall || result.precision || result.errors || result.area_iou);
  EXPECT_FALSE(evaluate({}).errors);
  EXPECT_EQ(evaluate({}).recall, 0.0);
}

TEST(MapEvaluation, AMapAtTheOtherEndOfTheWorldIsJustWrong) {
  PlaneFrame far = kTable;
  far.origin += Vector3d(9e5, 0, 0);
  const MapEvaluation result = evaluate({draw_feature(1, far, {kWhole})});
  EXPECT_EQ(result.recall, 0.0);
  EXPECT_EQ(result.false_features->size(), 1U);
}

}  // namespace
}  // namespace geomap::logs
