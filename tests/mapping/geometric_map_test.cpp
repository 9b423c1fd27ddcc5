// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/geometric_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "mapping/scene.hpp"

namespace geomap::mapping {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using testing::Observer;
using testing::Rectangle;
using ObservationPtr = std::shared_ptr<const Observation>;

using testing::kX, testing::kY, testing::kZ;

Rectangle table_at(double x = 0.0, double y = 0.0) {
  return {"table", {x, y, 0.75}, kX, kY, 0.5, 0.4, {160, 60, 40}, {}};
}

Isometry3d camera_above(double x = 0.3, double y = -1.5) {
  return testing::look_at({x, y, 1.8}, {0.0, 0.0, 0.75});
}

GeometricMap empty_map() { return {MergeConfig{}, HistoryConfig{}}; }

// A scene of many views with errors, so that folding is not trivial.
std::vector<ObservationPtr> noisy_views(int count, std::uint32_t seed = 5) {
  Observer observer(seed);
  observer.angle_noise = 0.01;
  observer.offset_noise = 0.004;
  observer.outline_noise = 0.02;
  const std::vector<Rectangle> room = testing::small_room();
  std::vector<ObservationPtr> views;
  for (int i = 0; i < count; ++i) {
    const double angle = 0.1 * i;
    std::vector<Rectangle> visible;
    for (std::size_t k = 0; k < room.size(); ++k) {
      if ((static_cast<std::size_t>(i) + k) % 3 != 0) visible.push_back(room[k]);
    }
    views.push_back(observer.observe(
        1000 + i, visible,
        testing::look_at({std::sin(angle), -1.5 + 0.3 * std::cos(angle), 1.4}, {0, 1.0, 0.7})));
  }
  return views;
}

using testing::hash_of;

std::string folded_hash(const std::vector<ObservationPtr>& views,
                        const HistoryConfig& history = {}) {
  GeometricMap map(MergeConfig{}, history);
  for (const ObservationPtr& view : views) map.apply(view);
  return hash_of(map);
}

TEST(GeometricMap, OneRectangleSeenAThousandTimesKeepsItsAreaAndOutline) {
  GeometricMap map = empty_map();
  Observer observer;
  observer.angle_noise = 0.01;
  observer.offset_noise = 0.005;
  observer.outline_noise = 0.002;
  for (int i = 0; i < 1000; ++i) {
    map.apply(observer.observe(i + 1, {table_at()}, camera_above(0.001 * i - 0.5)));
  }
  ASSERT_EQ(map.features().size(), 1u);
  const MapFeature& feature = *map.features().begin()->second;
  EXPECT_NEAR(geometry::area(feature.surface.polygon), 0.8, 0.008);
  EXPECT_EQ(feature.observations.size(), 1000u);
  for (const geometry::GridPoint vertex : feature.surface.polygon.parts[0].outer) {
    const Vector3d p = feature.surface.lift(vertex);
    EXPECT_LT(std::abs(p.x()), 0.5 + 0.02);
    EXPECT_LT(std::abs(p.y()), 0.4 + 0.02);
    EXPECT_NEAR(p.z(), 0.75, 0.003);
  }
}

TEST(GeometricMap, TheTwoSidesOfAThinDoorStayTwoPlanes) {
  const Rectangle door{"door", {0, 0, 1}, kX, kZ, 0.4, 1.0, {}, {}};
  GeometricMap map = empty_map();
  Observer observer;
  map.apply(observer.observe(1, {door}, testing::look_at({0, -2, 1}, {0, 0, 1})));
  map.apply(observer.observe(2, {door}, testing::look_at({0, 2, 1}, {0, 0, 1})));
  EXPECT_EQ(map.features().size(), 2u);
}

TEST(GeometricMap, CoplanarPartsMergeOnlyWithinTheGap) {
  Observer observer;
  GeometricMap apart = empty_map(), touching = empty_map();
  apart.apply(observer.observe(1, {table_at(0.0), table_at(1.05)}, camera_above()));
  touching.apply(observer.observe(1, {table_at(0.0), table_at(1.02)}, camera_above()));
  EXPECT_EQ(apart.features().size(), 2u);
  EXPECT_EQ(touching.features().size(), 1u);
}

TEST(GeometricMap, ParallelShelvesAHandApartStayTwo) {
  Observer observer;
  Rectangle lower = table_at(), upper = table_at();
  upper.center.z() += 0.1;
  GeometricMap map = empty_map();
  map.apply(observer.observe(1, {lower, upper}, camera_above()));
  EXPECT_EQ(map.features().size(), 2u);
}

TEST(GeometricMap, ANewPolygonBridgesTwoOldOnesAndTheOldestIdStays) {
  Observer observer;
  GeometricMap map = empty_map();
  map.apply(observer.observe(10, {table_at(-1.2)}, camera_above()));
  map.apply(observer.observe(20, {table_at(1.2)}, camera_above()));
  ASSERT_EQ(map.features().size(), 2u);
  Rectangle wide = table_at();
  wide.half_u = 1.0;
  const ApplyResult result = map.apply(observer.observe(30, {wide}, camera_above()));
  ASSERT_EQ(map.features().size(), 1u);
  EXPECT_EQ(map.features().begin()->first, (FeatureId{10, 0}));
  EXPECT_THAT(result.change.absorbed,
              ::testing::ElementsAre(::testing::Pair(FeatureId{20, 0}, FeatureId{10, 0})));
  EXPECT_THAT(result.change.upserted, ::testing::ElementsAre(FeatureId{10, 0}));
  EXPECT_TRUE(result.change.removed.empty());
}

TEST(GeometricMap, ColourIsAveragedAndNeverAReasonToRefuse) {
  Observer observer;
  Rectangle red = table_at(), blue = table_at();
  red.color = {255, 0, 0};
  blue.color = {0, 0, 255};
  GeometricMap map = empty_map();
  map.apply(observer.observe(1, {red}, camera_above()));
  map.apply(observer.observe(2, {blue}, camera_above()));
  ASSERT_EQ(map.features().size(), 1u);
  const auto& color = map.features().begin()->second->color;
  EXPECT_NEAR(color[0], 127.5, 1e-9);
  EXPECT_NEAR(color[2], 127.5, 1e-9);
}

TEST(GeometricMap, AViewAlongTheSurfaceIsNotFused) {
  Observer observer;
  GeometricMap map = empty_map();
  map.apply(observer.observe(1, {table_at()}, testing::look_at({0, -3, 0.9}, {0, 0, 0.75})));
  EXPECT_TRUE(map.features().empty());
}

TEST(GeometricMap, TheSameEventsGiveTheSameHash) {
  EXPECT_EQ(folded_hash(noisy_views(40)), folded_hash(noisy_views(40)));
  EXPECT_NE(folded_hash(noisy_views(40)), folded_hash(noisy_views(39)));
}

TEST(GeometricMap, DoesNotDependOnTheOrderInWhichKeyframesArrive) {
  std::vector<ObservationPtr> views = noisy_views(40);
  const std::string in_order = folded_hash(views);
  std::mt19937 random(3);
  for (int trial = 0; trial < 5; ++trial) {
    std::shuffle(views.begin(), views.end(), random);
    EXPECT_EQ(folded_hash(views), in_order);
  }
}

TEST(GeometricMap, RemovingAKeyframeGivesTheHashOfAMapThatNeverSawIt) {
  const std::vector<ObservationPtr> views = noisy_views(40);
  for (const int removed : {0, 7, 15, 16, 17, 39}) {
    std::vector<ObservationPtr> others = views;
    others.erase(others.begin() + removed);
    GeometricMap map = empty_map();
    for (const ObservationPtr& view : views) map.apply(view);
    map.apply(KeyframeRemoval{views[static_cast<std::size_t>(removed)]->keyframe});
    EXPECT_EQ(hash_of(map), folded_hash(others)) << "key frame " << removed;
  }
}

TEST(GeometricMap, ARemovedKeyframeStaysOutWhenItsPlanesComeLate) {
  const std::vector<ObservationPtr> views = noisy_views(3);
  GeometricMap map = empty_map();
  map.apply(views[0]);
  EXPECT_EQ(map.apply(KeyframeRemoval{views[1]->keyframe}).fault, EventFault::kNone);
  EXPECT_EQ(map.apply(views[1]).fault, EventFault::kRemoved);
  EXPECT_EQ(hash_of(map), folded_hash({views[0]}));
}

TEST(GeometricMap, CorrectingAllPosesByOneTransformMovesTheMapByIt) {
  const std::vector<ObservationPtr> views = noisy_views(40);
  Isometry3d T_new_old(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()));
  T_new_old.translation() = Vector3d(1000, -500, 3);
  GeometricMap map = empty_map();
  PoseCorrection correction;
  for (const ObservationPtr& view : views) {
    map.apply(view);
    correction.poses.emplace_back(view->keyframe, T_new_old * view->T_world_camera);
  }
  const FeatureSet before = map.features();
  map.apply(correction);
  ASSERT_EQ(map.features().size(), before.size());
  for (const auto& [id, feature] : map.features()) {
    const MapFeature& old = *before.at(id);
    ASSERT_EQ(feature->surface.polygon.parts.size(), old.surface.polygon.parts.size());
    const auto& ring = feature->surface.polygon.parts[0].outer;
    const auto& old_ring = old.surface.polygon.parts[0].outer;
    ASSERT_EQ(ring.size(), old_ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i) {
      EXPECT_LT((feature->surface.lift(ring[i]) - T_new_old * old.surface.lift(old_ring[i])).norm(),
                1e-3);
    }
  }
}

