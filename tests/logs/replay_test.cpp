// SPDX-License-Identifier: BSD-3-Clause
#include "logs/replay.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <nlohmann/json.hpp>

#include "drivers/kinect_config.hpp"
#include "geomap/keyframe_t.hpp"
#include "logs/synthetic_log.hpp"
#include "logs/trajectory_file.hpp"
#include "mapping/map_hash.hpp"
#include "mapping/map_journal.hpp"
#include "mapping/map_view_process.hpp"
#include "messaging/channels.hpp"
#include "messaging/config_checks.hpp"
#include "messaging/convert_frame.hpp"
#include "messaging/convert_geometry.hpp"
#include "messaging/convert_points.hpp"
#include "messaging/encode.hpp"
#include "messaging/safe_decode.hpp"
#include "messaging/temporary_folder.hpp"
#include "support/plane_renderer.hpp"

namespace geomap::logs {
namespace {

namespace fs = std::filesystem;

class Replay : public testing::TemporaryFolder {
 protected:
  ReplayResult replay_events(const std::vector<messaging::LogEvent>& events,
                             ReplayOptions options = {},
                             const std::vector<std::string>& settings = {}) {
    options.log = path("in.lcmlog");
    options.output = path("out");
    testing::write_log(options.log, events);
    return replay(options, messaging::Config::load(std::nullopt, settings));
  }
};

TEST_F(Replay, FindsTheRectanglesOfASmallRoomOnceEachWhereTheyAre) {
  const ReplayResult result = replay_events(testing::synthetic_log(20));
  const auto& features = result.report.map.features;
  const auto room = testing::small_room();
  EXPECT_EQ(features.size(), room.size());
  for (const testing::Rectangle& rectangle : room) {
    int found = 0;
    for (const mapping::MapFeature& feature : features) {
      const geometry::Plane truth = rectangle.plane_seen_from({0, -1.5, 1.4});
      found += geometry::angle_between(feature.surface.plane, truth) < 0.005 &&
               std::abs(feature.surface.plane.signed_distance(rectangle.center)) < 0.005;
    }
    EXPECT_EQ(found, 1) << rectangle.name;
  }
}

TEST_F(Replay, WritesEveryResultItPromises) {
  ReplayOptions options;
  options.pictures_every = 2;
  options.log_out = path("derived.lcmlog");
  const ReplayResult result = replay_events(testing::synthetic_log(20), options);
  for (const char* name : {"map.lcmlog", "map.svg", "point_map.ply", "trajectory.tum",
                           "trajectory_all.tum", "report.json", "report.md", "config_used.yaml",
                           "pictures/keyframe_0001.svg", "pictures/keyframe_0002.svg"}) {
    EXPECT_TRUE(fs::exists(fs::path(path("out")) / name)) << name;
  }
  const auto json = nlohmann::json::parse(read_file(path("out/report.json")));
  EXPECT_EQ(json["frames"], 20);
  EXPECT_EQ(json["keyframes"], result.report.keyframes.size());
  EXPECT_EQ(json["map_hash"], result.report.map.hash);
  EXPECT_EQ(json["bytes"]["raw"], result.report.keyframes.size() * 320 * 240 * 12);
  EXPECT_EQ(json["bytes"]["map"],
            12 * json["map_vertices"].get<int>() + 16 * json["map_features"].get<int>());
  for (const char* stage : {"decode", "registration", "extraction", "hull", "merging", "total"}) {
    for (const char* key : {"mean", "p50", "p95", "max"}) {
      EXPECT_GE(json["stage_seconds"][stage][key].get<double>(), 0.0) << stage << " " << key;
    }
  }
  EXPECT_THAT(read_file(path("out/report.md")), ::testing::HasSubstr("map.svg"));
}

TEST_F(Replay, TheReportTellsHowTheMapGrewOverTheKeyFrames) {
  const ReplayResult result = replay_events(testing::synthetic_log(20));
  const auto json = nlohmann::json::parse(read_file(path("out/report.json")));
  const std::vector<int> extracted = json["growth"]["planes_extracted"];
  const std::vector<int> features = json["growth"]["map_features"];
  const std::vector<KeyframeRecord>& keyframes = result.report.keyframes;
  ASSERT_GE(keyframes.size(), 2U);
  ASSERT_EQ(extracted.size(), keyframes.size());
  ASSERT_EQ(features.size(), keyframes.size());
  int sum = 0;
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    EXPECT_EQ(extracted[i], sum += keyframes[i].planes) << i;
    EXPECT_EQ(features[i], keyframes[i].map_features) << i;
  }
  EXPECT_EQ(json["planes_extracted"], extracted.back());
  EXPECT_EQ(json["map_features"], features.back());
}

TEST_F(Replay, TheReportTellsWhatEachKeyFrameCost) {
  const ReplayResult result = replay_events(testing::synthetic_log(20));
  const auto growth = nlohmann::json::parse(read_file(path("out/report.json")))["growth"];
  const std::vector<KeyframeRecord>& keyframes = result.report.keyframes;
  for (const char* key : {"blocks_visited", "candidates_visited", "registration_seconds",
                          "merging_seconds", "total_seconds"}) {
    ASSERT_EQ(growth[key].size(), keyframes.size()) << key;
  }
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    EXPECT_EQ(growth["blocks_visited"][i], keyframes[i].registration.blocks_visited) << i;
    EXPECT_EQ(growth["candidates_visited"][i], keyframes[i].candidates) << i;
    EXPECT_EQ(growth["registration_seconds"][i], keyframes[i].times.registration) << i;
    EXPECT_EQ(growth["merging_seconds"][i], keyframes[i].times.merging) << i;
    EXPECT_EQ(growth["total_seconds"][i], keyframes[i].times.total()) << i;
  }
  // The first finds nothing to look at; every later plane is compared with itself at least.
  EXPECT_EQ(keyframes[0].registration.blocks_visited, 0);
  for (std::size_t i = 1; i < keyframes.size(); ++i) {
    EXPECT_GT(keyframes[i].registration.blocks_visited, 0) << i;
    EXPECT_GE(keyframes[i].candidates, keyframes[i].planes) << i;
  }
}

