// SPDX-License-Identifier: BSD-3-Clause
// Whatever a log holds, a replay ends, refuses the bad by reason, and keeps what the good has
// given.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "logs/pipeline.hpp"
#include "logs/synthetic_log.hpp"
#include "mapping/map_hash.hpp"
#include "messaging/convert_frame.hpp"
#include "messaging/convert_geometry.hpp"
#include "messaging/encode.hpp"
#include "messaging/safe_decode.hpp"
#include "perception/sensor_messages.hpp"

namespace geomap::logs {
namespace {

using messaging::LogEvent;
using Events = std::vector<LogEvent>;

struct Outcome {
  std::string hash;
  std::size_t keyframes = 0;
  std::map<std::string, std::int64_t> rejected;
  perception::SensorMessages::Refused refused;

  std::int64_t refusals() const {
    std::int64_t sum = 0;
    for (const auto& [channel, reasons] : refused) {
      for (const auto& [reason, count] : reasons) sum += count;
    }
    return sum;
  }
};

Outcome replayed(const Events& events) {
  Pipeline pipeline(PipelineConfig{}, 1);
  perception::SensorMessages input(pipeline.tracking(), {});
  for (const LogEvent& event : events) input.handle(event.channel, event.data);
  pipeline.finish();
  return {mapping::map_hash(pipeline.map().features()), pipeline.keyframes().size(),
          pipeline.rejected(), input.refused()};
}

// Good events with bad ones strewn between them.
Events strewn(const Events& good, const std::function<std::optional<LogEvent>(LogEvent)>& spoil) {
  Events events;
  for (const LogEvent& event : good) {
    if (const auto bad = spoil(event)) events.push_back(*bad);
    events.push_back(event);
  }
  return events;
}

template <class Message>
Message decoded(const LogEvent& event) {
  return messaging::safe_decode<Message>(event.data.data(), event.data.size()).message.value();
}

const Events& good_log() {
  static const Events events = testing::synthetic_log(8);
  return events;
}

TEST(HostileLog, EveryMessageTruncatedAtRandomIsRefusedAndTheRestMapped) {
  const Outcome good = replayed(good_log());
  ASSERT_GT(good.keyframes, 2u);
  std::mt19937 random(11);
  for (int trial = 0; trial < 10; ++trial) {
    const Outcome outcome = replayed(strewn(good_log(), [&](LogEvent event) {
      event.data.resize(random() % event.data.size());
      return event;
    }));
    EXPECT_EQ(outcome.hash, good.hash);
    EXPECT_EQ(outcome.refusals(), static_cast<std::int64_t>(good_log().size()));
  }
}

TEST(HostileLog, FlippedBytesNeverCrash) {
  std::mt19937 random(12);
  for (int trial = 0; trial < 30; ++trial) {
    Events events = good_log();
    for (LogEvent& event : events) {
      // Mostly in the head, where counts and sizes are.
      const std::size_t reach =
          trial % 2 == 0 ? std::min<std::size_t>(event.data.size(), 200) : event.data.size();
      event.data[random() % reach] = static_cast<std::uint8_t>(random());
    }
    replayed(events);
  }
}

TEST(HostileLog, EveryFourBytesTakenForACountOfMinusOneOrTwoBillionNeverCrash) {
  const Events& good = good_log();
  for (const std::uint32_t count : {0xffffffffu, 0x7fffffffu}) {
    Events events;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t at = 0; at + 4 <= std::min<std::size_t>(good[i].data.size(), 320); ++at) {
        LogEvent event = good[i];
        for (std::size_t b = 0; b < 4; ++b) {
          event.data[at + b] = static_cast<std::uint8_t>(count >> (24 - 8 * b));
        }
        events.push_back(event);
      }
    }
    EXPECT_GT(replayed(events).refusals(), 0);
  }
}

