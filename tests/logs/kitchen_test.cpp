// SPDX-License-Identifier: BSD-3-Clause
// The main job on real input: 500 frames of a hand-held Kinect in a kitchen become a map in which
// the five reference planes are found once each, and in which nothing is invented.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "drivers/seven_scenes_source.hpp"
#include "geometry/angles.hpp"
#include "geometry/polygon_clip.hpp"
#include "logs/import.hpp"
#include "logs/map_metrics.hpp"
#include "logs/pipeline.hpp"
#include "logs/reference_planes.hpp"
#include "mapping/map_hash.hpp"
#include "mapping/map_journal.hpp"
#include "messaging/log_reader.hpp"
#include "perception/sensor_messages.hpp"
#include "support/recordings.hpp"
#include "support/support_points.hpp"

namespace geomap::logs {
namespace {

namespace fs = std::filesystem;
using mapping::MapFeature;

// What is tested here is what is made of known poses; kitchen_registration_test finds them.
PipelineConfig recorded_poses() {
  PipelineConfig config;
  config.tracker.registration.method = "prior";
  return config;
}

// One replay of a log with given settings.
std::unique_ptr<Pipeline> replay(const fs::path& log, const PipelineConfig& config, int threads) {
  auto pipeline = std::make_unique<Pipeline>(config, threads);
  perception::SensorMessages input(pipeline->tracking(), {});
  messaging::LogReader reader(log.string());
  while (const auto event = reader.next()) input.handle(event->channel, event->data);
  pipeline->finish();
  EXPECT_TRUE(input.refused().empty());
  return pipeline;
}

class Kitchen : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = testing::recording("redkitchen");
    if (!folder_) return;
    log_ = fs::temp_directory_path() / ("geomap_kitchen_" + std::to_string(getpid()) + ".lcmlog");
    drivers::SevenScenesSource source(*folder_);
    import_frames(source, {}, log_.string(), [](std::size_t) { return true; });
    for (const char* mode : {"moments", "paper"}) {
      PipelineConfig config = recorded_poses();
      config.merge.mode = mode;
      (config.merge.mode == "paper" ? paper_ : moments_) = replay(log_, config, 2);
    }
  }
  static void TearDownTestSuite() {
    moments_.reset();
    paper_.reset();
    std::error_code ignored;
    fs::remove(log_, ignored);
  }
  void SetUp() override {
    if (!folder_) GTEST_SKIP() << "no recording 'redkitchen' under GEOMAP_DATA";
  }

  static std::vector<MapFeature> features(const Pipeline& pipeline) {
    return mapping::snapshot_of(pipeline.map()).features;
  }

  static std::optional<fs::path> folder_;
  static fs::path log_;
  static std::unique_ptr<Pipeline> moments_;
  static std::unique_ptr<Pipeline> paper_;
};

std::optional<fs::path> Kitchen::folder_;
fs::path Kitchen::log_;
std::unique_ptr<Pipeline> Kitchen::moments_;
std::unique_ptr<Pipeline> Kitchen::paper_;

TEST_F(Kitchen, AllFramesAreReadAndNoneIsRejected) {
  EXPECT_EQ(moments_->frames(), 500);
  EXPECT_EQ(moments_->keyframes().size(), 41u);
  EXPECT_TRUE(moments_->rejected().empty());
}

TEST_F(Kitchen, EachReferencePlaneIsExactlyOneFeature) {
  const std::vector<MapFeature> map = features(*moments_);
  const auto references = testing::load_reference_planes(*folder_ / "reference_planes.yaml");
  ASSERT_EQ(references.size(), 5u);
  for (const testing::ReferencePlane& reference : references) {
    const auto found = testing::features_on(reference, map, {1.5, 0.025});
    std::cout << found;
    ASSERT_EQ(found.features.size(), 1u) << reference.name;
    EXPECT_THAT(found.stacked, ::testing::IsEmpty()) << "on " << reference.name;
  }
}