TEST_F(Replay, TheSavedMapIsTheMapOfTheReport) {
  const ReplayResult result = replay_events(testing::synthetic_log(12));
  const mapping::SavedMap saved = mapping::load_map(path("out/map.lcmlog"));
  EXPECT_EQ(mapping::map_hash(saved.contents.features), result.report.map.hash);
}

TEST_F(Replay, ThePlanesOfItsDerivedLogFoldToTheSameMap) {
  ReplayOptions options;
  options.log_out = path("derived.lcmlog");
  const ReplayResult result = replay_events(testing::synthetic_log(20, 0.005), options);
  mapping::GeometricMap map(mapping::MergeConfig{}, mapping::HistoryConfig{});
  messaging::LogReader reader(options.log_out);
  while (const auto event = reader.next()) {
    if (event->channel != messaging::channels::kPlanes) continue;
    const auto message =
        messaging::safe_decode<geomap::plane_set_t>(event->data.data(), event->data.size());
    auto planes = messaging::from_message(message.message.value());
    ASSERT_TRUE(planes);
    auto observation = std::make_shared<mapping::Observation>();
    observation->keyframe = planes->keyframe;
    observation->T_world_camera = planes->T_world_camera;
    observation->planes = std::move(planes->planes);
    map.apply(observation);
  }
  EXPECT_EQ(mapping::map_hash(map.features()), result.report.map.hash);
}

TEST_F(Replay, ThePointMapOfItsDerivedLogIsThatOfThePipeline) {
  ReplayOptions options;
  options.log_out = path("derived.lcmlog");
  const ReplayResult result = replay_events(testing::synthetic_log(20), options);
  std::map<std::array<std::int32_t, 3>, std::size_t> points;  // by block
  std::int64_t sequence = 0;
  messaging::LogReader reader(options.log_out);
  while (const auto event = reader.next()) {
    if (event->channel != messaging::channels::kPointMap) continue;
    const auto message =
        messaging::safe_decode<geomap::point_map_update_t>(event->data.data(), event->data.size());
    EXPECT_EQ(message.message.value().sequence, ++sequence);
    const auto blocks = messaging::from_message(*message.message);
    ASSERT_TRUE(blocks);
    for (const messaging::PointBlock& block : *blocks) points[block.index] = block.points.size();
  }
  std::int64_t sum = 0;
  for (const auto& [index, count] : points) sum += static_cast<std::int64_t>(count);
  EXPECT_EQ(sum, result.report.reduction.point_map_points);
}

TEST_F(Replay, ThreadsAndPassesDoNotChangeTheMap) {
  const auto events = testing::synthetic_log(20, 0.01);
  const std::string hash = replay_events(events).report.map.hash;
  ReplayOptions options;
  options.threads = 4;
  options.passes = 2;
  const ReplayResult again = replay_events(events, options);
  EXPECT_EQ(again.report.map.hash, hash);
  EXPECT_EQ(again.report.times.size(), 2 * again.report.keyframes.size());
}

TEST_F(Replay, WithoutPosesAndAlignmentEveryFrameIsRejectedAndSaysWhy) {
  auto events = testing::synthetic_log(5);
  std::erase_if(events, [](const auto& event) { return event.channel == "POSE"; });
  const ReplayResult result = replay_events(events, {}, {"registration.method=prior"});
  EXPECT_EQ(result.report.rejected.at("no_pose"), 5);
  EXPECT_TRUE(result.report.map.features.empty());
}