TEST(HostileLog, PosesThatAreNoPosesAreRefused) {
  const Outcome good = replayed(good_log());
  const auto spoiled = [&](const std::function<void(bot_core::pose_t&)>& spoil) {
    return replayed(strewn(good_log(), [&](LogEvent event) -> std::optional<LogEvent> {
      if (event.channel != "POSE") return std::nullopt;
      auto pose = decoded<bot_core::pose_t>(event);
      spoil(pose);
      event.data = messaging::encode(pose);
      return event;
    }));
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Outcome not_a_number = spoiled([&](auto& pose) { pose.pos[1] = nan; });
  EXPECT_EQ(not_a_number.hash, good.hash);
  EXPECT_EQ(not_a_number.refused.at("POSE").at("not_finite"), 8);
  const Outcome no_rotation = spoiled([](auto& pose) { pose.orientation[0] = 7.0; });
  EXPECT_EQ(no_rotation.hash, good.hash);
  EXPECT_EQ(no_rotation.refused.at("POSE").at("not_unit"), 8);
  const Outcome no_time = spoiled([](auto& pose) { pose.utime = -5; });
  EXPECT_EQ(no_time.hash, good.hash);
  EXPECT_EQ(no_time.refused.at("POSE").at("bad_utime"), 8);
}

TEST(HostileLog, APoseAtTheEndOfTheUniverseIsSurvived) {
  const Outcome outcome =
      replayed(strewn(good_log(), [](LogEvent event) -> std::optional<LogEvent> {
        if (event.channel != "POSE") return std::nullopt;
        auto pose = decoded<bot_core::pose_t>(event);
        pose.utime -= 1;
        pose.pos[0] = 1e300;
        event.data = messaging::encode(pose);
        return event;
      }));
  EXPECT_GE(outcome.keyframes, 1u);
}

TEST(HostileLog, FramesWithoutReadingsOrOfAnotherSizeAreRejectedByReason) {
  const auto with_depth = [&](int width, int height, std::uint16_t value) {
    Events events = good_log();
    for (LogEvent& event : events) {
      if (event.channel != "RGBD_FRAME") continue;
      auto frame = *messaging::to_frame(decoded<geomap::rgbd_frame_t>(event)).frame;
      frame.depth.width = frame.depth_camera.width = width;
      frame.depth.height = frame.depth_camera.height = height;
      frame.depth.millimetres.assign(static_cast<std::size_t>(width * height), value);
      event.data = messaging::encode(messaging::to_message(frame));
    }
    return replayed(events);
  };
  EXPECT_THAT(with_depth(320, 240, 0).rejected, ::testing::Contains(::testing::Key("no_reading")));
  EXPECT_THAT(with_depth(320, 240, 65535).rejected,
              ::testing::Contains(::testing::Key("no_reading")));
  EXPECT_THAT(with_depth(1, 1, 1000).rejected,
              ::testing::Contains(::testing::Key("too_few_readings")));
  EXPECT_GT(with_depth(37, 211, 1000).keyframes, 0u);
}

TEST(HostileLog, TheCameraOfAnotherImageIsRefused) {
  Events events = good_log();
  for (LogEvent& event : events) {
    if (event.channel != "RGBD_FRAME") continue;
    auto message = decoded<geomap::rgbd_frame_t>(event);
    message.depth_camera.width = 641;
    message.depth_camera.height = 481;
    event.data = messaging::encode(message);
  }
  const Outcome outcome = replayed(events);
  EXPECT_EQ(outcome.keyframes, 0u);
  EXPECT_THAT(outcome.rejected, ::testing::Contains(::testing::Key("bad_size")));
}

TEST(HostileLog, FramesThatComeAgainAreCountedAndDoNotCountTwice) {
  const Outcome good = replayed(good_log());
  Events events;
  for (const LogEvent& event : good_log()) {
    events.push_back(event);
    if (event.channel == "RGBD_FRAME") events.push_back(event);
  }
  EXPECT_EQ(replayed(events).hash, good.hash);

  events = good_log();
  events.insert(events.end(), good_log().begin(), good_log().end());  // time goes back to the start
  const Outcome outcome = replayed(events);
  EXPECT_GE(outcome.keyframes, good.keyframes);
  EXPECT_GE(outcome.rejected.at("repeated_utime"), 1);
}

TEST(HostileLog, MissingFramesAreCountedByTheirSequenceNumbers) {
  const auto gaps = [](const std::vector<std::int64_t>& sequences) {
    Pipeline pipeline(PipelineConfig{}, 1);
    perception::SensorMessages input(pipeline.tracking(), {});
    auto frame = decoded<geomap::rgbd_frame_t>(good_log()[2]);
    for (const std::int64_t sequence : sequences) {
      frame.sequence = sequence;
      input.handle("RGBD_FRAME", messaging::encode(frame));
    }
    return input.missing_frames();
  };
  constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
  constexpr auto kLeast = std::numeric_limits<std::int64_t>::min();
  EXPECT_EQ(gaps({0, 1, 2}), 0);
  EXPECT_EQ(gaps({5, 6, 9, 11}), 3);
  EXPECT_EQ(gaps({100, 0, 1, kLeast, kMost, kLeast, 0}), 0);
}

TEST(HostileLog, UnknownChannelsAreIgnored) {
  const Outcome outcome = replayed(strewn(good_log(), [](LogEvent event) {
    event.channel = "LCM_SELF_TEST";
    event.data = {1, 2, 3};
    return event;
  }));
  EXPECT_EQ(outcome.hash, replayed(good_log()).hash);
  EXPECT_EQ(outcome.refusals(), 0);
}

}  // namespace
}  // namespace geomap::logs
