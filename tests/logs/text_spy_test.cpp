// SPDX-License-Identifier: BSD-3-Clause
#include "logs/text_spy.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "bot_core/pose_t.hpp"
#include "logs/terminal.hpp"
#include "messaging/config.hpp"
#include "messaging/encode.hpp"

namespace geomap::logs {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

messaging::Received pose(const std::string& channel, std::int64_t utime = 0) {
  bot_core::pose_t message{};
  message.utime = utime;
  message.orientation[0] = 1.0;
  return {channel, messaging::encode(message)};
}

TEST(TextSpy, SaysThatNothingHasCome) {
  const TextSpy spy(TextSpyOptions{});
  EXPECT_FALSE(spy.has_heard());
  EXPECT_THAT(spy.text(0), HasSubstr("nothing has come"));
}

TEST(TextSpy, ShowsChannelsWhoseWholeNameMatches) {
  TextSpy spy({.channels = "POSE|.*MAP"});
  for (const char* channel : {"POSE", "POSES", "POINT_MAP", "MAP_DELTA"})
    spy.take(pose(channel), 0);
  EXPECT_THAT(spy.text(0), HasSubstr("2 channels"));
  EXPECT_THAT(spy.text(0), HasSubstr("\nPOSE "));
  EXPECT_THAT(spy.text(0), HasSubstr("\nPOINT_MAP "));
}

TEST(TextSpy, ShowsFieldsOfTheNewestMessage) {
  TextSpy spy({.fields = {"POSE.utime", "a.b.orientation", "NONE", "POSE.nothing"}});
  spy.take(pose("POSE", 1), 0);
  spy.take(pose("POSE", 2), 0);
  spy.take(pose("a.b", 3), 0);
  const std::string text = spy.text(0);
  EXPECT_THAT(text, HasSubstr("\nPOSE\n  utime: 2\n"));
  EXPECT_THAT(text, HasSubstr("\na.b\n  orientation: 1 0 0 0 (4)\n"));
  EXPECT_THAT(text, HasSubstr("\nNONE: nothing has come on this channel\n"));
  EXPECT_THAT(text, HasSubstr("\nPOSE.nothing: no such field"));
  EXPECT_THAT(text, Not(HasSubstr("utime: 1")));
}

TEST(TextSpy, RefusesOptionsThatCannotBe) {
  EXPECT_THROW(TextSpy({.channels = "["}), messaging::ConfigError);
  for (const double seconds : {0.0, -1.0, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(TextSpy({.once = seconds}), messaging::ConfigError) << seconds;
  }
}

TEST(Terminal, IsPaintedLineByLineFromTheTop) {
  EXPECT_EQ(repaint("ab\n\nc\n", 80, 24), "\x1b[Hab\x1b[K\n\x1b[K\nc\x1b[K\n\x1b[J");
}

TEST(Terminal, GetsNoMoreThanHasRoom) {
  EXPECT_EQ(repaint("abcdef\n", 3, 24), "\x1b[Habc\x1b[K\n\x1b[J");
  EXPECT_EQ(repaint("a\nb\nc\nd\n", 80, 4),
            "\x1b[Ha\x1b[K\nb\x1b[K\n.. 2 more lines: a larger window shows them\x1b[K\n\x1b[J");
  EXPECT_EQ(repaint("a\nb\n", 4, 1), "\x1b[H.. 2\x1b[K\n\x1b[J");
}

}  // namespace
}  // namespace geomap::logs