TEST_F(Kitchen, NineTenthsOfTheMapLieOnMeasuredPoints) {
  testing::SupportPoints points;
  drivers::SevenScenesSource source(*folder_);
  for (int i = 0; const auto frame = source.next(); ++i) {
    if (i % 5 == 0) points.add(frame->frame, *frame->truth_T_world_camera);
  }
  for (const auto& [name, pipeline] :
       {std::pair{"moments", moments_.get()}, {"paper", paper_.get()}}) {
    const double share = points.supported_share(features(*pipeline), 0.025);
    std::cout << name << ": " << 100.0 * share << " % of the area within 2.5 cm of points, "
              << pipeline->map().features().size() << " features, "
              << find_duplicates(features(*pipeline)).size() << " duplicates\n";
    if (pipeline == moments_.get()) {
      EXPECT_GE(share, 0.9);
    }
  }
}

TEST_F(Kitchen, TheHashIsTheSameAgainAndWithFourThreads) {
  const std::string hash = mapping::map_hash(moments_->map().features());
  EXPECT_EQ(mapping::map_hash(replay(log_, recorded_poses(), 1)->map().features()), hash);
  EXPECT_EQ(mapping::map_hash(replay(log_, recorded_poses(), 4)->map().features()), hash);
}

// The events of a map, moved as a whole: what another choice of the world's frame would have given.
std::vector<std::shared_ptr<const mapping::Observation>> observations(
    const Pipeline& pipeline, const Eigen::Isometry3d& T_new_old) {
  std::vector<std::shared_ptr<const mapping::Observation>> moved;
  for (const auto& [id, observation] : pipeline.map().history().keyframes()) {
    auto copy = std::make_shared<mapping::Observation>(*observation);
    copy->T_world_camera = T_new_old * observation->T_world_camera;
    moved.push_back(copy);
  }
  return moved;
}

mapping::GeometricMap folded(
    const std::vector<std::shared_ptr<const mapping::Observation>>& views) {
  mapping::GeometricMap map(mapping::MergeConfig{}, mapping::HistoryConfig{});
  for (const auto& view : views) map.apply(view);
  return map;
}

double largest_vertex_distance(const mapping::FeatureSet& before, const mapping::FeatureSet& after,
                               const Eigen::Isometry3d& T_after_before) {
  double largest = 0.0;
  for (const auto& [id, feature] : before) {
    const auto other = after.find(id);
    if (other == after.end()) return std::numeric_limits<double>::infinity();
    const auto& parts = feature->surface.polygon.parts;
    const auto& other_parts = other->second->surface.polygon.parts;
    if (parts.size() != other_parts.size()) return std::numeric_limits<double>::infinity();
    for (std::size_t p = 0; p < parts.size(); ++p) {
      for (const geometry::GridPoint vertex : parts[p].outer) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const geometry::GridPoint v : other_parts[p].outer) {
          nearest = std::min(nearest, (T_after_before * feature->surface.lift(vertex) -
                                       other->second->surface.lift(v))
                                          .norm());
        }
        largest = std::max(largest, nearest);
      }
    }
  }
  return largest;
}

TEST_F(Kitchen, TheMapMovesWithTheWorldsFrame) {
  const mapping::FeatureSet& before = moments_->map().features();
  for (const double angle : {0.0, 0.7, 2.5}) {
    Eigen::Isometry3d T(Eigen::AngleAxisd(angle, Eigen::Vector3d(1, -2, 3).normalized()));
    T.translation() = Eigen::Vector3d(1000, -500, 3);
    const mapping::GeometricMap moved = folded(observations(*moments_, T));
    EXPECT_EQ(moved.features().size(), before.size());
    const double largest = largest_vertex_distance(before, moved.features(), T);
    std::cout << "turned by " << angle << " rad: vertices within " << 1e3 * largest << " mm\n";
    EXPECT_LT(largest, 1e-3);
  }
}

