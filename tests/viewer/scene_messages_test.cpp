// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene_messages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "geomap/keyframe_update_t.hpp"
#include "mapping/map_view_messages.hpp"
#include "mapping/scene.hpp"
#include "messaging/channels.hpp"
#include "messaging/encode.hpp"
#include "messaging/message_schema.hpp"
#include "messaging/random_message.hpp"
#include "viewer/example_messages.hpp"

namespace geomap::viewer {
namespace {

namespace channels = messaging::channels;
using namespace std::chrono_literals;
using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;
using Keyframe = geomap::keyframe_t;
using Record = geomap::map_edit_record_t;

class SceneMessagesTest : public ::testing::Test {
 protected:
  template <class Message>
  bool give(const char* channel, const Message& message) {
    const std::vector<std::uint8_t> bytes = messaging::encode(message);
    return messages_.take(channel, bytes, now_, scene_);
  }
  void give_view(const mapping::MapView& view) {
    for (const auto& part : mapping::to_messages(view)) give(channels::kMapSnapshot, part);
  }
  void give_pose(std::int64_t utime, double x) {
    give(channels::kCameraPose,
         messaging::to_rigid_transform(utime, Eigen::Isometry3d(Eigen::Translation3d(x, 0, 0))));
  }
  void give_health(const std::string& process, std::int64_t started, std::int64_t count) {
    geomap::health_t health{};
    health.process = process;
    health.started = started;
    health.counters = {{"frames", count}};
    health.n_counters = 1;
    give(channels::kHealth, health);
  }
  geomap::plane_set_t planes() {
    testing::Observer observer;
    const auto seen = observer.observe(7, testing::small_room(), camera_);
    return messaging::to_message(messaging::PlaneSet{7, 1, 0, camera_, 1.0, seen->planes});
  }
  void wait(std::chrono::milliseconds duration) {
    now_ += duration;
    messages_.poll(now_, scene_);
  }
  /// One sound message of every channel.
  void give_all() {
    give_view(testing::wall_view(1, 1, 3));
    give(channels::kMapEditRecord, testing::record_message(1, 1, 1));
    give(channels::kPointMap, testing::point_update(1, 1, true, {{0, 10}, {1, 10}}));
    give(channels::kKeyframe, testing::keyframe_message(5, Keyframe::ACCEPTED));
    give_pose(5, 0.0);
    give(channels::kPlanes, planes());
    give(channels::kRgbdFrame, testing::frame_message(6));
    give_health("geomap-mapper", 1, 1);
    messages_.poll(now_, scene_);
    messages_.show_newest_frame(scene_);
  }
  std::vector<Stamp> stamps() const {
    return {scene_.map.stamp, scene_.points.stamp, scene_.frame.stamp, scene_.planes.stamp,
            scene_.track.stamp};
  }

