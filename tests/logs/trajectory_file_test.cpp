// SPDX-License-Identifier: BSD-3-Clause
#include "logs/trajectory_file.hpp"

#include <random>

#include "messaging/temporary_folder.hpp"

namespace geomap::logs {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

class TrajectoryFile : public testing::TemporaryFolder {
 protected:
  Trajectory read(const std::string& content) const {
    return read_trajectory(write_file("t.tum", content));
  }
};

TEST_F(TrajectoryFile, WhatWasWrittenIsReadBackToTheMicrosecond) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Trajectory written;
  // Where a double of seconds no longer has whole microseconds.
  std::int64_t utime = 999'999'999'000'000'001;
  for (int i = 0; i < 200; ++i) {
    Eigen::Isometry3d T(Eigen::Quaterniond(uniform(generator), uniform(generator),
                                           uniform(generator), uniform(generator))
                            .normalized());
    T.translation() = 100.0 * Eigen::Vector3d(uniform(generator), uniform(generator), 0.5);
    written.emplace_back(utime, T);
    utime += 1 + generator() % 100'000;
  }
  write_trajectory(path("t.tum"), written);
  const Trajectory read = read_trajectory(path("t.tum"));
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].first, written[i].first);
    EXPECT_TRUE(read[i].second.isApprox(written[i].second, 1e-8)) << i;
  }
}

TEST_F(TrajectoryFile, CommentsBlankLinesTabsAndWindowsLineEndsAreSkipped) {
  const Trajectory read = this->read(
      "# head\r\n\r\n  \t\n1.5\t1  2 3 0 0 0 1  \r\n # in between\n2 4 5 6 0 0 0.7071 0.7071");
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].first, 1'500'000);
  EXPECT_EQ(read[0].second.translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(read[1].first, 2'000'000);
  EXPECT_LT((read[1].second.linear() * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(),
            1e-12);  // a quarter turn, although the four decimals give a length of 0.99998
}

TEST_F(TrajectoryFile, ALineThatIsNoPoseIsNamedInOneLine) {
  const std::pair<const char*, const char*> cases[] = {
      {"2.0 0 0 0 0 0 1", "7 words where 8 are wanted: seconds tx ty tz qx qy qz qw"},
      {"2.0 0 0 0 0 0 0 1 9", "9 words where 8 are wanted"},
      {"2.0 0 0 nan 0 0 0 1", "'nan' is not a finite number"},
      {"2.0 inf 0 0 0 0 0 1", "'inf' is not a finite number"},
      {"2.0 1305031102.5 0 0 0 0 0 1", "the position is more than 10^9 m away; the columns are"},
      {"2.0 0 0 0 0 0 x 1", "'x' is not a finite number"},
      {"two 0 0 0 0 0 0 1", "'two' is no time stamp"},
      {"-2.0 0 0 0 0 0 0 1", "'-2.0' is no time stamp"},
      {"2.0 0 0 0 0 0 0 1.002", "the quaternion does not have length 1; its order is qx qy qz qw"},
      {"2.0 0 0 0 0 0 0 1e200", "the quaternion does not have length 1"},
      {"1.0 0 0 0 0 0 0 1", "1.0 s does not come after the pose before; sort the lines by time"},
      {"0.5 0 0 0 0 0 0 1", "0.5 s does not come after the pose before"},
  };
  for (const auto& [line, why] : cases) {
    EXPECT_THAT([&] { read(std::string("# head\n1.0 0 0 0 0 0 0 1\n") + line + "\n"); },
                ThrowsMessage<std::runtime_error>(
                    AllOf(HasSubstr("t.tum, line 3: "), HasSubstr(why), Not(HasSubstr("\n")))));
  }
}

TEST_F(TrajectoryFile, AFileThatIsMissingOrHoldsNoPoseSaysSo) {
  EXPECT_THAT([&] { read_trajectory(path("none.tum")); },
              ThrowsMessage<std::runtime_error>(HasSubstr("none.tum: no such file")));
  EXPECT_THAT([&] { read("# only a comment\n"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("t.tum: no pose in it")));
  EXPECT_THROW(read(""), std::runtime_error);
}

}  // namespace
}  // namespace geomap::logs
