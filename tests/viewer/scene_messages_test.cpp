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
  void give_record(const Record& record) {
    give(channels::kMapEditRecord, record);
    messages_.poll(now_, scene_);
  }
  void give_keyframe(std::int64_t session, std::int64_t utime, std::int32_t iterations) {
    give_pose(utime, 0.1 * static_cast<double>(utime));
    Keyframe keyframe = testing::keyframe_message(utime, Keyframe::ACCEPTED, 0.0, iterations);
    keyframe.session = session;
    give(channels::kKeyframe, keyframe);
  }
  void give_points(std::int64_t session, std::int64_t sequence, std::int64_t utime,
                   bool is_complete,
                   const std::vector<std::pair<std::int32_t, std::uint32_t>>& blocks) {
    auto update = testing::point_update(session, sequence, is_complete, blocks);
    update.utime = utime;
    give(channels::kPointMap, update);
  }
  std::ptrdiff_t asked_for(const char* channel) const {
    return std::count(asked_.begin(), asked_.end(), channel);
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
  wait(400ms);
  give(channels::kPointMap, testing::point_update(1, 5, false, {{2, 10}}));
  for (int i = 0; i < 4; ++i) wait(100ms);
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

TEST_F(SceneMessagesTest, FormerBlocksGoThoughUpdatesComeWithoutAPause) {
  give_points(1, 1, 100, true, {{0, 10}, {1, 10}});
  wait(1s);
  give_points(2, 1, 200, true, {{1, 20}});
  give_points(2, 2, 200, false, {{2, 20}});
  for (int i = 3; i < 8; ++i) {
    wait(250ms);
    give_points(2, i, 200 + i, false, {{2, 20}});
  }
  EXPECT_FALSE(scene_.points.blocks.contains({0, 0, 0}));
  EXPECT_EQ(scene_.points.points, 40u);
}

TEST_F(SceneMessagesTest, FormerBlocksStayUntilTheirSuccessorsHaveComeWhole) {
  give_points(1, 1, 100, true, {{0, 10}, {1, 10}});
  wait(1s);
  give_points(1, 2, 200, true, {{0, 20}});
  give_points(1, 4, 200, false, {{3, 20}});
  wait(1s);
  EXPECT_TRUE(scene_.points.blocks.contains({1, 0, 0}));
  give_points(1, 3, 200, false, {{2, 20}});
  wait(1s);
  EXPECT_FALSE(scene_.points.blocks.contains({1, 0, 0}));
  EXPECT_EQ(scene_.points.points, 60u);
}

TEST_F(SceneMessagesTest, UpdatesThatOvertookEachOtherAreNotAskedForAgain) {
  give_points(1, 1, 100, true, {});
  wait(1s);
  asked_.clear();
  give_points(1, 3, 200, false, {{0, 30}});
  wait(50ms);
  EXPECT_EQ(scene_.channels[channels::kPointMap].missing, 1);
  give_points(1, 2, 199, false, {{0, 7}, {1, 7}});
  for (int i = 0; i < 20; ++i) wait(100ms);
  EXPECT_EQ(asked_for(channels::kPointMap), 0);
  EXPECT_EQ(scene_.channels[channels::kPointMap].missing, 0);
  EXPECT_EQ(scene_.points.points, 37u);
}

TEST_F(SceneMessagesTest, ALossyLinkIsAskedForTheWholePointMapEverMoreSeldom) {
  std::mt19937 random(1);
  std::int64_t sequence = 0;
  std::ptrdiff_t answered = 0;
  for (int i = 0; i < 60 * 33; ++i) {
    wait(30ms);
    if (asked_for(channels::kPointMap) == answered) continue;
    ++answered;
    for (int part = 0; part < 200; ++part) {
      ++sequence;
      if (random() % 20 != 0) give_points(7, sequence, answered, part == 0, {{part, 1}});
    }
  }
  EXPECT_LE(answered, 8);
  EXPECT_GE(answered, 4);
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

TEST_F(SceneMessagesTest, ADroppedKeyFrameThatIsRemovedDoesNotComeBack) {
  give(channels::kKeyframe, testing::keyframe_message(1, Keyframe::ACCEPTED));
  geomap::keyframe_update_t dropped{}, removed{}, restored{};
  dropped.dropped = removed.removed = restored.restored = {1};
  dropped.n_dropped = removed.n_removed = restored.n_restored = 1;
  for (const auto& update : {dropped, removed, restored}) give(channels::kKeyframeUpdate, update);
  EXPECT_THAT(scene_.track.keyframes, IsEmpty());
}

TEST_F(SceneMessagesTest, ARegistrationThatBeginsAnewLeavesNothingOfItsFormerPath) {
  for (int i = 1; i <= 5; ++i) give_keyframe(1, i, i > 1 ? 4 : 0);
  ASSERT_EQ(scene_.track.keyframes.size(), 5u);
  give_keyframe(6, 6, 0);
  give_keyframe(6, 7, 4);
  EXPECT_EQ(scene_.track.keyframes.size(), 2u);
  EXPECT_EQ(scene_.track.keyframes.begin()->first, 6);
  ASSERT_EQ(scene_.track.poses.size(), 2u);
  EXPECT_EQ(scene_.track.poses.front().utime, 6);
}

TEST_F(SceneMessagesTest, ARegistrationThatGoesOnWithItsStateGoesOnHereToo) {
  for (int i = 1; i <= 5; ++i) give_keyframe(1, i, i > 1 ? 4 : 0);
  give_keyframe(6, 6, 4);
  EXPECT_EQ(scene_.track.keyframes.size(), 6u);
  EXPECT_EQ(scene_.track.poses.size(), 6u);
}

TEST_F(SceneMessagesTest, WhereNothingIsEverAlignedASessionIsOnePath) {
  for (int i = 1; i <= 5; ++i) give_keyframe(1, i, 0);
  EXPECT_EQ(scene_.track.keyframes.size(), 5u);
  give_keyframe(6, 6, 0);
  EXPECT_EQ(scene_.track.keyframes.size(), 1u);
}

TEST_F(SceneMessagesTest, AnEmptyPointMapEndsThePathAtOnce) {
  for (int i = 1; i <= 5; ++i) give_keyframe(1, i, i > 1 ? 4 : 0);
  give_points(1, 1, 5, true, {{0, 10}});
  EXPECT_EQ(scene_.track.keyframes.size(), 5u);
  give_points(1, 2, 5, true, {});
  EXPECT_THAT(scene_.track.keyframes, IsEmpty());
  EXPECT_THAT(scene_.track.poses, IsEmpty());
}

TEST_F(SceneMessagesTest, OneStrayPoseWithAnEarlyTimeLeavesThePathAlone) {
  for (int i = 100; i < 120; ++i) give_pose(i, i);
  give_pose(3, 0.0);
  EXPECT_EQ(scene_.track.poses.size(), 20u);
  EXPECT_EQ(scene_.track.newest->utime, 119);
  give_pose(120, 120.0);
  EXPECT_EQ(scene_.track.poses.size(), 21u);
  for (int i = 3; i < 13; ++i) give_pose(i, i);
  EXPECT_EQ(scene_.track.poses.size(), 10u);
  EXPECT_EQ(scene_.track.newest->utime, 12);
}

TEST_F(SceneMessagesTest, OfTheCamerasPathOnlyMotionIsKeptAndTheNewestPoseAlways) {
  for (int i = 0; i < 100; ++i) give_pose(i, 0.001 * i);
  EXPECT_EQ(scene_.track.poses.size(), 10u);
  EXPECT_EQ(scene_.track.newest->utime, 99);
}

TEST_F(SceneMessagesTest, AFrameOfWhichItIsNotKnownWhereItWasTakenLeavesTheCloudAlone) {
  give(channels::kRgbdFrame, testing::frame_message(1'000'000));
  EXPECT_EQ(scene_.frame.newest, nullptr);
  EXPECT_TRUE(messages_.show_newest_frame(scene_));
  EXPECT_EQ(scene_.frame.newest->utime, 1'000'000);
  EXPECT_FALSE(scene_.frame.newest->color.empty());
  EXPECT_EQ(scene_.frame.frame, nullptr);
  give_pose(1'000'000, 3.0);
  EXPECT_TRUE(messages_.show_newest_frame(scene_));
  ASSERT_TRUE(scene_.frame.frame);
  EXPECT_EQ(scene_.frame.T_world_camera->translation().x(), 3.0);
  give(channels::kRgbdFrame, testing::frame_message(1'033'000));
  give(channels::kRgbdFrame, testing::frame_message(1'066'000));
  EXPECT_TRUE(messages_.show_newest_frame(scene_));
  EXPECT_EQ(scene_.frame.newest->utime, 1'066'000);
  EXPECT_EQ(scene_.frame.frame->utime, 1'000'000);
  EXPECT_EQ(scene_.frame.T_world_camera->translation().x(), 3.0);
  give_pose(1'033'000, 4.0);
  EXPECT_TRUE(messages_.show_newest_frame(scene_));
  EXPECT_EQ(scene_.frame.frame->utime, 1'033'000);
  EXPECT_EQ(scene_.frame.T_world_camera->translation().x(), 4.0);
  EXPECT_FALSE(messages_.show_newest_frame(scene_));
}

TEST_F(SceneMessagesTest, AFrameBetweenTwoPosesIsPlacedBetweenThemWhenBothAreNear) {
  give(channels::kRgbdFrame, testing::frame_message(1'040'000));
  give_pose(1'000'000, 3.0);
  messages_.show_newest_frame(scene_);
  EXPECT_FALSE(scene_.frame.T_world_camera);
  give_pose(1'080'000, 4.0);
  messages_.show_newest_frame(scene_);
  ASSERT_TRUE(scene_.frame.T_world_camera);
  EXPECT_NEAR(scene_.frame.T_world_camera->translation().x(), 3.5, 1e-9);
  give(channels::kRgbdFrame, testing::frame_message(1'120'000));
  give_pose(1'300'000, 5.0);
  messages_.show_newest_frame(scene_);
  EXPECT_EQ(scene_.frame.frame->utime, 1'040'000);
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

TEST_F(SceneMessagesTest, PlanesThatNobodyCanDrawAreRefused) {
  const auto is_taken = [&](const std::function<void(geomap::plane_t&)>& spoil) {
    auto message = planes();
    spoil(message.planes[1]);
    return give(channels::kPlanes, message);
  };
  EXPECT_TRUE(is_taken([](geomap::plane_t&) {}));
  const Stamp stamp = scene_.planes.stamp;
  EXPECT_FALSE(is_taken([](geomap::plane_t& plane) { plane.frame.origin[0] = 1e300; }));
  EXPECT_FALSE(is_taken([](geomap::plane_t& plane) { plane.frame.origin[0] = 2e5; }));
  EXPECT_FALSE(is_taken([](geomap::plane_t& plane) { plane.d = 1e5; }));
  EXPECT_FALSE(is_taken([](geomap::plane_t& plane) { plane.normal[0] += 3.0; }));
  EXPECT_FALSE(is_taken([](geomap::plane_t& plane) { plane.frame.x_axis[0] *= 5.0; }));
  auto message = planes();
  message.T_world_camera.translation[0] = 2e5;
  EXPECT_FALSE(give(channels::kPlanes, message));
  EXPECT_EQ(scene_.planes.stamp, stamp);
}

TEST_F(SceneMessagesTest, PosesAndVetoesBeyondTheEndOfTheWorldAreRefused) {
  give_pose(1, 2e5);
  EXPECT_FALSE(scene_.track.newest);
  give(channels::kKeyframe, testing::keyframe_message(1, Keyframe::ACCEPTED, 2e5));
  EXPECT_THAT(scene_.track.keyframes, IsEmpty());
  Record record = testing::record_message(1, 1, 1);
  record.vetoes[0].frame.origin[0] = 2e5;
  give_record(record);
  EXPECT_THAT(scene_.map.vetoes, IsEmpty());
}

TEST_F(SceneMessagesTest, ACameraThatCannotBeIsNotDrawn) {
  Keyframe keyframe = testing::keyframe_message(1, Keyframe::ACCEPTED);
  keyframe.frame.depth_camera.fx = 1e-200;
  give(channels::kKeyframe, keyframe);
  EXPECT_FALSE(scene_.track.camera);
  messages_.show_newest_frame(scene_);
  ASSERT_TRUE(scene_.frame.frame);
  EXPECT_FALSE(scene_.frame.frame->depth_camera.valid());
}

TEST_F(SceneMessagesTest, AHistoryOfThousandsIsPutTogetherOnce) {
  constexpr int kRecords = 4000;
  const auto began = Clock::now();
  for (int i = 1; i <= kRecords; ++i) {
    Record record = testing::record_message(1, i, kRecords);
    give(channels::kMapEditRecord, record);
  }
  const Stamp stamp = scene_.map.veto_stamp;
  EXPECT_THAT(messages_.history(), IsEmpty());
  EXPECT_TRUE(messages_.poll(now_, scene_));
  EXPECT_EQ(messages_.history().size(), std::size_t{kRecords});
  EXPECT_EQ(scene_.map.vetoes.size(), std::size_t{kRecords});
  EXPECT_EQ(scene_.map.veto_stamp, stamp + 1);
  EXPECT_LT(Clock::now() - began, 3s);
}

TEST_F(SceneMessagesTest, AChangeOfTheMapIsNoneOfTheVetoes) {
  give_record(testing::record_message(1, 1, 1));
  const Stamp stamp = scene_.map.veto_stamp;
  EXPECT_GT(stamp, 0u);
  give_view(testing::wall_view(1, 2, 5));
  EXPECT_EQ(scene_.map.features.size(), 5u);
  EXPECT_EQ(scene_.map.veto_stamp, stamp);
}

TEST_F(SceneMessagesTest, WhereNothingComesTheMapIsNotTakenAgain) {
  give_view(testing::wall_view(1, 2, 5));
  give_record(testing::record_message(1, 0, 0));
  scene_.map.features.clear();
  EXPECT_FALSE(messages_.poll(now_, scene_));
  EXPECT_THAT(scene_.map.features, IsEmpty());
  give_view(testing::wall_view(1, 3, 6));
  EXPECT_EQ(scene_.map.features.size(), 6u);
}

TEST_F(SceneMessagesTest, TheHistoryTellsWhatIsDoneAndWhatKeepsOut) {
  give_record(testing::record_message(1, 2, 2, Record::UNDONE));
  give_record(testing::record_message(1, 1, 2));
  ASSERT_EQ(messages_.history().size(), 2u);
  EXPECT_EQ(messages_.history()[0].state, HistoryEntry::State::kDone);
  EXPECT_TRUE(messages_.history()[0].keeps_out);
  EXPECT_EQ(messages_.history()[1].state, HistoryEntry::State::kUndone);
  EXPECT_FALSE(messages_.history()[1].keeps_out);
  ASSERT_EQ(scene_.map.vetoes.size(), 1u);
  EXPECT_EQ(scene_.map.vetoes[0].edit, 1);
}

TEST_F(SceneMessagesTest, AnotherMappersHistoryIsShownOnlyWhenItIsWhole) {
  give_record(testing::record_message(1, 1, 1));
  give_record(testing::record_message(2, 4, 2));
  EXPECT_EQ(messages_.history()[0].number, 1);
  give_record(testing::record_message(2, 5, 2));
  ASSERT_EQ(messages_.history().size(), 2u);
  EXPECT_EQ(messages_.history()[0].number, 4);
}

TEST_F(SceneMessagesTest, AResetEmptiesTheHistory) {
  give_record(testing::record_message(1, 1, 1));
  give_record(testing::record_message(1, 0, 0));
  EXPECT_THAT(messages_.history(), IsEmpty());
  EXPECT_THAT(scene_.map.vetoes, IsEmpty());
}

TEST_F(SceneMessagesTest, AShorterHistoryIsCollectedAnew) {
  for (int i = 1; i <= 3; ++i) {
    give_record(testing::record_message(1, i, 3));
  }
  give_record(testing::record_message(1, 2, 2));
  EXPECT_EQ(messages_.history().size(), 3u);
  give_record(testing::record_message(1, 3, 2));
  ASSERT_EQ(messages_.history().size(), 2u);
  EXPECT_EQ(messages_.history()[0].number, 2);
}

TEST_F(SceneMessagesTest, TextOfTheBusIsCleanedBeforePeopleSeeIt) {
  Record record = testing::record_message(1, 1, 1);
  record.text = "delete\n\x1b[31m \xff";
  give_record(record);
  EXPECT_EQ(messages_.history()[0].text, "delete  [31m \xEF\xBF\xBD");
  mapping::MapView view = testing::wall_view(1, 1, 1);
  view.features.begin()->second.label = "door\n\x1b[31m";
  give_view(view);
  EXPECT_EQ(scene_.map.features.begin()->second.label, "door  [31m");
  EXPECT_TRUE(scene_.map.is_current);
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

TEST_F(SceneMessagesTest, WhatWentMissingOrWasRefusedIsToldForAMinute) {
  const ChannelState& channel = scene_.channels[channels::kRgbdFrame];
  give(channels::kRgbdFrame, testing::frame_message(1, 1));
  give(channels::kRgbdFrame, testing::frame_message(2, 9));
  messages_.take(channels::kRgbdFrame, {}, now_, scene_);
  for (int i = 0; i < 50; ++i) wait(1s);
  EXPECT_EQ(channel.recent_missing, 7);
  EXPECT_EQ(channel.recent_refused, 1);
  give(channels::kRgbdFrame, testing::frame_message(3, 12));
  for (int i = 0; i < 20; ++i) wait(1s);
  EXPECT_EQ(channel.recent_missing, 2);
  EXPECT_EQ(channel.recent_refused, 0);
  EXPECT_EQ(channel.missing, 9);
  EXPECT_EQ(channel.refused, 1);
}

TEST_F(SceneMessagesTest, AProcessThatHasBeenSilentForTenMinutesIsForgotten) {
  give_health("geomap-mapper", 1, 1);
  give_health("geomap-planes", 1, 1);
  wait(20min);  // in which nothing at all is heard
  EXPECT_EQ(scene_.processes.size(), 2u);
  give_health("geomap-mapper", 1, 2);
  wait(1s);
  EXPECT_FALSE(scene_.processes.contains("geomap-planes"));
  EXPECT_TRUE(scene_.processes.contains("geomap-mapper"));
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
