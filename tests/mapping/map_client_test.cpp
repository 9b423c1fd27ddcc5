// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map_client.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <variant>

#include "mapping/map_view_messages.hpp"
#include "mapping/scene.hpp"
#include "messaging/message_schema.hpp"
#include "messaging/random_message.hpp"
#include "messaging/safe_decode.hpp"

namespace geomap::mapping {
namespace {

using namespace std::chrono_literals;
using Time = MapClient::Clock::time_point;
using Message = std::variant<geomap::map_delta_t, geomap::map_t>;

/// Boards on a wall, four rows of fifteen with gaps between, and others that bridge the gaps.
testing::Rectangle random_board(std::mt19937& random) {
  const auto place = static_cast<double>(random() % 15);
  const auto row = static_cast<double>(random() % 4);
  const double bridge = random() % 4 == 0 ? 0.35 : 0.0;
  testing::Rectangle board;
  board.center = {0.7 * (place - 7.0) + bridge, 3.0, 0.4 + 0.7 * row};
  board.v = Eigen::Vector3d::UnitZ();
  board.half_u = board.half_v = 0.3;
  return board;
}

/// A mapper that merges noisy views of the wall, removes and corrects key frames, and is started
/// anew.
class Mapper {
 public:
  explicit Mapper(std::uint32_t seed) : random_(seed) { start(1); }

  void start(std::int64_t epoch) {
    map_ = GeometricMap(MergeConfig{}, HistoryConfig{});
    view_ = MapView{0, epoch, 0, {}};
  }

  std::vector<Message> change() {
    const std::int64_t keyframe = next_keyframe_++;
    testing::Observer observer(static_cast<std::uint32_t>(random_()));
    observer.angle_noise = 0.01;
    observer.offset_noise = 0.004;
    observer.outline_noise = 0.02;
    const Eigen::Isometry3d camera = testing::look_at({0.0, -1.5, 1.4}, {0, 1, 0.7});
    std::vector<testing::Rectangle> boards;
    for (int i = 0; i < 6; ++i) boards.push_back(random_board(random_));
    MapEvent event = observer.observe(keyframe, boards, camera);
    const std::int64_t earlier = 1 + static_cast<std::int64_t>(random_()) % keyframe;
    if (random_() % 8 == 0) event = KeyframeRemoval{earlier};
    if (random_() % 8 == 0) {
      event = PoseCorrection{{{earlier, Eigen::Translation3d(0.01, 0, 0) * camera}}};
    }
    const ApplyResult applied = map_.apply(event);
    const ViewDelta delta = delta_after(view_, map_.features(), applied.change, {});
    const auto messages = as_messages(to_messages(delta, view_));
    apply(delta, view_);
    return messages;
  }
  std::vector<Message> snapshot() const { return as_messages(to_messages(view_)); }
  const MapView& view() const { return view_; }
  const FeatureSet& features() const { return map_.features(); }

 private:
  template <class List>
  static std::vector<Message> as_messages(const List& list) {
    return {list.begin(), list.end()};
  }

  std::mt19937 random_;
  GeometricMap map_{MergeConfig{}, HistoryConfig{}};
  MapView view_;
  std::int64_t next_keyframe_ = 1;
};

class MapClientTest : public ::testing::Test {
 protected:
  void give(const std::vector<Message>& messages) {
    for (const Message& message : messages) {
      std::visit([this](const auto& m) { client_.take(m, now_); }, message);
    }
  }
  void wait(std::chrono::milliseconds duration) {
    now_ += duration;
    client_.poll(now_);
  }
  std::string seen() const { return view_hash(client_.view()); }
  std::string sent() const { return view_hash(mapper_.view()); }

