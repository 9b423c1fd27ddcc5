// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/live_source_client.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <functional>
#include <stdexcept>
#include <thread>

#include "geomap/map_edit_t.hpp"
#include "geomap/map_request_t.hpp"
#include "mapping/map_view_messages.hpp"
#include "messaging/channels.hpp"
#include "messaging/safe_decode.hpp"
#include "viewer/awaited_replies_client.hpp"
#include "viewer/example_messages.hpp"

namespace geomap::viewer {
namespace {

namespace channels = messaging::channels;
using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class AwaitedRepliesTest : public ::testing::Test {
 protected:
  void ask(std::int64_t command) {
    replies_.add("ann", command, 500ms, now_, [this] { ++sent_; });
  }
  void wait(std::chrono::milliseconds duration) {
    now_ += duration;
    replies_.poll(now_);
  }

  AwaitedReplies replies_;
  Clock::time_point now_ = Clock::time_point{} + 100s;
  int sent_ = 0;
};

TEST_F(AwaitedRepliesTest, ACommandIsSentAgainEveryHalfSecondUntilItsReply) {
  ask(7);
  EXPECT_EQ(sent_, 1);
  for (int i = 0; i < 20; ++i) wait(100ms);
  EXPECT_EQ(sent_, 5);
  replies_.take(
      {{"bob", {.command = 7, .text = "to Bob"}}, {"ann", {.command = 8, .text = "late"}}});
  EXPECT_THAT(replies_.take_outcomes(), IsEmpty());
  replies_.take({{"ann", {.command = 7, .is_done = true, .text = "edit 1", .edit = 1}}});
  const auto outcomes = replies_.take_outcomes();
  ASSERT_THAT(outcomes, SizeIs(1));
  EXPECT_TRUE(outcomes[0].is_done);
  EXPECT_EQ(outcomes[0].edit, 1);
  wait(5s);
  EXPECT_EQ(sent_, 5);
  EXPECT_THAT(replies_.take_outcomes(), IsEmpty());
}

TEST_F(AwaitedRepliesTest, ARefusalIsTheOutcome) {
  ask(7);
  replies_.take({{"ann", {.command = 7, .text = "there is no such feature"}}});
  const auto outcomes = replies_.take_outcomes();
  ASSERT_THAT(outcomes, SizeIs(1));
  EXPECT_FALSE(outcomes[0].is_done);
  EXPECT_EQ(outcomes[0].text, "there is no such feature");
}

TEST_F(AwaitedRepliesTest, TenSecondsOfSilenceAreAnOutcomeToo) {
  ask(7);
  wait(9900ms);
  EXPECT_THAT(replies_.take_outcomes(), IsEmpty());
  wait(200ms);
  const auto outcomes = replies_.take_outcomes();
  ASSERT_THAT(outcomes, SizeIs(1));
  EXPECT_EQ(outcomes[0].command, 7);
  EXPECT_THAT(outcomes[0].text, HasSubstr("no answer from geomap-mapper"));
}

/// A live source, and a second connection that plays the mapper.
class LiveSourceTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const messaging::BusConfig config{.url = "udpm://239.255.76.67:7667?ttl=0",
                                      .channel_prefix = "test" + std::to_string(getpid()) + "/"};
    try {
      mapper_ = std::make_unique<messaging::Bus>(config);
      source_ = open_live(config);
    } catch (const std::runtime_error& error) {
      GTEST_SKIP() << error.what();
    }
    mapper_->subscribe(channels::kMapEdit, messaging::Keep::kEvery);
    mapper_->subscribe(channels::kMapRequest, messaging::Keep::kEvery);
    mapper_->start();
  }

  template <class Message>
  static std::optional<Message> decode(const messaging::Received& received) {
    return messaging::safe_decode<Message>(received.data.data(), received.data.size()).message;
  }
  void answer(const messaging::Received& received) {
    if (received.channel == channels::kMapEdit) {
      const auto edit = decode<geomap::map_edit_t>(received);
      ++edits_;
      if (edits_ > 1) reply(edit->author, edit->command, true, "edit 3");
      return;
    }
    const auto request = decode<geomap::map_request_t>(received);
    if (request->kind == geomap::map_request_t::SAVE) {
      reply(request->author, request->utime, false, "cannot save '" + request->name + "'");
    } else if (request->name == channels::kMapSnapshot) {
      for (const auto& part : mapping::to_messages(testing::wall_view(4, 2, 30))) {
        mapper_->publish(channels::kMapSnapshot, part);
      }
    } else if (request->name == channels::kMapEditRecord) {
      mapper_->publish(channels::kMapEditRecord, testing::record_message(4, 1, 1));
    } else if (request->name == channels::kPointMap) {
      mapper_->publish(channels::kPointMap, testing::point_update(1, 1, true, {{0, 5}}));
    }
  }
  void reply(const std::string& author, std::int64_t command, bool is_done,
             const std::string& text) {
    geomap::map_edit_reply_t message{};
    message.author = author;
    message.command = command;
    message.done = is_done ? 1 : 0;
    message.text = text;
    mapper_->publish(channels::kMapEditReply, message);
  }
  bool run_until(const std::function<bool()>& is_done, std::chrono::seconds patience = 5s) {
    const auto end = Clock::now() + patience;
    while (Clock::now() < end) {
      source_->update(scene_, Clock::now());
      while (const auto received = mapper_->take(Clock::now())) answer(*received);
      if (is_done()) return true;
      std::this_thread::sleep_for(5ms);
    }
    return false;
  }

  std::unique_ptr<messaging::Bus> mapper_;
  std::unique_ptr<MapSource> source_;
  SceneModel scene_;
  int edits_ = 0;
};

TEST_F(LiveSourceTest, StartedLastItShowsEverythingWithinTwoSeconds) {
  EXPECT_TRUE(run_until(
      [&] {
        return scene_.map.features.size() == 30 && source_->history().size() == 1 &&
               scene_.points.points == 5;
      },
      2s));
  EXPECT_TRUE(source_->is_live());
  EXPECT_EQ(source_->snapshot(scene_).features.size(), 30u);
  EXPECT_THROW(source_->exact_snapshot(scene_), std::runtime_error);
}

TEST_F(LiveSourceTest, AnEditThatWasLostIsSentAgainAndItsReplyIsTheOutcome) {
  source_->edit({.author = "ann", .command = 12});
  std::vector<Outcome> outcomes;
  EXPECT_TRUE(run_until([&] { return !(outcomes = source_->take_outcomes()).empty(); }));
  EXPECT_GE(edits_, 2);
  ASSERT_THAT(outcomes, SizeIs(1));
  EXPECT_EQ(outcomes[0].command, 12);
  EXPECT_TRUE(outcomes[0].is_done);
}

TEST_F(LiveSourceTest, ASaveIsAnsweredInWords) {
  const std::int64_t number = source_->save("kitchen.lcmlog");
  std::vector<Outcome> outcomes;
  EXPECT_TRUE(run_until([&] { return !(outcomes = source_->take_outcomes()).empty(); }));
  ASSERT_THAT(outcomes, SizeIs(1));
  EXPECT_EQ(outcomes[0].command, number);
  EXPECT_FALSE(outcomes[0].is_done);
  EXPECT_EQ(outcomes[0].text, "cannot save 'kitchen'");
}

}  // namespace
}  // namespace geomap::viewer