TEST_F(Replay, WithoutPosesTheAlignmentFindsTheWay) {
  auto events = testing::synthetic_log(20);
  std::erase_if(events, [](const auto& event) { return event.channel == "POSE"; });
  const ReplayResult result = replay_events(events);
  const auto& keyframes = result.report.keyframes;
  ASSERT_GE(keyframes.size(), 5u);
  EXPECT_TRUE(result.report.rejected.empty());
  // The camera moves along the world's x by 5 cm a frame. The map's frame is the first camera's.
  const Eigen::Vector3d moved = keyframes.back().T_world_camera.translation() -
                                keyframes.front().T_world_camera.translation();
  const auto frames = static_cast<double>(keyframes.back().id - keyframes.front().id) / 33'333;
  EXPECT_NEAR(moved.norm(), 0.05 * frames, 0.01);
}

TEST_F(Replay, TheDerivedLogHoldsEveryPoseAndEveryKeyframe) {
  ReplayOptions options;
  options.log_out = path("derived.lcmlog");
  const ReplayResult result = replay_events(testing::synthetic_log(20, 0.005), options);
  std::map<std::string, std::int64_t> count;
  messaging::LogReader reader(options.log_out);
  while (const auto event = reader.next()) {
    ++count[event->channel];
    if (event->channel != messaging::channels::kKeyframe) continue;
    const auto keyframe =
        messaging::safe_decode<geomap::keyframe_t>(event->data.data(), event->data.size());
    ASSERT_TRUE(keyframe.message);
    EXPECT_EQ(keyframe.message->status, geomap::keyframe_t::ACCEPTED);
    EXPECT_EQ(keyframe.message->sequence, count[event->channel] - 1);
    EXPECT_GT(keyframe.message->frame.depth.size, 0);
    if (keyframe.message->sequence > 0) {
      EXPECT_GT(keyframe.message->conditioning, 0.0);
      EXPECT_EQ(keyframe.message->observed_directions, 6);
    }
  }
  const auto keyframes = static_cast<std::int64_t>(result.report.keyframes.size());
  EXPECT_EQ(count[messaging::channels::kCameraPose], 20);
  EXPECT_EQ(count[messaging::channels::kKeyframe], keyframes);
  EXPECT_EQ(count[messaging::channels::kOdomToWorld], keyframes);
  EXPECT_EQ(count[messaging::channels::kPlanes], keyframes);
}

TEST_F(Replay, ARejectedKeyframeSaysWhyAndCarriesNoImages) {
  auto events = testing::synthetic_log(20);
  for (messaging::LogEvent& event : events) {
    if (event.channel != "RGBD_FRAME") continue;
    const auto message =
        messaging::safe_decode<geomap::rgbd_frame_t>(event.data.data(), event.data.size());
    if (message.message->sequence < 10) continue;
    auto frame = *messaging::to_frame(*message.message).frame;
    std::fill(frame.depth.millimetres.begin(), frame.depth.millimetres.end(),
              geometry::DepthImage::kNoReading);
    std::fill_n(frame.depth.millimetres.begin(), 100, std::uint16_t{1500});
    event.data = messaging::encode(messaging::to_message(frame));
  }
  ReplayOptions options;
  options.log_out = path("derived.lcmlog");
  const ReplayResult result = replay_events(events, options);
  std::int64_t rejected = 0;
  messaging::LogReader reader(options.log_out);
  while (const auto event = reader.next()) {
    if (event->channel != messaging::channels::kKeyframe) continue;
    const auto keyframe =
        messaging::safe_decode<geomap::keyframe_t>(event->data.data(), event->data.size());
    ASSERT_TRUE(keyframe.message);
    if (keyframe.message->status == geomap::keyframe_t::ACCEPTED) continue;
    ++rejected;
    EXPECT_EQ(keyframe.message->status, geomap::keyframe_t::TOO_FEW_POINTS);
    EXPECT_EQ(keyframe.message->frame.depth.size, 0);
    EXPECT_EQ(keyframe.message->frame.color.size, 0);
  }
  EXPECT_GT(rejected, 0);
  EXPECT_EQ(result.report.rejected.at("too_few_readings"), rejected);
}