  const Eigen::Isometry3d camera_ = testing::look_at({0, -1.5, 1.4}, {-0.4, 1.0, 0.6});
  std::vector<std::string> asked_;
  SceneModel scene_;
  SceneMessages messages_{[this](const char* channel) { asked_.emplace_back(channel); }};
  Clock::time_point now_ = Clock::time_point{} + 1000s;
};

TEST_F(SceneMessagesTest, AnotherMappersMapIsShownOnlyWhenItIsWhole) {
  give_view(testing::wall_view(1, 4, 40));
  ASSERT_EQ(scene_.map.features.size(), 40u);
  EXPECT_TRUE(scene_.map.is_current);
  const auto parts = mapping::to_messages(testing::wall_view(2, 1, 60));
  ASSERT_GT(parts.size(), 1u);
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) give(channels::kMapSnapshot, parts[i]);
  EXPECT_EQ(scene_.map.features.size(), 40u);
  EXPECT_EQ(scene_.map.epoch, 1);
  EXPECT_FALSE(scene_.map.is_current);
  EXPECT_TRUE(give(channels::kMapSnapshot, parts.back()));
  EXPECT_EQ(scene_.map.features.size(), 60u);
  EXPECT_EQ(scene_.map.epoch, 2);
}

TEST_F(SceneMessagesTest, WhoIsStartedLastAsksForEverything) {
  messages_.poll(now_, scene_);
  EXPECT_THAT(asked_, Contains(channels::kMapSnapshot));
  EXPECT_THAT(asked_, Contains(channels::kPointMap));
  give_view(testing::wall_view(1, 4, 4));
  messages_.poll(now_, scene_);
  EXPECT_THAT(asked_, Contains(channels::kMapEditRecord));
  give(channels::kMapEditRecord, testing::record_message(1, 0, 0));
  give(channels::kPointMap, testing::point_update(1, 1, true, {}));
  asked_.clear();
  wait(5s);
  EXPECT_THAT(asked_, IsEmpty());
}

TEST_F(SceneMessagesTest, ARestartedMapperIsAskedForMapAndHistory) {
  give_all();
  give_health("geomap-mapper", 1, 2);
  wait(2s);
  asked_.clear();
  give_health("geomap-mapper", 2, 0);
  EXPECT_THAT(asked_, Contains(channels::kMapSnapshot));
  EXPECT_THAT(asked_, Contains(channels::kMapEditRecord));
  EXPECT_EQ(scene_.processes.at("geomap-mapper").counters.at("frames"), 0);
}

TEST_F(SceneMessagesTest, ARestartedRegistrationIsAskedForThePointMapOnceASecond) {
  give_all();
  give_health("geomap-register", 1, 2);
  wait(2s);
  give(channels::kPointMap, testing::point_update(1, 2, true, {{0, 10}}));
  asked_.clear();
  wait(2s);
  EXPECT_THAT(asked_, Not(Contains(channels::kPointMap)));
  give_health("geomap-register", 2, 0);
  for (int i = 0; i < 9; ++i) wait(100ms);
  EXPECT_EQ(std::count(asked_.begin(), asked_.end(), channels::kPointMap), 1);
}

TEST_F(SceneMessagesTest, NoLayerChangesByAnothersMessages) {
  give_all();
  const std::vector<std::function<void()>> gives = {
      [&] { give_view(testing::wall_view(1, 9, 5)); },
      [&] {
        give(channels::kPointMap, testing::point_update(1, 2, true, {{3, 10}}));
      },
      [&] {
        give(channels::kRgbdFrame, testing::frame_message(9));
        messages_.show_newest_frame(scene_);
      },
      [&] { give(channels::kPlanes, planes()); }, [&] { give_pose(9, 1.0); }};
  for (std::size_t layer = 0; layer < gives.size(); ++layer) {
    std::vector<Stamp> expected = stamps();
    gives[layer]();
    const std::vector<Stamp> found = stamps();
    EXPECT_GT(found[layer], expected[layer]);
    expected[layer] = found[layer];
    EXPECT_EQ(found, expected) << layer;
  }
}

TEST_F(SceneMessagesTest, AGapInThePointMapIsCountedAndAskedFor) {
  give(channels::kPointMap, testing::point_update(1, 1, true, {{0, 10}}));
  give(channels::kPointMap, testing::point_update(1, 2, false, {{1, 10}}));
  messages_.poll(now_, scene_);
  EXPECT_THAT(asked_, Not(Contains(channels::kPointMap)));
  give(channels::kPointMap, testing::point_update(1, 5, false, {{2, 10}}));
  messages_.poll(now_, scene_);
  EXPECT_THAT(asked_, Contains(channels::kPointMap));
  EXPECT_EQ(scene_.channels[channels::kPointMap].missing, 2);
  EXPECT_EQ(scene_.points.points, 30u);
}

TEST_F(SceneMessagesTest, AWholePointMapTakesThePlaceOfTheFormerOneWithoutFlicker) {
  give(channels::kPointMap, testing::point_update(1, 1, true, {{0, 10}, {1, 10}}));
  give(channels::kPointMap, testing::point_update(2, 1, true, {{1, 20}}));
  EXPECT_EQ(scene_.points.blocks.size(), 2u);
  give(channels::kPointMap, testing::point_update(2, 2, false, {{2, 5}}));
  wait(1s);
  EXPECT_FALSE(scene_.points.blocks.contains({0, 0, 0}));
  EXPECT_EQ(scene_.points.points, 25u);
}

TEST_F(SceneMessagesTest, AnUpdateThatComesLateDoesNotOverwriteANewerOne) {
  give(channels::kPointMap, testing::point_update(1, 1, true, {}));
  give(channels::kPointMap, testing::point_update(1, 3, false, {{0, 30}}));
  give(channels::kPointMap, testing::point_update(1, 2, false, {{0, 7}}));
  EXPECT_EQ(scene_.points.points, 30u);
}

TEST_F(SceneMessagesTest, AnyFirstPointsOfABlockAreAnEvenSample) {
  give(channels::kPointMap, testing::point_update(1, 1, true, {{0, 400}}));
  const auto& points = *scene_.points.blocks.at({0, 0, 0}).points;
  ASSERT_EQ(points.size(), 400u);
  for (const std::size_t some : {40u, 100u, 200u}) {
    const auto in_left_half =
        std::count_if(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(some),
                      [](const ScenePoint& point) { return point.position.x() < 0.25F; });
    EXPECT_NEAR(static_cast<double>(in_left_half) / static_cast<double>(some), 0.5, 0.17) << some;
  }
}

TEST_F(SceneMessagesTest, RegistrationIsToldInPlainWords) {
  give(channels::kKeyframe, testing::keyframe_message(1, Keyframe::ACCEPTED));
  EXPECT_EQ(scene_.registration.text, "ok");
  give(channels::kKeyframe, testing::keyframe_message(2, Keyframe::OVERLAP_TOO_SMALL));
  EXPECT_EQ(scene_.registration.text, "rejected: too little overlap with the map (0.21)");
  EXPECT_EQ(scene_.registration.level, Level::kDegraded);
  give(channels::kKeyframe, testing::keyframe_message(3, Keyframe::SEEN_THROUGH));
  give(channels::kKeyframe, testing::keyframe_message(4, Keyframe::NO_PRIOR));
  EXPECT_THAT(scene_.registration.text, StartsWith("lost: 3 key frames in a row"));
  EXPECT_EQ(scene_.registration.level, Level::kFailing);
  give(channels::kKeyframe, testing::keyframe_message(5, Keyframe::ACCEPTED));
  EXPECT_EQ(scene_.registration.level, Level::kGood);
  EXPECT_EQ(scene_.track.keyframes.size(), 2u);
}

TEST_F(SceneMessagesTest, EveryStatusHasWordsOfItsOwnAndAnUnknownOneIsRefused) {
  std::set<std::string> texts;
  for (std::int8_t status = 0; status <= Keyframe::UNDERCONSTRAINED; ++status) {
    scene_.registration = {};
    give(channels::kKeyframe, testing::keyframe_message(status, status));
    texts.insert(scene_.registration.text);
  }
  EXPECT_EQ(texts.size(), 9u);
  give(channels::kKeyframe, testing::keyframe_message(20, 9));
  EXPECT_EQ(scene_.channels[channels::kKeyframe].refused, 1);
}

TEST_F(SceneMessagesTest, KeyFramesMoveGoAndComeBackAsRegistrationSays) {
  for (int i = 1; i <= 3; ++i) {
    give(channels::kKeyframe, testing::keyframe_message(i, Keyframe::ACCEPTED, i));
  }
  geomap::keyframe_update_t update{};
  update.corrections = {
      {2, messaging::to_message(Eigen::Isometry3d(Eigen::Translation3d(9, 0, 0)))}};
  update.n_corrections = 1;
  update.removed = {1};
  update.n_removed = 1;
  update.dropped = {3};
  update.n_dropped = 1;
  give(channels::kKeyframeUpdate, update);
  ASSERT_EQ(scene_.track.keyframes.size(), 1u);
  EXPECT_EQ(scene_.track.keyframes.at(2).translation().x(), 9.0);
  geomap::keyframe_update_t restored{};
  restored.restored = {3};
  restored.n_restored = 1;
  give(channels::kKeyframeUpdate, restored);
  EXPECT_EQ(scene_.track.keyframes.at(3).translation().x(), 3.0);
}

TEST_F(SceneMessagesTest, OfTheCamerasPathOnlyMotionIsKeptAndTheNewestPoseAlways) {
  for (int i = 0; i < 100; ++i) give_pose(i, 0.001 * i);
  EXPECT_EQ(scene_.track.poses.size(), 10u);
  EXPECT_EQ(scene_.track.newest->utime, 99);
}

TEST_F(SceneMessagesTest, AFrameIsPlacedByTheNewestPoseOnlyWhenThatIsNearInTime) {
  give_pose(1'000'000, 3.0);
  give(channels::kRgbdFrame, testing::frame_message(1'090'000));
  EXPECT_EQ(scene_.frame.frame, nullptr);
  EXPECT_TRUE(messages_.show_newest_frame(scene_));
  ASSERT_TRUE(scene_.frame.T_world_camera);
  EXPECT_EQ(scene_.frame.T_world_camera->translation().x(), 3.0);
  EXPECT_FALSE(scene_.frame.frame->color.empty());
  give_pose(1'090'000, 4.0);
  EXPECT_TRUE(messages_.show_newest_frame(scene_));
  EXPECT_EQ(scene_.frame.T_world_camera->translation().x(), 4.0);
  give(channels::kRgbdFrame, testing::frame_message(1'200'000));
  messages_.show_newest_frame(scene_);
  EXPECT_FALSE(scene_.frame.T_world_camera);
}

TEST_F(SceneMessagesTest, FramesThatTheReceiverLeftOutAreNotMissing) {
  give(channels::kRgbdFrame, testing::frame_message(1, 1));
  give(channels::kRgbdFrame, testing::frame_message(2, 9));
  EXPECT_EQ(scene_.channels[channels::kRgbdFrame].missing, 7);
  messages_.note_left_out(channels::kRgbdFrame, 5, scene_);
  EXPECT_EQ(scene_.channels[channels::kRgbdFrame].missing, 2);
}

TEST_F(SceneMessagesTest, PlanesAreShownInTheWorld) {
  EXPECT_TRUE(give(channels::kPlanes, planes()));
  ASSERT_EQ(scene_.planes.planes.size(), testing::small_room().size());
  for (std::size_t i = 0; i < scene_.planes.planes.size(); ++i) {
    const testing::Rectangle wall = testing::small_room()[i];
    EXPECT_NEAR(scene_.planes.planes[i].plane.signed_distance(wall.center), 0.0, 1e-9);
  }
}

TEST_F(SceneMessagesTest, TheHistoryTellsWhatIsDoneAndWhatKeepsOut) {
  give(channels::kMapEditRecord, testing::record_message(1, 2, 2, Record::UNDONE));
  give(channels::kMapEditRecord, testing::record_message(1, 1, 2));
  ASSERT_EQ(messages_.history().size(), 2u);
  EXPECT_EQ(messages_.history()[0].state, HistoryEntry::State::kDone);
  EXPECT_TRUE(messages_.history()[0].keeps_out);
  EXPECT_EQ(messages_.history()[1].state, HistoryEntry::State::kUndone);
  EXPECT_FALSE(messages_.history()[1].keeps_out);
  ASSERT_EQ(scene_.map.vetoes.size(), 1u);
  EXPECT_EQ(scene_.map.vetoes[0].edit, 1);
}

TEST_F(SceneMessagesTest, AnotherMappersHistoryIsShownOnlyWhenItIsWhole) {
  give(channels::kMapEditRecord, testing::record_message(1, 1, 1));
  give(channels::kMapEditRecord, testing::record_message(2, 4, 2));
  EXPECT_EQ(messages_.history()[0].number, 1);
  give(channels::kMapEditRecord, testing::record_message(2, 5, 2));
  ASSERT_EQ(messages_.history().size(), 2u);
  EXPECT_EQ(messages_.history()[0].number, 4);
}

TEST_F(SceneMessagesTest, AResetEmptiesTheHistory) {
  give(channels::kMapEditRecord, testing::record_message(1, 1, 1));
  give(channels::kMapEditRecord, testing::record_message(1, 0, 0));
  EXPECT_THAT(messages_.history(), IsEmpty());
  EXPECT_THAT(scene_.map.vetoes, IsEmpty());
}

TEST_F(SceneMessagesTest, AShorterHistoryIsCollectedAnew) {
  for (int i = 1; i <= 3; ++i) {
    give(channels::kMapEditRecord, testing::record_message(1, i, 3));
  }
  give(channels::kMapEditRecord, testing::record_message(1, 2, 2));
  EXPECT_EQ(messages_.history().size(), 3u);
  give(channels::kMapEditRecord, testing::record_message(1, 3, 2));
  ASSERT_EQ(messages_.history().size(), 2u);
  EXPECT_EQ(messages_.history()[0].number, 2);
}

TEST_F(SceneMessagesTest, TextOfTheBusIsCleanedBeforePeopleSeeIt) {
  Record record = testing::record_message(1, 1, 1);
  record.text = "delete\n\x1b[31m \xff";
  give(channels::kMapEditRecord, record);
  EXPECT_EQ(messages_.history()[0].text, "delete  [31m \xEF\xBF\xBD");
  give_health("geomap\n-mapper", 1, 1);
  EXPECT_TRUE(scene_.processes.contains("geomap -mapper"));
}

TEST_F(SceneMessagesTest, RatesAreThoseOfTheLastSeconds) {
  for (int i = 0; i < 40; ++i) {
    give_pose(i, 0.0);
    wait(100ms);
  }
  EXPECT_NEAR(scene_.channels[channels::kCameraPose].rate, 10.0, 0.6);
  wait(10s);
  EXPECT_EQ(scene_.channels[channels::kCameraPose].rate, 0.0);
}

TEST_F(SceneMessagesTest, HostileBytesAreRefusedAndLeaveTheSceneAlone) {
  give_all();
  std::mt19937 random(5);
  const auto before = stamps();
  for (const std::string& channel : messages_.channels()) {
    for (int size = 0; size < 200; ++size) {
      std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
      for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
      EXPECT_FALSE(messages_.take(channel, bytes, now_, scene_));
    }
    EXPECT_EQ(scene_.channels[channel].refused, 200) << channel;
  }
  EXPECT_FALSE(messages_.take("NOBODY_KNOWS", {}, now_, scene_));
  EXPECT_EQ(stamps(), before);
}

TEST_F(SceneMessagesTest, MessagesThatAreCutOrHaveBadNumbersNeverThrow) {
  const std::map<std::string, std::string> types = {
      {channels::kMapDelta, "geomap.map_delta_t"},
      {channels::kMapSnapshot, "geomap.map_t"},
      {channels::kMapEditRecord, "geomap.map_edit_record_t"},
      {channels::kMapEditReply, "geomap.map_edit_reply_t"},
      {channels::kPointMap, "geomap.point_map_update_t"},
      {channels::kKeyframe, "geomap.keyframe_t"},
      {channels::kKeyframeUpdate, "geomap.keyframe_update_t"},
      {channels::kCameraPose, "bot_core.rigid_transform_t"},
      {channels::kCameraToBody, "bot_core.rigid_transform_t"},
      {channels::kRgbdFrame, "geomap.rgbd_frame_t"},
      {channels::kPlanes, "geomap.plane_set_t"},
      {channels::kHealth, "geomap.health_t"}};
  ASSERT_EQ(types.size(), messages_.channels().size());
  const auto& schemas = messaging::known_schemas().all();
  std::mt19937 random(6);
  for (const auto& [channel, type] : types) {
    for (int i = 0; i < 300; ++i) {
      auto message = testing::random_message(schemas.at(type), random, i % 2 == 0);
      EXPECT_NO_THROW(messages_.take(channel, message.bytes, now_, scene_));
      auto bad = message.bytes;
      for (const auto& place : message.counts) {
        if (random() % 2 == 0)
          testing::write_number(bad, place, random() % 2 == 0 ? 0x7fffffff : ~0U);
      }
      EXPECT_NO_THROW(messages_.take(channel, bad, now_, scene_));
      bad = message.bytes;
      for (const auto& place : message.doubles) {
        testing::write_number(bad, place, 0x7ff8000000000000U);
      }
      EXPECT_NO_THROW(messages_.take(channel, bad, now_, scene_));
      if (i > 0) continue;
      for (std::size_t size = 0; size < message.bytes.size(); ++size) {
        EXPECT_FALSE(messages_.take(channel, {message.bytes.data(), size}, now_, scene_));
      }
    }
    messages_.poll(now_, scene_);
    messages_.show_newest_frame(scene_);
  }
  EXPECT_TRUE(scene_.bounds().isEmpty() || scene_.bounds().sizes().allFinite());
}

}  // namespace
}  // namespace geomap::viewer