TEST_F(Kitchen, CorrectingAllPosesByOneTransformMovesTheMapByIt) {
  Eigen::Isometry3d T(Eigen::AngleAxisd(0.4, Eigen::Vector3d(0, 1, 1).normalized()));
  T.translation() = Eigen::Vector3d(3, 2, 1);
  mapping::GeometricMap map = folded(observations(*moments_, Eigen::Isometry3d::Identity()));
  mapping::PoseCorrection correction;
  for (const auto& [id, view] : map.history().keyframes()) {
    correction.poses.emplace_back(id, T * view->T_world_camera);
  }
  map.apply(correction);
  EXPECT_LT(largest_vertex_distance(moments_->map().features(), map.features(), T), 1e-3);
}

TEST_F(Kitchen, RemovingAKeyframeGivesTheHashOfAMapThatNeverSawIt) {
  const auto views = observations(*moments_, Eigen::Isometry3d::Identity());
  for (const std::size_t removed : {0ul, 11ul, 20ul, views.size() - 1}) {
    auto others = views;
    others.erase(others.begin() + static_cast<long>(removed));
    mapping::GeometricMap map = folded(views);
    map.apply(mapping::KeyframeRemoval{views[removed]->keyframe});
    EXPECT_EQ(mapping::map_hash(map.features()), mapping::map_hash(folded(others).features()));
  }
}

TEST_F(Kitchen, TheOrderInWhichKeyframesArriveDoesNotMatter) {
  auto views = observations(*moments_, Eigen::Isometry3d::Identity());
  std::reverse(views.begin(), views.end());
  EXPECT_EQ(mapping::map_hash(folded(views).features()),
            mapping::map_hash(moments_->map().features()));
}

// Renumbered key frames are folded in another order: what fusing itself makes of the order.
TEST_F(Kitchen, FusingInAnotherOrderGivesTheSameLargeFeatures) {
  auto views = observations(*moments_, Eigen::Isometry3d::Identity());
  std::reverse(views.begin(), views.end());
  std::vector<std::shared_ptr<const mapping::Observation>> renumbered;
  for (std::size_t i = 0; i < views.size(); ++i) {
    auto copy = std::make_shared<mapping::Observation>(*views[i]);
    copy->keyframe = static_cast<std::int64_t>(i + 1);
    renumbered.push_back(copy);
  }
  const mapping::GeometricMap other = folded(renumbered);
  const std::vector<MapFeature> mine = features(*moments_);
  const std::vector<MapFeature> theirs = mapping::snapshot_of(other).features;
  int large = 0, matched = 0;
  for (const MapFeature& feature : mine) {
    const double area = geometry::area(feature.surface.polygon);
    if (area < 0.1) continue;
    ++large;
    const Eigen::Vector3d at =
        feature.surface.lift(geometry::area_moments(feature.surface.polygon).centroid);
    const bool found = std::any_of(theirs.begin(), theirs.end(), [&](const MapFeature& candidate) {
      return stacked_area(feature, candidate) > 0.5 * area &&
             geometry::angle_between(feature.surface.plane, candidate.surface.plane) <
                 geometry::radians(0.1) &&
             std::abs(candidate.surface.plane.signed_distance(at)) < 0.002;
    });
    matched += found;
    // Clutter that two neighbours compete for may go either way; furniture and walls may not.
    EXPECT_TRUE(found || area < 0.6) << to_string(feature.id) << " " << area << " m2";
  }
  std::cout << matched << " of " << large << " features of at least 0.1 m2 the same; "
            << mine.size() << " and " << theirs.size() << " features\n";
  EXPECT_GE(10 * matched, 6 * large);
  EXPECT_NEAR(static_cast<double>(theirs.size()), static_cast<double>(mine.size()),
              0.05 * static_cast<double>(mine.size()));
}

}  // namespace
}  // namespace geomap::logs