TEST_F(Replay, LogsOfOtherLcmCameraDriversAreMappedWithTheCameraOfTheSettings) {
  const auto ours = testing::synthetic_log(20);
  auto theirs = ours;
  for (messaging::LogEvent& event : theirs) {
    if (event.channel != "RGBD_FRAME") continue;
    const auto frame =
        messaging::safe_decode<geomap::rgbd_frame_t>(event.data.data(), event.data.size());
    bot_core::images_t images{};
    images.utime = frame.message->utime;
    images.n_images = 1;
    images.image_types = {bot_core::images_t::DEPTH_MM_ZIPPED};
    images.images = {frame.message->depth};
    event.channel = "OPENNI_FRAME";
    event.data = messaging::encode(images);
  }
  std::vector<std::string> settings = {
      "driver_camera.depth.width=320", "driver_camera.depth.height=240",
      "driver_camera.depth.fx=292.5",  "driver_camera.depth.fy=292.5",
      "driver_camera.depth.cx=160",    "driver_camera.depth.cy=120"};
  ReplayOptions options;
  options.log = path("theirs.lcmlog");
  options.output = path("theirs");
  testing::write_log(options.log, theirs);
  const ReplayResult result = replay(options, messaging::Config::load(std::nullopt, settings));
  EXPECT_EQ(result.report.map.features.size(), replay_events(ours).report.map.features.size());
}

TEST_F(Replay, NeverReplacesTheLogItReads) {
  ReplayOptions options;
  options.log = options.log_out = path("in.lcmlog");
  options.output = path("out");
  testing::write_log(options.log, testing::synthetic_log(2));
  const std::string before = read_file(options.log);
  EXPECT_THROW(replay(options, messaging::Config::load()), messaging::ConfigError);
  EXPECT_EQ(read_file(options.log), before);
}

TEST_F(Replay, ALogWithoutFramesOrWithoutAFileIsAClearError) {
  auto events = testing::synthetic_log(2);
  std::erase_if(events, [](const auto& event) { return event.channel == "RGBD_FRAME"; });
  try {
    replay_events(events);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("RGBD_FRAME"));
  }
  ReplayOptions options;
  options.log = path("missing.lcmlog");
  options.output = path("out");
  EXPECT_THROW(replay(options, messaging::Config::load()), std::runtime_error);
  for (int ReplayOptions::*number :
       {&ReplayOptions::threads, &ReplayOptions::passes, &ReplayOptions::pictures_every}) {
    ReplayOptions wrong;
    wrong.log = path("in.lcmlog");
    wrong.output = path("elsewhere");
    wrong.*number = -1;
    EXPECT_THROW(replay(wrong, messaging::Config::load()), messaging::ConfigError);
  }
  EXPECT_FALSE(fs::exists(path("elsewhere")));
}

TEST_F(Replay, TrajectoriesAreInTheFormatOfTheTumBenchmark) {
  Eigen::Isometry3d T(Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitZ()));
  T.translation() = Eigen::Vector3d(1, 2, 3);
  write_trajectory(path("t.tum"), {{1'000'000'033'333, T}});
  EXPECT_THAT(read_file(path("t.tum")),
              ::testing::HasSubstr("\n1000000.033333 1.000000000 2.000000000 3.000000000 "
                                   "0.000000000 0.000000000 0.707106781 0.707106781\n"));
}

TEST(PipelineConfig, TheDefaultFileHoldsTheDefaultsOfTheClassesAndNothingElse) {
  testing::ConfigChecks checks;
  checks.expect_defaults<messaging::CameraConfig>("driver_camera.depth");
  checks.expect_defaults<messaging::CameraConfig>("driver_camera.color");
  checks.expect_defaults<drivers::KinectConfig>("kinect");
  checks.expect_defaults<perception::PriorConfig>("prior");
  checks.expect_defaults<perception::KeyframeConfig>("keyframes");
  checks.expect_defaults<perception::RegistrationConfig>("registration");
  checks.expect_defaults<perception::DepthCorrectionConfig>("depth_correction");
  checks.expect_defaults<perception::PointMapConfig>("point_map");
  checks.expect_defaults<perception::ExtractorChoice>("extraction");
  checks.expect_defaults<perception::OrganizedExtractorConfig>("organized");
  checks.expect_defaults<perception::RansacExtractorConfig>("ransac");
  checks.expect_defaults<mapping::MergeConfig>("merge");
  checks.expect_defaults<mapping::HistoryConfig>("history");
  checks.expect_defaults<mapping::MapViewConfig>("mapper");
  EXPECT_THAT(checks.differences(), ::testing::IsEmpty());
  EXPECT_THAT(checks.unread_keys(), ::testing::IsEmpty());
}

TEST(StageTimes, PercentilesAreThoseOfTheNearestRank) {
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) values.push_back(i);
  const Summary s = summarize(values);
  EXPECT_DOUBLE_EQ(s.mean, 50.5);
  EXPECT_DOUBLE_EQ(s.p50, 50);
  EXPECT_DOUBLE_EQ(s.p95, 95);
  EXPECT_DOUBLE_EQ(s.max, 100);
  EXPECT_DOUBLE_EQ(summarize({}).max, 0);
}

}  // namespace
}  // namespace geomap::logs
