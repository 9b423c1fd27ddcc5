// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/tick_clock.hpp"

#include <gtest/gtest.h>

namespace geomap::drivers {
namespace {

TEST(TickClock, TimeGoesOnWhereTheTicksBeginAnew) {
  constexpr std::uint32_t kFrame = 2'000'000;  // ticks, a thirtieth of a second
  TickClock clock;
  std::uint32_t ticks = 0xffff0000U;
  for (int frame = 0; frame < 5000; ++frame) {  // more than two turns
    EXPECT_EQ(clock.microseconds(ticks), frame * std::int64_t{kFrame} / 60);
    ticks += kFrame;
  }
}

TEST(TickClock, AnImageOfTheOtherStreamMayBeEarlier) {
  TickClock clock;
  clock.microseconds(600);
  EXPECT_EQ(clock.microseconds(1200), 10);
  EXPECT_EQ(clock.microseconds(900), 5);
  EXPECT_EQ(clock.microseconds(1800), 20);
}

}  // namespace
}  // namespace geomap::drivers