  Mapper mapper_{1};
  int requests_ = 0;
  MapClient client_{[this] { ++requests_; }};
  Time now_ = Time{} + 100s;
};

TEST_F(MapClientTest, DeltasInOrderEqualTheSnapshot) {
  std::size_t most_parts = 0, absorbed = 0;
  for (int i = 0; i < 60; ++i) {
    const std::vector<Message> change = mapper_.change();
    give(change);
    for (const Message& message : change) {
      absorbed += std::get<geomap::map_delta_t>(message).absorbed.size();
    }
    most_parts = std::max(most_parts, mapper_.snapshot().size());
    ASSERT_EQ(seen(), sent()) << i;
    EXPECT_TRUE(client_.is_current());
    MapClient late([] {});
    for (const Message& message : mapper_.snapshot()) {
      std::visit([&](const auto& m) { late.take(m, now_); }, message);
    }
    EXPECT_EQ(late.view().features, client_.view().features);
    EXPECT_EQ(late.view().revision, client_.view().revision);
  }
  EXPECT_EQ(requests_, 0);
  EXPECT_GE(most_parts, 3U);
  EXPECT_GE(absorbed, 5U);
}

TEST_F(MapClientTest, ChangesAreCountedAndNothingElse) {
  EXPECT_EQ(client_.changes(), 0U);
  give(mapper_.change());
  EXPECT_GT(client_.changes(), 0U);
  const std::uint64_t changes = client_.changes();
  give(mapper_.snapshot());  // of what it has seen
  wait(5s);
  EXPECT_EQ(client_.changes(), changes);
  give(mapper_.change());
  EXPECT_EQ(client_.changes(), changes + 1);
  mapper_.change();
  mapper_.change();
  give(mapper_.snapshot());
  EXPECT_EQ(client_.changes(), changes + 2);
}

TEST_F(MapClientTest, WhatItSeesIsTheMapWithinTheTolerance) {
  for (int i = 0; i < 60; ++i) {
    give(mapper_.change());
    ASSERT_EQ(client_.view().features.size(), mapper_.features().size());
    for (const auto& [id, feature] : mapper_.features()) {
      const auto found = client_.view().features.find(id);
      ASSERT_NE(found, client_.view().features.end()) << to_string(id);
      EXPECT_FALSE(looks_different(found->second, quantised(*feature), {}));
    }
  }
}

TEST_F(MapClientTest, ASnapshotThatDeltasHaveOvertakenIsNotWaitedFor) {
  std::vector<Message> deltas;
  while (mapper_.snapshot().size() < 2) {
    give(deltas);
    deltas = mapper_.change();
  }
  give({mapper_.snapshot()[0]});
  EXPECT_FALSE(client_.is_current());
  give(deltas);
  EXPECT_TRUE(client_.is_current());
  EXPECT_EQ(seen(), sent());
}

TEST_F(MapClientTest, PartsOfTwoSnapshotsOfOneRevisionMakeAWhole) {
  for (int i = 0; i < 30; ++i) mapper_.change();
  const std::vector<Message> snapshot = mapper_.snapshot();
  ASSERT_GE(snapshot.size(), 2U);
  give({snapshot.begin() + 1, snapshot.end()});
  give({snapshot[0]});
  EXPECT_EQ(seen(), sent());
}

TEST_F(MapClientTest, AsksAtOnceWhenItJoins) {
  client_.poll(now_);
  EXPECT_EQ(requests_, 1);
  give(mapper_.snapshot());
  EXPECT_TRUE(client_.is_current());
}

TEST_F(MapClientTest, AGapIsNoticedAndAskedAboutOnceASecond) {
  give(mapper_.change());
  mapper_.change();  // lost
  give(mapper_.change());
  EXPECT_FALSE(client_.is_current());
  EXPECT_EQ(requests_, 0);  // it may only be late
  for (int i = 0; i < 21; ++i) wait(100ms);
  EXPECT_EQ(requests_, 2);
  give(mapper_.snapshot());
  EXPECT_EQ(seen(), sent());
  EXPECT_TRUE(client_.is_current());
  for (int i = 0; i < 21; ++i) wait(100ms);
  EXPECT_EQ(requests_, 2);
}

TEST_F(MapClientTest, DeltasThatCameBeforeTheSnapshotCountAfterIt) {
  mapper_.change();  // before it joined
  const std::vector<Message> snapshot = mapper_.snapshot();
  give(mapper_.change());
  give(mapper_.change());
  give(snapshot);
  EXPECT_EQ(seen(), sent());
}

TEST_F(MapClientTest, ANewMapperBeginsAnew) {
  for (int i = 0; i < 5; ++i) give(mapper_.change());
  const std::vector<Message> late = mapper_.change();
  mapper_.start(2);
  give(mapper_.change());
  EXPECT_EQ(seen(), sent());
  give(late);  // from the former one
  EXPECT_EQ(seen(), sent());
  EXPECT_EQ(client_.view().epoch, 2);
}

TEST_F(MapClientTest, TheOldViewStaysUntilThatOfANewMapperIsThere) {
  for (int i = 0; i < 5; ++i) give(mapper_.change());
  const std::string before = seen();
  mapper_.start(2);
  mapper_.change();  // lost
  give(mapper_.change());
  EXPECT_EQ(seen(), before);
  EXPECT_FALSE(client_.is_current());
  give(mapper_.snapshot());
  EXPECT_EQ(seen(), sent());
}

TEST_F(MapClientTest, AMapperWhoseClockWasSetBackIsBelievedAfterAWhile) {
  mapper_.start(1000);
  give(mapper_.change());
  mapper_.start(10);
  give(mapper_.change());
  EXPECT_NE(seen(), sent());
  wait(11s);
  give(mapper_.snapshot());
  EXPECT_EQ(seen(), sent());
}

TEST_F(MapClientTest, ForgedMessagesDoNotKeepItFromTheTruth) {
  std::mt19937 random(5);
  for (int i = 0; i < 40; ++i) {
    give(mapper_.change());
    for (int k = 0; k < 200; ++k) {
      geomap::map_delta_t forged{};
      forged.epoch = mapper_.view().epoch;
      forged.revision = mapper_.view().revision + 1 + static_cast<std::int64_t>(random() % 20'000);
      forged.part = static_cast<std::int32_t>(random() % 4) - 1;
      forged.parts = static_cast<std::int32_t>(random() % 4) - 1;
      forged.cause = static_cast<std::int8_t>(random());
      client_.take(forged, now_);
    }
    wait(50ms);
  }
  EXPECT_GT(client_.refused(), 0);
  give(mapper_.snapshot());
  give(mapper_.snapshot());
  EXPECT_EQ(seen(), sent());
}

TEST_F(MapClientTest, RandomMessagesDoNoHarm) {
  std::mt19937 random(6);
  give(mapper_.change());
  const auto& schemas = messaging::known_schemas().all();
  const auto take_random = [&]<class M>(const M&, const std::string& name) {
    const std::vector<std::uint8_t> bytes = testing::random_message(schemas.at(name), random).bytes;
    const auto decoded = messaging::safe_decode<M>(bytes.data(), bytes.size());
    if (decoded.message) client_.take(*decoded.message, now_);
  };
  for (int i = 0; i < 5'000; ++i) {
    take_random(geomap::map_delta_t{}, "geomap.map_delta_t");
    take_random(geomap::map_t{}, "geomap.map_t");
  }
  EXPECT_GT(client_.refused(), 1'000);
  wait(11s);  // some came from a later epoch
  give(mapper_.snapshot());
  EXPECT_EQ(seen(), sent());
}

/// What a link may do to messages.
struct Link {
  double loss = 0.0, doubling = 0.0, delay = 0.0;  // shares of the messages
};

class MapClientOverALink : public ::testing::TestWithParam<Link> {};

TEST_P(MapClientOverALink, EqualsTheMapperAfterTheNextWholeSnapshot) {
  const Link link = GetParam();
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit;
    Mapper mapper(seed);
    int wishes = 0;
    MapClient client([&] { ++wishes; });
    Time now = Time{} + 100s;
    std::vector<Message> late;
    const auto arrive = [&](const Message& message) {
      std::visit([&](const auto& m) { client.take(m, now); }, message);
    };
    const auto send = [&](const std::vector<Message>& messages) {
      for (const Message& message : messages) {
        if (unit(random) < link.loss) continue;
        if (unit(random) < link.delay) {
          late.push_back(message);
          continue;
        }
        arrive(message);
        if (unit(random) < link.doubling) arrive(message);
      }
    };
    for (int step = 0; step < 100; ++step, now += 100ms) {
      if (step == 60) mapper.start(2);
      send(mapper.change());
      if (wishes > 0) send(mapper.snapshot());
      wishes = 0;
      std::shuffle(late.begin(), late.end(), random);
      for (; !late.empty() && unit(random) < 0.7; late.pop_back()) arrive(late.back());
      client.poll(now);
      // Whatever it believes whole is what the mapper had at that revision.
      if (client.view().epoch == mapper.view().epoch &&
          client.view().revision == mapper.view().revision) {
        ASSERT_EQ(view_hash(client.view()), view_hash(mapper.view())) << seed << " " << step;
      }
      if (link.loss == 0.0 && link.delay == 0.0) {
        ASSERT_EQ(client.view().revision, mapper.view().revision);
      }
    }
    for (const Message& message : late) arrive(message);
    for (const Message& message : mapper.snapshot()) arrive(message);
    EXPECT_EQ(view_hash(client.view()), view_hash(mapper.view()));
    EXPECT_TRUE(client.is_current());
  }
}

INSTANTIATE_TEST_SUITE_P(Links, MapClientOverALink,
                         ::testing::Values(Link{}, Link{.doubling = 0.5}, Link{.delay = 0.3},
                                           Link{.loss = 0.05},
                                           Link{.loss = 0.2, .doubling = 0.2, .delay = 0.2}));

}  // namespace
}  // namespace geomap::mapping
