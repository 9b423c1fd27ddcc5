// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/local_time.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>
#include <limits>

namespace geomap::mapping {
namespace {

TEST(LocalTime, IsThatOfTheHostsZone) {
  setenv("TZ", "UTC-2", 1);  // POSIX: two hours east
  tzset();
  EXPECT_EQ(local_time(1'000'000'000'000'000, "%F %T"), "2001-09-09 03:46:40");
  EXPECT_EQ(local_time(999'999, "%F %T"), "1970-01-01 02:00:00") << "whole seconds";
  EXPECT_EQ(local_time("%Y").size(), 4U);
}

TEST(LocalTime, AnyNumberHasATextOrNone) {
  local_time(std::numeric_limits<std::int64_t>::max(), "%F %T");
  local_time(std::numeric_limits<std::int64_t>::min(), "%F %T");
  EXPECT_EQ(local_time(0, ""), "");
}

}  // namespace
}  // namespace geomap::mapping
