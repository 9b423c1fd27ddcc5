// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/progress_bar.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>

namespace geomap::messaging {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(ProgressBar, APipeGetsALineEveryTenPercent) {
  std::ostringstream out;
  ProgressBar bar("frames", 1000, out, false);
  for (int i = 1; i <= 1000; ++i) bar.update(i);
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
  EXPECT_THAT(text, StartsWith("frames:  10 %"));
  EXPECT_THAT(text, HasSubstr("100 %"));
  EXPECT_THAT(text, HasSubstr("1000/1000"));
  EXPECT_THAT(text, Not(HasSubstr("\r")));
}

TEST(ProgressBar, ATerminalGetsOneLineThatIsRewritten) {
  std::ostringstream out;
  {
    ProgressBar bar("frames", 1000, out, true);
    for (int i = 1; i <= 1000; ++i) bar.update(i);
  }
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  EXPECT_EQ(text.back(), '\n');
  EXPECT_THAT(text, StartsWith("\rframes:   0 %"));
  EXPECT_THAT(text, HasSubstr("1000/1000"));
  EXPECT_THAT(text, HasSubstr("left"));
}

TEST(ProgressBar, WithoutATotalItCounts) {
  std::ostringstream out;
  ProgressBar bar("messages", 0, out, true);
  bar.update(7);
  EXPECT_THAT(out.str(), HasSubstr("messages: 7, "));
  EXPECT_THAT(out.str(), Not(HasSubstr("%")));
}

TEST(ProgressBar, MoreThanTheTotalDoesNotBreakIt) {
  std::ostringstream out;
  ProgressBar bar("bytes", 10, out, false);
  bar.update(25);
  EXPECT_THAT(out.str(), HasSubstr("100 %"));
}

TEST(ProgressBar, NothingIsShownBeforeTheFirstUpdate) {
  std::ostringstream out;
  { ProgressBar bar("frames", 10, out, true); }
  EXPECT_EQ(out.str(), "");
}

}  // namespace
}  // namespace geomap::messaging
