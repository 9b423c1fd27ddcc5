// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <random>

#include "mapping/feature_index.hpp"
#include "mapping/feature_store.hpp"
#include "mapping/fuse.hpp"
#include "mapping/merger.hpp"
#include "mapping/plane_similarity.hpp"
#include "mapping/scene.hpp"

namespace geomap::mapping {
namespace {

using Eigen::Vector3d;
using testing::Observer;
using testing::Rectangle;

using testing::kX, testing::kY, testing::kZ;

const Eigen::Isometry3d kCamera = testing::look_at({0.0, -1.0, 3.0}, {0.0, 0.0, 0.0});

Rectangle floor_at(const Vector3d& center, double half = 0.5) {
  return {"floor", center, kX, kY, half, half, {}, {}};
}

MapFeature feature_of_rectangle(const Rectangle& rectangle, std::int64_t keyframe = 1,
                                const Eigen::Isometry3d& T_world_camera = kCamera) {
  Observer observer;
  return *feature_of(*observer.observe(keyframe, {rectangle}, T_world_camera), 0, MergeConfig{});
}

Rectangle tilted(Rectangle rectangle, double angle) {
  rectangle.u = Eigen::AngleAxisd(angle, rectangle.v) * rectangle.u;
  return rectangle;
}

Similarity compare_once(const MapFeature& a, const MapFeature& b, const MergeConfig& config) {
  ClipMemo memo;
  return compare(a, b, config, memo);
}

TEST(PlaneSimilarity, DistanceIsTheRmsOverTheOverlapInClosedForm) {
  // A plane turned by angle a about the middle of a square of side s: heights are uniform in
  // +-s/2 tan a, whose rms is s tan(a) / sqrt(12).
  const double angle = 0.02;
  MergeConfig config;
  config.gap = 0.0;
  const Similarity s =
      compare_once(feature_of_rectangle(floor_at({0, 0, 0})),
                   feature_of_rectangle(tilted(floor_at({0, 0, 0}), angle)), config);
  EXPECT_EQ(s.difference, Difference::kNone);
  EXPECT_NEAR(s.angle, angle, 1e-6);
  EXPECT_NEAR(s.distance, std::tan(angle) / std::sqrt(12.0), 2e-5);
  EXPECT_NEAR(s.overlap, 1.0, 1e-3);
}

TEST(PlaneSimilarity, NamesTheFirstConditionThatFails) {
  const MapFeature a = feature_of_rectangle(floor_at({0, 0, 0}));
  const MergeConfig config;
  const auto difference = [&](const Rectangle& r) {
    return compare_once(a, feature_of_rectangle(r), config).difference;
  };
  EXPECT_EQ(difference(tilted(floor_at({0, 0, 0}), 0.3)), Difference::kAngle);
  EXPECT_EQ(difference(floor_at({2, 0, 0})), Difference::kOverlap);
  EXPECT_EQ(difference(floor_at({0, 0, 0.09})), Difference::kDistance);
  const Eigen::Isometry3d below = testing::look_at({0, -1, -3}, {0, 0, 0});
  EXPECT_EQ(compare_once(a, feature_of_rectangle(floor_at({0, 0, 0}), 2, below), config).difference,
            Difference::kSide);
}

TEST(PlaneSimilarity, DoesNotDependOnWhereTheWorldIs) {
  Eigen::Isometry3d far(Eigen::AngleAxisd(1.1, Vector3d(3, -1, 2).normalized()));
  far.translation() = Vector3d(1000, -500, 3);
  Observer observer;
  const auto near_view =
      observer.observe(1, {floor_at({0, 0, 0}), tilted(floor_at({0.3, 0.2, 0.01}), 0.03)}, kCamera);
  auto far_view = std::make_shared<Observation>(*near_view);
  far_view->T_world_camera = far * near_view->T_world_camera;
  const MergeConfig config;
  const Similarity near_by =
      compare_once(*feature_of(*near_view, 0, config), *feature_of(*near_view, 1, config), config);
  const Similarity far_away =
      compare_once(*feature_of(*far_view, 0, config), *feature_of(*far_view, 1, config), config);
  EXPECT_EQ(near_by.difference, far_away.difference);
  EXPECT_NEAR(near_by.angle, far_away.angle, 1e-9);
  EXPECT_NEAR(near_by.distance, far_away.distance, 1e-6);
  EXPECT_NEAR(near_by.overlap, far_away.overlap, 1e-5);
}

TEST(Fuse, AViewWeighsWhatItsPoseAndSensorAllowAndNoMoreThanItsShareOfSurface) {
  MergeConfig config;
  config.systematic_share = 0.0;
  Observer observer;
  const double pose_weight = 1.0 / (config.sigma_pose * config.sigma_pose);
  const auto weight = [&](double half) {
    const auto view = observer.observe(1, {floor_at({0, 0, 0}, half)}, kCamera);
    return feature_of(*view, 0, config)->moments.weight;
  };
  EXPECT_NEAR(weight(0.75), pose_weight, 1e-6 * pose_weight);  // 2.25 m²: a full vote
  EXPECT_NEAR(weight(0.25), 0.25 * pose_weight, 1e-3 * pose_weight);
  config.systematic_share = 1.0;
  const double sigma_z = geometry::DepthNoise{}.sigma(std::hypot(1.0, 3.0));
  EXPECT_NEAR(weight(0.75), 1.0 / (1.0 / pose_weight + sigma_z * sigma_z), 0.2 * pose_weight);
  EXPECT_LT(weight(0.75), 0.5 * pose_weight);
}

TEST(Fuse, ALargePatchDecidesTheAngleOfASmallOne) {
  // Weighting by merge count would end half way between the two.
  MapFeature large = feature_of_rectangle(floor_at({0, 0, 0}, 1.0));
  const MapFeature small = feature_of_rectangle(tilted(floor_at({0, 0, 0}, 0.1), 0.1), 2);
  add_evidence(large, small);
  refit(large);
  EXPECT_LT(std::acos(large.surface.plane.normal.z()), 0.005);
  EXPECT_EQ(large.observations.size(), 2u);
}

TEST(Fuse, RebasingMovesTheFrameButNotTheSurface) {
  MapFeature feature = feature_of_rectangle(floor_at({0, 0, 0}));
  feature.surface.plane =
      geometry::Plane::through({0, 0, 0}, Vector3d(0.02, 0.0, 1.0).normalized());
  const Vector3d corner = feature.surface.lift(feature.surface.polygon.parts[0].outer[0]);
  const double area = geometry::area(feature.surface.polygon);
  rebase_where_needed(feature, 0.0087);
  EXPECT_LT(geometry::angle_between(feature.surface.plane, feature.surface.frame.plane()), 1e-9);
  double nearest = 1.0;
  for (const geometry::GridPoint vertex : feature.surface.polygon.parts[0].outer) {
    nearest = std::min(nearest, (feature.surface.lift(vertex) - corner).norm());
  }
  EXPECT_LT(nearest, 2e-4);
  EXPECT_NEAR(geometry::area(feature.surface.polygon), area / std::cos(0.02), 2e-4 * area + 2e-4);
}

TEST(PaperMerger, AveragesCoefficientsByMergeCountAsInEquation7) {
  MergeConfig config;
  config.mode = "paper";
  const auto merger = make_merger(config);
  FeatureStore store;
  const double angle = 0.1;
  merger->insert(feature_of_rectangle(floor_at({0, 0, 0}), 1), store);
  merger->insert(feature_of_rectangle(floor_at({0, 0, 0}), 2), store);
  merger->insert(feature_of_rectangle(tilted(floor_at({0, 0, 0.03}), angle), 3), store);
  ASSERT_EQ(store.features().size(), 1u);
  const geometry::Plane plane = store.features().begin()->second->surface.plane;
  Vector3d normal = 2.0 * kZ + Eigen::AngleAxisd(angle, kY) * kZ;
  const double d = -0.03 * std::cos(angle) / normal.norm();
  EXPECT_LT((plane.normal - normal.normalized()).norm(), 1e-4);
  EXPECT_NEAR(plane.d, d, 1e-4);
}

TEST(PaperMerger, ComparesDistancesAtTheWorldsOrigin) {
  // Two views of one floor that touch and differ by 3 degrees: 8 m from the origin the paper's d
  // differ by 0.4 m and they stay apart, where the distance at the overlap is nearly nothing.
  const Vector3d there(8, 0, 0);
  const Eigen::Isometry3d camera = testing::look_at(there + Vector3d(0, -1, 3), there);
  const MapFeature a = feature_of_rectangle(floor_at(there), 1, camera);
  const MapFeature b = feature_of_rectangle(tilted(floor_at(there), 0.0523), 2, camera);
  const auto count = [&](const char* mode) {
    MergeConfig config;
    config.mode = mode;
    FeatureStore store;
    const auto merger = make_merger(config);
    merger->insert(a, store);
    merger->insert(b, store);
    return store.features().size();
  };
  EXPECT_EQ(count("paper"), 2u);
  EXPECT_EQ(count("moments"), 1u);
}

TEST(Merger, ComparesWithWhatIsNearButThePapersWithEverything) {
  const auto compared_with = [&](const char* mode) {
    MergeConfig config;
    config.mode = mode;
    FeatureStore store;
    const auto merger = make_merger(config);
    for (int i = 0; i < 20; ++i) {
      const Vector3d there(10.0 * i, 0, 0);
      const Eigen::Isometry3d camera = testing::look_at(there + Vector3d(0, -1, 3), there);
      merger->insert(feature_of_rectangle(floor_at(there), i, camera), store);
    }
    EXPECT_EQ(store.features().size(), 20u) << mode;
    return merger->insert(feature_of_rectangle(floor_at({0, 0, 0}), 20), store);
  };
  // Once to find its like; fused with it, it looks again for what the two may bridge.
  EXPECT_EQ(compared_with("moments"), 1);
  EXPECT_EQ(compared_with("paper"), 20);
}

TEST(Merger, RefusesAConfigurationThatIsNotValid) {
  MergeConfig config;
  config.mode = "magic";
  EXPECT_THROW(make_merger(config), std::invalid_argument);
}

TEST(FeatureIndex, FindsWhatBruteForceFinds) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> at(-10, 10), size(0.0, 2.0);
  const auto any_box = [&] {
    const Vector3d low(at(random), at(random), at(random));
    return Eigen::AlignedBox3d(low, low + Vector3d(size(random), size(random), size(random)));
  };
  FeatureIndex index;
  std::map<FeatureId, Eigen::AlignedBox3d> boxes;
  for (int i = 0; i < 500; ++i) {
    const FeatureId id{i, i % 3};
    boxes[id] = any_box();
    index.insert(id, boxes[id]);
  }
  for (int i = 0; i < 500; i += 4) {
    index.remove({i, i % 3}, boxes[{i, i % 3}]);
    boxes.erase({i, i % 3});
  }
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::AlignedBox3d query = any_box();
    std::vector<FeatureId> expected;
    for (const auto& [id, box] : boxes) {
      if (box.intersects(query)) expected.push_back(id);
    }
    EXPECT_EQ(index.query(query), expected);
  }
}

}  // namespace
}  // namespace geomap::mapping
