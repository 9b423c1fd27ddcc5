// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/log_source_client.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "geomap/health_t.hpp"
#include "mapping/edit_messages.hpp"
#include "mapping/map_journal.hpp"
#include "mapping/map_view_messages.hpp"
#include "mapping/scene.hpp"
#include "messaging/channels.hpp"
#include "messaging/log_writer.hpp"
#include "messaging/temporary_folder.hpp"
#include "viewer/example_messages.hpp"
#include "viewer/log_survey_client.hpp"
#include "viewer/open_file_client.hpp"

namespace geomap::viewer {
namespace {

namespace channels = messaging::channels;
using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr int kKeyframes = 20;  // one a second

/// What there is to compare of two scenes.
struct Look {
  Features features;
  std::size_t points = 0, keyframes = 0, poses = 0;
  std::int64_t frame = 0;
  bool operator==(const Look&) const = default;
};

class LogSourceTest : public testing::TemporaryFolder {
 protected:
  /// Key frames of a camera that passes a wall, with frames, poses, points and planes.
  void write_drive(messaging::LogWriter& log) {
    testing::Observer observer;
    observer.outline_noise = 0.02;
    for (int i = 1; i <= kKeyframes; ++i) {
      const std::int64_t utime = 1'000'000 * i;
      const Eigen::Isometry3d camera = testing::camera_at(i);
      log.write(channels::kRgbdFrame, utime, testing::frame_message(utime, i));
      log.write(channels::kCameraPose, utime, messaging::to_rigid_transform(utime, camera));
      log.write(channels::kKeyframe, utime,
                testing::keyframe_message(utime, geomap::keyframe_t::ACCEPTED));
      log.write(channels::kPointMap, utime, testing::point_update(1, i, i == 1, {{i, 10}}));
      const auto seen = testing::boards(std::min(4, 1 + i / 4));
      log.write(channels::kPlanes, utime,
                messaging::to_message(messaging::PlaneSet{
                    utime, 1, i - 1, camera, 1.0, observer.observe(utime, seen, camera)->planes}));
    }
  }
  std::string drive() {
    messaging::LogWriter log(path("drive.lcmlog"));
    write_drive(log);
    log.close();
    return path("drive.lcmlog");
  }
  /// Updates without time going by until no seek, step or survey is under way.
  void settle(MapSource& source, SceneModel& scene) {
    do {
      source.update(scene, now_);
    } while (source.playback()->progress() < 1.0);
    now_ += 1s;  // for what goes out after a pause
    source.playback()->play(false);
    source.update(scene, now_);
    source.update(scene, now_);
  }
  static Look look_of(const SceneModel& scene) {
    return {scene.map.features, scene.points.points, scene.track.keyframes.size(),
            scene.track.poses.size(), scene.frame.frame ? scene.frame.frame->utime : 0};
  }
  Look look_at_time(const std::string& log, const std::vector<double>& seeks) {
    const auto source = open_log(log);
    SceneModel scene;
    source->playback()->play(false);
    settle(*source, scene);
    for (const double seconds : seeks) {
      source->playback()->seek(seconds);
      settle(*source, scene);
      EXPECT_NEAR(source->playback()->position(), seconds, 1e-9);
    }
    return look_of(scene);
  }
  Clock::time_point now_ = Clock::now();
};

TEST_F(LogSourceTest, SeekingShowsWhatPlayingToThereDoes) {
  const std::string log = drive();
  const auto source = open_log(log);
  SceneModel scene;
  source->playback()->play(false);
  settle(*source, scene);
  EXPECT_NEAR(source->playback()->duration(), kKeyframes - 1, 1e-9);
  source->playback()->play(true);
  source->playback()->set_speed(4.0);
  source->update(scene, now_);
  while (source->playback()->position() < 12.4) source->update(scene, now_ += 25ms);
  source->playback()->play(false);
  now_ += 1s;
  source->update(scene, now_);
  const Look played = look_of(scene);
  EXPECT_EQ(played.keyframes, 13u);
  EXPECT_FALSE(played.features.empty());
  EXPECT_EQ(played, look_at_time(log, {12.5}));
}

TEST_F(LogSourceTest, ScrubbingBackShowsWhatWasThere) {
  const std::string log = drive();
  const Look early = look_at_time(log, {3.5}), late = look_at_time(log, {17.0});
  EXPECT_NE(early, late);
  EXPECT_EQ(look_at_time(log, {17.0, 3.5}), early);
  EXPECT_EQ(look_at_time(log, {17.0, 3.5, 2.0, 17.0}), late);
}

TEST_F(LogSourceTest, WhileItReadsBackTheOldSceneStays) {
  const auto source = open_log(drive());
  SceneModel scene;
  source->playback()->play(false);
  settle(*source, scene);
  source->playback()->seek(15.0);
  settle(*source, scene);
  const Stamp stamp = scene.map.stamp;
  source->playback()->seek(2.0);
  EXPECT_FALSE(scene.map.features.empty());
  settle(*source, scene);
  EXPECT_GT(scene.map.stamp, stamp);
  EXPECT_FALSE(scene.map.features.empty());
}

TEST_F(LogSourceTest, AStepGoesToTheNextKeyFrameAndPauses) {
  const auto source = open_log(drive());
  SceneModel scene;
  settle(*source, scene);
  const std::size_t before = scene.track.keyframes.size();
  for (std::size_t i = 1; i <= 3; ++i) {
    source->playback()->step();
    settle(*source, scene);
    EXPECT_EQ(scene.track.keyframes.size(), before + i);
    EXPECT_FALSE(source->playback()->is_playing());
  }
}

TEST_F(LogSourceTest, WithoutKeyFramesAStepIsOneEventOfTheCommonestChannel) {
  {
    messaging::LogWriter log(path("poses.lcmlog"));
    for (int i = 1; i <= 50; ++i) {
      const Eigen::Isometry3d camera(Eigen::Translation3d(0.1 * i, 0, 0));
      log.write(channels::kCameraPose, 1'000'000 * i,
                messaging::to_rigid_transform(1'000'000 * i, camera));
    }
    log.write(channels::kHealth, 51'000'000, geomap::health_t{});
    log.close();
  }
  const auto source = open_log(path("poses.lcmlog"));
  SceneModel scene;
  source->playback()->play(false);
  settle(*source, scene);
  for (std::size_t i = 1; i <= 3; ++i) {
    source->playback()->step();
    settle(*source, scene);
    EXPECT_EQ(scene.track.poses.size(), i);
  }
}

TEST_F(LogSourceTest, WhileItReadsBackAHalfReadMapIsNeitherSavedNorExported) {
  // Longer than one update can read, so that the seek is seen under way.
  messaging::LogWriter more(path("long.lcmlog"));
  write_drive(more);
  const geomap::rgbd_frame_t frame = testing::frame_message(21'000'000);
  for (int i = 0; i < 6'000; ++i) more.write(channels::kRgbdFrame, 21'000'000, frame);
  more.close();
  const auto slow = open_log(path("long.lcmlog"));
  SceneModel shown;
  slow->playback()->play(false);
  settle(*slow, shown);
  slow->playback()->seek(20.0);
  settle(*slow, shown);
  slow->playback()->seek(19.9);
  settle(*slow, shown);
  const std::size_t features = shown.map.features.size();
  slow->playback()->seek(18.5);
  slow->playback()->seek(20.0);
  slow->update(shown, now_);
  ASSERT_LT(slow->playback()->progress(), 1.0);
  EXPECT_TRUE(slow->has_more());
  slow->save(path("half.lcmlog"));
  const auto outcomes = slow->take_outcomes();
  ASSERT_THAT(outcomes, SizeIs(1));
  EXPECT_FALSE(outcomes[0].is_done);
  EXPECT_THAT(outcomes[0].text, HasSubstr("read back"));
  EXPECT_THROW(slow->exact_snapshot(shown), std::runtime_error);
  EXPECT_EQ(slow->snapshot(shown).features.size(), features);
  settle(*slow, shown);
  EXPECT_FALSE(slow->has_more());
  EXPECT_NO_THROW(slow->exact_snapshot(shown));
}

TEST_F(LogSourceTest, ALogThatHasGoneAwayEndsInAnOutcome) {
  const std::string log = drive();
  const auto source = open_log(log);
  SceneModel scene;
  source->playback()->play(false);
  settle(*source, scene);
  source->playback()->seek(15.0);
  settle(*source, scene);
  const Look before = look_of(scene);
  source->take_outcomes();
  std::filesystem::remove(log);
  source->playback()->play(true);
  source->playback()->seek(2.0);
  EXPECT_NO_THROW(source->update(scene, now_));
  const auto outcomes = source->take_outcomes();
  ASSERT_THAT(outcomes, SizeIs(1));
  EXPECT_FALSE(outcomes[0].is_done);
  EXPECT_THAT(outcomes[0].text, HasSubstr("drive.lcmlog"));
  EXPECT_FALSE(source->playback()->is_playing());
  EXPECT_EQ(source->playback()->progress(), 1.0);
  EXPECT_EQ(look_of(scene), before);
  source->update(scene, now_);
  EXPECT_THAT(source->take_outcomes(), IsEmpty());
}

TEST_F(LogSourceTest, PlayingEndsAtTheEndAndThenBeginsAgain) {
  const auto source = open_log(drive());
  SceneModel scene;
  settle(*source, scene);
  source->playback()->play(true);
  source->playback()->set_speed(100.0);
  source->update(scene, now_);
  for (int i = 0; i < 100 && source->playback()->is_playing(); ++i) {
    source->update(scene, now_ += 100ms);
  }
  EXPECT_FALSE(source->playback()->is_playing());
  EXPECT_EQ(source->playback()->position(), source->playback()->duration());
  source->playback()->play(true);
  settle(*source, scene);
  EXPECT_EQ(source->playback()->position(), 0.0);
}

TEST_F(LogSourceTest, PlanesWithoutAMapAreFoldedAndThatMapCanBeSaved) {
  const auto source = open_log(drive());
  SceneModel scene;
  settle(*source, scene);
  source->playback()->seek(100.0);
  settle(*source, scene);
  EXPECT_EQ(scene.map.features.size(), 4u);
  source->save(path("folded.lcmlog"));
  const auto outcomes = source->take_outcomes();
  ASSERT_THAT(outcomes, SizeIs(1));
  EXPECT_TRUE(outcomes[0].is_done) << outcomes[0].text;
  EXPECT_EQ(mapping::load_map(path("folded.lcmlog")).contents.features.size(), 4u);
  EXPECT_EQ(source->exact_snapshot(scene).features.size(), 4u);
}

TEST_F(LogSourceTest, TheLogsOwnEditsArePartOfTheFoldedMap) {
  {
    messaging::LogWriter log(path("edited.lcmlog"));
    write_drive(log);
    log.write(channels::kMapEdit, 21'000'000,
              mapping::to_message(mapping::EditCommand{.kind = mapping::EditKind::kDelete,
                                                       .author = "ann",
                                                       .command = 5,
                                                       .targets = {{1'000'000, 0}}}));
    log.close();
  }
  const auto source = open_log(path("edited.lcmlog"));
  SceneModel scene;
  settle(*source, scene);
  source->playback()->seek(100.0);
  settle(*source, scene);
  EXPECT_EQ(scene.map.features.size(), 3u);
  EXPECT_THAT(source->history(), SizeIs(1));
}

TEST_F(LogSourceTest, AMapInTheLogIsShownAsItIs) {
  {
    messaging::LogWriter log(path("live.lcmlog"));
    write_drive(log);
    for (const auto& part : mapping::to_messages(testing::wall_view(1, 1, 9))) {
      log.write(channels::kMapSnapshot, 20'500'000, part);
    }
    log.close();
  }
  const auto source = open_log(path("live.lcmlog"));
  SceneModel scene;
  settle(*source, scene);
  source->playback()->seek(19.0);
  settle(*source, scene);
  EXPECT_THAT(scene.map.features, IsEmpty());
  source->playback()->seek(20.0);
  settle(*source, scene);
  EXPECT_EQ(scene.map.features.size(), 9u);
  EXPECT_THROW(source->exact_snapshot(scene), std::runtime_error);
}

TEST_F(LogSourceTest, ALogWithoutAMapSaysWhatToDo) {
  {
    messaging::LogWriter log(path("raw.lcmlog"));
    log.write(channels::kRgbdFrame, 1, testing::frame_message(1));
    log.close();
  }
  const auto source = open_log(path("raw.lcmlog"));
  SceneModel scene;
  settle(*source, scene);
  EXPECT_THAT(source->title(), HasSubstr("holds no map"));
  const auto outcomes = source->take_outcomes();
  ASSERT_THAT(outcomes, SizeIs(1));
  EXPECT_THAT(outcomes[0].text, HasSubstr("geomap-replay"));
  source->edit({.command = 3});
  EXPECT_THAT(source->take_outcomes().at(0).text, HasSubstr("cannot be edited"));
}

TEST_F(LogSourceTest, AMapAndALogAreToldApartByWhatIsInThem) {
  mapping::save_map(path("map.lcmlog"), mapping::GeometricMap({}, {}));
  EXPECT_EQ(open_file(path("map.lcmlog"))->playback(), nullptr);
  EXPECT_NE(open_file(drive())->playback(), nullptr);
  EXPECT_THROW(open_file(path("missing")), std::runtime_error);
}

TEST(LogTime, NeverGoesBackAndLeavesGapsOut) {
  LogTime time;
  EXPECT_EQ(time.note(5'000'000), 0.0);
  EXPECT_EQ(time.note(6'000'000), 1.0);
  EXPECT_EQ(time.note(5'500'000), 1.0);
  EXPECT_EQ(time.note(6'500'000), 1.5);
  EXPECT_EQ(time.note(INT64_MAX), 1.5);
  EXPECT_EQ(time.note(INT64_MIN), 1.5);
  EXPECT_EQ(time.note(7'000'000), 1.5);
  EXPECT_EQ(time.note(8'000'000), 2.5);
}

}  // namespace
}  // namespace geomap::viewer
