// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/tum_files.hpp"

#include <numbers>
#include <random>

#include "drivers/data_set_writer.hpp"
#include "drivers/frame_source.hpp"

namespace geomap::drivers {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;
using ::testing::ThrowsMessage;
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

std::vector<StampedFile> at(const std::vector<std::int64_t>& utimes) {
  std::vector<StampedFile> list;
  for (const std::int64_t utime : utimes) list.push_back({utime, ""});
  return list;
}

TEST(ParseSeconds, KeepsEveryDigitOfAMicrosecond) {
  EXPECT_EQ(parse_seconds("1305031102.160407"), 1305031102160407);
  EXPECT_EQ(parse_seconds("1305031102.1758"), 1305031102175800);
  EXPECT_EQ(parse_seconds("1305031102"), 1305031102000000);
  EXPECT_EQ(parse_seconds("1305031102."), 1305031102000000);
  EXPECT_EQ(parse_seconds("0.000001"), 1);
  EXPECT_EQ(parse_seconds("1.0000004999"), 1000000);
  EXPECT_EQ(parse_seconds("1.9999995"), 2000000);
  EXPECT_EQ(parse_seconds("999999999999.999999"), 999999999999999999);
}

TEST(ParseSeconds, RefusesWhatIsNoPlainNumber) {
  for (const char* text : {"", ".", ".5", "-1.0", "+1.0", "1e9", "1.0x", "1.2.3", "nan", "0x10",
                           "1 ", "1000000000000.0"}) {
    EXPECT_FALSE(parse_seconds(text)) << text;
  }
}

TEST(Associate, TheClosestPairGoesFirst) {
  EXPECT_THAT(associate(at({0, 15'000}), at({10'000}), 20'000), ElementsAre(Pair(1, 0)));
  EXPECT_THAT(associate(at({0, 15'000}), at({10'000, 16'000}), 20'000),
              ElementsAre(Pair(0, 0), Pair(1, 1)));
}

TEST(Associate, AGapIsAllowedUpToTheGivenOne) {
  EXPECT_EQ(associate(at({100'000}), at({120'000}), 20'000).size(), 1U);
  EXPECT_EQ(associate(at({100'000}), at({80'000}), 20'000).size(), 1U);
  EXPECT_TRUE(associate(at({100'000}), at({120'001, 79'999}), 20'000).empty());
  EXPECT_TRUE(associate(at({}), at({1}), 20'000).empty());
}

// The data set's tool: all pairs within reach, sorted by gap, taken while both are free.
Pairs all_pairs(const std::vector<StampedFile>& a, const std::vector<StampedFile>& b,
                std::int64_t max_gap) {
  Pairs result;
  for (std::int64_t gap = 0; gap <= max_gap; ++gap) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (std::size_t k = 0; k < b.size(); ++k) {
        const bool taken = std::any_of(result.begin(), result.end(), [&](const auto& pair) {
          return pair.first == i || pair.second == k;
        });
        if (!taken && std::abs(a[i].utime - b[k].utime) == gap) result.emplace_back(i, k);
      }
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

TEST(Associate, AgreesWithTryingAllPairs) {
  std::mt19937 generator(3);
  for (int repeat = 0; repeat < 50; ++repeat) {
    std::vector<StampedFile> lists[2];
    for (auto& list : lists) {
      std::int64_t utime = 0;
      for (int i = 0; i < 25; ++i) {
        utime += 1 + generator() % 40;
        list.push_back({utime, ""});
      }
    }
    EXPECT_EQ(associate(lists[0], lists[1], 20), all_pairs(lists[0], lists[1], 20));
  }
}

std::vector<StampedPose> turning_trajectory() {
  std::vector<StampedPose> trajectory(3);
  trajectory[0].utime = 1'000'000;
  trajectory[1].utime = 1'100'000;
  trajectory[1].T_world_camera.translation() = Eigen::Vector3d(0.4, -0.8, 1.2);
  trajectory[1].T_world_camera.linear() =
      Eigen::AngleAxisd(std::numbers::pi / 3.0, Eigen::Vector3d::UnitZ()).matrix();
  trajectory[2].utime = 1'200'001;
  return trajectory;
}

TEST(PoseAt, MovesOnAStraightLineAndAGreatArc) {
  const auto T = pose_at(turning_trajectory(), 1'025'000, 100'000);
  ASSERT_TRUE(T);
  EXPECT_LT((T->translation() - Eigen::Vector3d(0.1, -0.2, 0.3)).norm(), 1e-12);
  const Eigen::Matrix3d expected =
      Eigen::AngleAxisd(std::numbers::pi / 12.0, Eigen::Vector3d::UnitZ()).matrix();
  EXPECT_LT((T->linear() - expected).norm(), 1e-12);
}

TEST(PoseAt, IsExactAtAStampAndSilentOutsideAndInGaps) {
  const auto trajectory = turning_trajectory();
  EXPECT_EQ(pose_at(trajectory, 1'100'000, 10)->matrix(), trajectory[1].T_world_camera.matrix());
  EXPECT_TRUE(pose_at(trajectory, 1'000'000, 100'000));
  EXPECT_TRUE(pose_at(trajectory, 1'200'001, 100'000));
  EXPECT_FALSE(pose_at(trajectory, 999'999, 100'000));
  EXPECT_FALSE(pose_at(trajectory, 1'200'002, 100'000));
  EXPECT_FALSE(pose_at(trajectory, 1'150'000, 100'000));  // between poses 100 001 us apart
  EXPECT_FALSE(pose_at({}, 0, 100'000));
}

TEST(ReadTrajectory, TakesCommentsAndSortsByTime) {
  testing::TemporaryFolder folder;
  testing::write_text(folder / "t.txt",
                      "# timestamp tx ty tz qx qy qz qw\n\n2.5 1 2 3 0 0 0.7071 0.7071\n"
                      "1.5 0 0 0 0 0 0 1\n1.5 9 9 9 0 0 0 1\n");
  const auto trajectory = read_trajectory(folder / "t.txt");
  ASSERT_EQ(trajectory.size(), 2U);
  EXPECT_EQ(trajectory[0].utime, 1'500'000);
  EXPECT_EQ(trajectory[0].T_world_camera.translation(), Eigen::Vector3d::Zero());
  const Eigen::Isometry3d& T = trajectory[1].T_world_camera;
  EXPECT_LT((T.linear() * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 1e-12);
  EXPECT_EQ(T.translation(), Eigen::Vector3d(1.0, 2.0, 3.0));
}

TEST(ReadTrajectory, NamesTheLineThatIsWrong) {
  testing::TemporaryFolder folder;
  const std::pair<const char*, const char*> cases[] = {
      {"1.0 0 0 0 0 0 1", "7 words where 8 are wanted"},
      {"1.0 0 0 0 0 0 0 0", "the quaternion does not have length 1"},
      {"1.0 0 inf 0 0 0 0 1", "'inf' is not a finite number"},
      {"now 0 0 0 0 0 0 1", "'now' is no time stamp"}};
  for (const auto& [line, why] : cases) {
    testing::write_text(folder / "t.txt", std::string("# head\n") + line + "\n");
    EXPECT_THAT(
        [&] { read_trajectory(folder / "t.txt"); },
        ThrowsMessage<SourceError>(::testing::AllOf(HasSubstr("t.txt, line 2: "), HasSubstr(why))));
  }
}

}  // namespace
}  // namespace geomap::drivers