TEST(GeometricMap, ACorrectionMayComeBeforeTheObservation) {
  const std::vector<ObservationPtr> views = noisy_views(2);
  const Isometry3d moved = Eigen::Translation3d(0.01, 0, 0) * views[1]->T_world_camera;
  GeometricMap early = empty_map(), late = empty_map();
  early.apply(views[0]);
  early.apply(PoseCorrection{{{views[1]->keyframe, moved}}});
  early.apply(views[1]);
  late.apply(views[0]);
  late.apply(views[1]);
  late.apply(PoseCorrection{{{views[1]->keyframe, moved}}});
  EXPECT_EQ(hash_of(early), hash_of(late));
}

TEST(GeometricMap, BadEventsAreRefusedWithAReasonAndChangeNothing) {
  const std::vector<ObservationPtr> views = noisy_views(2);
  GeometricMap map = empty_map();
  map.apply(views[0]);
  const std::string before = hash_of(map);
  const auto refused = [&](auto spoil) {
    auto bad = std::make_shared<Observation>(*views[1]);
    spoil(*bad);
    const EventFault fault = map.apply(bad).fault;
    EXPECT_EQ(hash_of(map), before);
    return fault;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refused([&](Observation& o) { o.T_world_camera.translation().x() = nan; }),
            EventFault::kNotFinite);
  EXPECT_EQ(refused([&](Observation& o) { o.T_world_camera.linear() *= 2.0; }),
            EventFault::kNotRigid);
  EXPECT_EQ(refused([&](Observation& o) { o.planes[0].moments.second(0, 0) = nan; }),
            EventFault::kNotFinite);
  EXPECT_EQ(refused([&](Observation& o) { o.planes[0].surface.polygon.parts.clear(); }),
            EventFault::kBadPolygon);
  EXPECT_EQ(refused([&](Observation& o) {
              auto& ring = o.planes[0].surface.polygon.parts[0].outer;
              std::swap(ring[1], ring[2]);
            }),
            EventFault::kBadPolygon);
  EXPECT_EQ(map.apply(views[0]).fault, EventFault::kAlreadyObserved);
  EXPECT_EQ(map.revision(), 1);
}

