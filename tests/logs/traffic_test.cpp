// SPDX-License-Identifier: BSD-3-Clause
#include "logs/traffic.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "bot_core/pose_t.hpp"
#include "geomap/rgbd_frame_t.hpp"
#include "kinect/frame_msg_t.hpp"
#include "logs/traffic_text.hpp"
#include "messaging/encode.hpp"

namespace geomap::logs {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::int64_t kNow = 1'800'000'000'000'000;  // host's clock [us]
constexpr std::int64_t kSecond = 1'000'000;
constexpr double kWindow = 10.0;

std::vector<std::uint8_t> pose(std::int64_t utime) {
  bot_core::pose_t message{};
  message.utime = utime;
  message.orientation[0] = 1.0;
  return messaging::encode(message);
}

std::vector<std::uint8_t> frame(std::int64_t sequence) {
  geomap::rgbd_frame_t message{};
  message.sequence = sequence;
  return messaging::encode(message);
}

/// One channel with messages at given times.
ChannelTraffic traffic_of(const std::vector<std::vector<std::uint8_t>>& messages) {
  Traffic traffic(kWindow);
  for (const auto& message : messages) traffic.add("C", message, kNow);
  return traffic.channels().at("C");
}

TEST(TrafficWindow, ASteadyChannelHasItsRateFromTheSecondMessageOn) {
  for (const double hertz : {0.5, 1.0, 30.0, 1000.0}) {
    TrafficWindow window(kWindow);
    const auto interval = static_cast<std::int64_t>(1e6 / hertz);
    for (std::int64_t i = 0; i < 3000; ++i) {
      const std::int64_t utime = kNow + i * interval;
      window.add(utime, 100, std::nullopt);
      const TrafficRates rates = window.rates(utime + interval / 2);
      if (i == 0) {
        EXPECT_EQ(rates.hertz, 0.0);
        continue;
      }
      // At an arbitrary moment one message more or less may be in the window.
      const double tolerance = std::max(1e-6, 1.0 / (kWindow * hertz));
      EXPECT_NEAR(rates.hertz / hertz, 1.0, tolerance) << hertz << " Hz, message " << i;
      EXPECT_NEAR(rates.bandwidth, 100 * rates.hertz, 1e-6);
    }
  }
}

TEST(TrafficWindow, RatesAreThoseOfACountByHand) {
  std::mt19937 random(7);
  std::vector<std::int64_t> utimes;
  for (int i = 0; i < 5000; ++i)
    utimes.push_back(kNow + static_cast<std::int64_t>(random() % (60 * kSecond)));
  std::sort(utimes.begin(), utimes.end());
  TrafficWindow window(kWindow);
  for (const std::int64_t utime : utimes) {
    window.add(utime, 10, std::nullopt);
    const std::int64_t begin = utime / kSecond * kSecond - 10 * kSecond;  // of whole steps
    if (begin <= utimes.front()) continue;
    const auto first = std::lower_bound(utimes.begin(), utimes.end(), begin);
    const auto last = std::upper_bound(first, utimes.end(), utime);
    const double expected =
        static_cast<double>(last - first) / (1e-6 * static_cast<double>(utime - begin));
    EXPECT_NEAR(window.rates(utime).hertz, expected, 0.2);  // two of the same time
  }
}

TEST(TrafficWindow, AChannelThatFallsSilentLosesItsRate) {
  TrafficWindow window(kWindow);
  for (int i = 0; i < 100; ++i) window.add(kNow + i * kSecond / 10, 100, 0.5);
  EXPECT_NEAR(window.rates(kNow + 15 * kSecond).hertz, 5.0, 1.0);
  const TrafficRates silent = window.rates(kNow + 25 * kSecond);
  EXPECT_EQ(silent.hertz, 0.0);
  EXPECT_EQ(silent.bandwidth, 0.0);
  EXPECT_FALSE(silent.mean_latency);
}

TEST(TrafficWindow, LatenciesAreThoseOfTheLastSeconds) {
  TrafficWindow window(kWindow);
  window.add(kNow, 1, 9.0);
  window.add(kNow + 20 * kSecond, 1, -0.25);
  window.add(kNow + 21 * kSecond, 1, std::nullopt);
  window.add(kNow + 22 * kSecond, 1, -0.75);
  const TrafficRates rates = window.rates(kNow + 22 * kSecond);
  EXPECT_DOUBLE_EQ(*rates.mean_latency, -0.5);
  EXPECT_DOUBLE_EQ(*rates.longest_latency, -0.25);
}

TEST(TrafficWindow, AClockThatIsSetBackDoesNoHarm) {
  TrafficWindow window(kWindow);
  for (int i = 0; i < 50; ++i) window.add(kNow + i * kSecond / 10, 100, std::nullopt);
  window.add(kNow - 3600 * kSecond, 100, std::nullopt);
  EXPECT_GE(window.rates(kNow - 3600 * kSecond).hertz, 0.0);
  EXPECT_LT(window.rates(kNow - 3600 * kSecond).hertz, 1.0);
}

TEST(Traffic, MessagesThatAreMissingAreCountedWhereTheyAreNumbered) {
  EXPECT_EQ(traffic_of({frame(5), frame(6), frame(9), frame(10), frame(12)}).missing, 3);
  EXPECT_EQ(traffic_of({frame(100), frame(0), frame(1)}).missing,
            0);  // another start of the sensor
  EXPECT_EQ(traffic_of({pose(1), pose(9)}).missing, std::nullopt);
}

TEST(Traffic, ALatencyIsTheAgeOfAMessageUnlessItIsARecordings) {
  Traffic traffic(kWindow);
  traffic.add("FRESH", pose(kNow - 20'000), kNow);
  kinect::frame_msg_t kinect{};
  kinect.timestamp = kNow - 30'000;
  traffic.add("KINECT", messaging::encode(kinect), kNow);
  for (const std::int64_t utime :
       {std::int64_t{0}, kNow - 61 * kSecond, kNow + 61 * kSecond,
        std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()}) {
    traffic.add("OLD", pose(utime), kNow);
  }
  const auto latency = [&](const std::string& name) {
    return traffic.channels().at(name).window.rates(kNow).mean_latency;
  };
  EXPECT_NEAR(*latency("FRESH"), 0.020, 1e-9);
  EXPECT_NEAR(*latency("KINECT"), 0.030, 1e-9);
  EXPECT_FALSE(latency("OLD"));
}

TEST(Traffic, WhatCannotBeDecodedIsCounted) {
  std::vector<std::uint8_t> cut = pose(1), foreign = pose(1);
  cut.pop_back();
  foreign[0] ^= 1;
  const ChannelTraffic channel = traffic_of({pose(1), cut, foreign, {}, {1, 2, 3}});
  EXPECT_EQ(channel.messages, 5);
  EXPECT_EQ(channel.undecodable, 4);
  EXPECT_EQ(channel.type->name, "bot_core.pose_t");
  EXPECT_EQ(traffic_of({foreign}).type, nullptr);
}

TEST(Traffic, InventedNamesTakeBoundedMemory) {
  Traffic traffic(kWindow);
  for (int i = 0; i < 5000; ++i) traffic.add(std::to_string(i), pose(1), kNow);
  traffic.add("0", pose(1), kNow);
  EXPECT_EQ(traffic.channels().size(), 1000U);
  EXPECT_EQ(traffic.left_out(), 4000);
  EXPECT_EQ(traffic.channels().at("0").messages, 2);
  EXPECT_THAT(traffic_text(traffic, kNow), HasSubstr("4000 messages on further channels"));
}

TEST(TrafficText, HasALineForEachChannel) {
  Traffic traffic(kWindow);
  for (int i = 0; i < 5; ++i) {
    traffic.add("POSE", pose(kNow + (2 * i - 1) * kSecond / 10), kNow + i * kSecond / 5);
    traffic.add("RGBD_FRAME", frame(2 * i), kNow + i * kSecond / 5);
  }
  traffic.add("FOREIGN", {}, kNow);
  EXPECT_EQ(traffic_text(traffic, kNow + kSecond),
            "3 channels, 9.0 messages/s, 1.4 kB/s\n"
            "\n"
            "channel     type                 messages    Hz  bandwidth  missing   latency   "
            "longest  undecodable\n"
            "FOREIGN     unknown                     1     -          -        -         -         "
            "-            1\n"
            "POSE        bot_core.pose_t             5  4.50    648 B/s        -  100.0 ms  100.0 "
            "ms            0\n"
            "RGBD_FRAME  geomap.rgbd_frame_t         5  4.50    778 B/s        4         -         "
            "-            0\n");
}

TEST(TrafficText, ANameCannotCommandTheTerminal) {
  Traffic traffic(kWindow);
  traffic.add("\x1b[2J\nX", pose(1), kNow);
  EXPECT_THAT(traffic_text(traffic, kNow), HasSubstr("\n?[2J?X "));
  EXPECT_THAT(traffic_text(traffic, kNow), Not(HasSubstr("\x1b")));
}

}  // namespace
}  // namespace geomap::logs