TEST(GeometricMap, CopiesAreOnlyAShortCut) {
  HistoryConfig often;
  often.copy_every = 1;
  often.max_copies = 3;
  const std::vector<ObservationPtr> views = noisy_views(30);
  std::vector<ObservationPtr> others = views;
  others.erase(others.begin() + 5);
  GeometricMap map(MergeConfig{}, often);
  for (const ObservationPtr& view : views) map.apply(view);
  map.apply(KeyframeRemoval{views[5]->keyframe});
  EXPECT_EQ(hash_of(map), folded_hash(others));
}

TEST(GeometricMap, BeyondItsHistoryAMapRefusesToReachBack) {
  HistoryConfig small;
  small.copy_every = 4;
  small.max_keyframes = 16;
  const std::vector<ObservationPtr> views = noisy_views(40);
  GeometricMap map(MergeConfig{}, small);
  for (const ObservationPtr& view : views) map.apply(view);
  EXPECT_EQ(hash_of(map), folded_hash(views));
  EXPECT_LE(map.history().keyframes().size(), 17u);
  EXPECT_EQ(map.apply(KeyframeRemoval{views[0]->keyframe}).fault, EventFault::kCompacted);
  EXPECT_EQ(map.apply(views[0]).fault, EventFault::kCompacted);

  std::vector<ObservationPtr> others = views;
  others.erase(others.begin() + 38);
  map.apply(KeyframeRemoval{views[38]->keyframe});
  EXPECT_EQ(hash_of(map), folded_hash(others));
}

TEST(GeometricMap, WhatAKeyframeIsComparedWithDoesNotDependOnWhatIsFarAway) {
  const std::vector<ObservationPtr> views = noisy_views(20);
  const auto candidates_beside = [&](int rooms) {
    GeometricMap map = empty_map();
    for (int i = 1; i <= rooms; ++i) {
      auto elsewhere = std::make_shared<Observation>(*views[0]);
      elsewhere->keyframe = i;
      elsewhere->T_world_camera.translation() += Vector3d(8.0 * (i % 7), 8.0 * (1 + i / 7), 0.0);
      map.apply(std::move(elsewhere));
    }
    std::vector<std::int64_t> candidates;
    for (const ObservationPtr& view : views) candidates.push_back(map.apply(view).candidates);
    return candidates;
  };
  EXPECT_EQ(candidates_beside(40), candidates_beside(0));
  EXPECT_GT(candidates_beside(0).back(), 0);
}

TEST(GeometricMap, TheChangesAddUpToTheMap) {
  GeometricMap map = empty_map();
  std::set<FeatureId> ids;
  const auto follow = [&](const MapChange& change) {
    for (const FeatureId& id : change.upserted) ids.insert(id);
    for (const FeatureId& id : change.removed) EXPECT_EQ(ids.erase(id), 1u);
    for (const auto& [id, into] : change.absorbed) {
      EXPECT_EQ(ids.erase(id), 1u);
      EXPECT_TRUE(map.features().contains(into));
    }
    std::set<FeatureId> now;
    for (const auto& [id, feature] : map.features()) now.insert(id);
    EXPECT_EQ(ids, now);
  };
  const std::vector<ObservationPtr> views = noisy_views(40);
  for (const ObservationPtr& view : views) follow(map.apply(view).change);
  for (const int i : {0, 1, 2, 20}) {
    follow(map.apply(KeyframeRemoval{views[static_cast<std::size_t>(i)]->keyframe}).change);
  }
}

}  // namespace
}  // namespace geomap::mapping
