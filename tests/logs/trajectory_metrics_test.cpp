// SPDX-License-Identifier: BSD-3-Clause
#include "logs/trajectory_metrics.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "logs/pose_pairs.hpp"

namespace geomap::logs {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using ::testing::AllOf;
using testing::at;
using ::testing::HasSubstr;
using testing::noisy_walk;
using ::testing::Not;
using testing::pairs_of;
using testing::some_motion;
using ::testing::ThrowsMessage;
using testing::with_estimate_moved;

Trajectory stamped(const std::vector<std::int64_t>& utimes) {
  Trajectory trajectory;
  for (const std::int64_t utime : utimes) {
    trajectory.emplace_back(utime, at({static_cast<double>(utime), 0, 0}));
  }
  return trajectory;
}

double rmse_after(const Isometry3d& T, const std::vector<PosePair>& pairs) {
  double sum = 0.0;
  for (const PosePair& pair : pairs) {
    sum += (T * pair.T_world_estimate.translation() - pair.T_world_reference.translation())
               .squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(pairs.size()));
}

// Horn 1987: the rotation as the eigenvector of a 4 x 4 matrix, another way than by an SVD.
Isometry3d horn(const std::vector<PosePair>& pairs) {
  Vector3d p_mean = Vector3d::Zero(), q_mean = Vector3d::Zero();
  for (const PosePair& pair : pairs) {
    p_mean += pair.T_world_estimate.translation() / static_cast<double>(pairs.size());
    q_mean += pair.T_world_reference.translation() / static_cast<double>(pairs.size());
  }
  Eigen::Matrix3d S = Eigen::Matrix3d::Zero();
  for (const PosePair& pair : pairs) {
    S += (pair.T_world_estimate.translation() - p_mean) *
         (pair.T_world_reference.translation() - q_mean).transpose();
  }
  Eigen::Matrix4d N;
  N << S.trace(), S(1, 2) - S(2, 1), S(2, 0) - S(0, 2), S(0, 1) - S(1, 0),  //
      S(1, 2) - S(2, 1), S(0, 0) - S(1, 1) - S(2, 2), S(0, 1) + S(1, 0), S(2, 0) + S(0, 2),
      S(2, 0) - S(0, 2), S(0, 1) + S(1, 0), S(1, 1) - S(0, 0) - S(2, 2), S(1, 2) + S(2, 1),
      S(0, 1) - S(1, 0), S(2, 0) + S(0, 2), S(1, 2) + S(2, 1), S(2, 2) - S(0, 0) - S(1, 1);
  const Eigen::Vector4d v = Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(N).eigenvectors().col(3);
  Isometry3d T(Eigen::Quaterniond(v[0], v[1], v[2], v[3]));
  T.translation() = q_mean - T.linear() * p_mean;
  return T;
}

TEST(ErrorStatistics, AreThoseOfFourNumbersByHand) {
  // 1 2 3 6: mean 3, median 2.5, squares 1 + 4 + 9 + 36 = 50, about the mean 4 + 1 + 0 + 9 = 14.
  const ErrorStatistics s = error_statistics({3.0, 1.0, 6.0, 2.0});
  EXPECT_EQ(s.count, 4U);
  EXPECT_DOUBLE_EQ(s.mean, 3.0);
  EXPECT_DOUBLE_EQ(s.median, 2.5);
  EXPECT_DOUBLE_EQ(s.max, 6.0);
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(50.0 / 4.0));
  EXPECT_DOUBLE_EQ(s.deviation, std::sqrt(14.0 / 4.0));
  EXPECT_DOUBLE_EQ(error_statistics({3.0, 1.0, 6.0}).median, 3.0);
  EXPECT_EQ(error_statistics({}).count, 0U);
}

TEST(MatchPoses, EachPoseFindsTheNearestWithinTheDifference) {
  const auto pairs = match_poses(stamped({100'003, 199'990, 300'000}),
                                 stamped({100'000, 110'000, 200'000, 320'001}), 0.02);
  ASSERT_EQ(pairs.size(), 2U);  // 300 000 is 20 001 us from the last
  EXPECT_EQ(pairs[0].utime, 100'000);
  EXPECT_EQ(pairs[0].T_world_estimate.translation().x(), 100'003.0);
  EXPECT_EQ(pairs[0].T_world_reference.translation().x(), 100'000.0);
  EXPECT_EQ(pairs[1].utime, 200'000);
  EXPECT_EQ(pairs[1].T_world_estimate.translation().x(), 199'990.0);
}

TEST(MatchPoses, NoPoseIsUsedTwice) {
  // 10 and 12 are both nearest to 11 ms; 12 comes first, being 0.5 ms off, and 10 takes what is
  // left.
  const auto pairs = match_poses(stamped({10'000, 12'000}), stamped({11'500, 25'000}), 0.02);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].T_world_estimate.translation().x(), 12'000.0);
  EXPECT_EQ(pairs[1].T_world_estimate.translation().x(), 10'000.0);
  EXPECT_EQ(match_poses(stamped({10'000, 12'000}), stamped({11'500}), 0.02).size(), 1U);
}

TEST(MatchPoses, ADifferenceThatMakesNoSenseIsRefused) {
  for (const double difference : {0.0, -1.0, 11.0, 1e300, std::nan("")}) {
    EXPECT_THROW(match_poses(stamped({1}), stamped({1}), difference), std::invalid_argument);
  }
}

TEST(CompareTrajectories, TooFewMatchesSayHowManyAndWithinWhat) {
  EXPECT_THAT(
      [] {
        compare_trajectories(stamped({0, 1'000'000}), stamped({10'000, 5'000'000}), 0.02);
      },
      ThrowsMessage<std::runtime_error>(
          AllOf(HasSubstr("only 1 of 2 poses match one of the reference's 2 within 0.02 s"),
                Not(HasSubstr("\n")))));
  EXPECT_THROW(compare_trajectories(stamped({0, 1, 2}), stamped({100'000, 100'001, 100'002}), 0.02),
               std::runtime_error);
  EXPECT_NO_THROW(compare_trajectories(stamped({0, 1, 2}), stamped({0, 1, 2}), 0.02));
}

// A square whose first corner is estimated 4 d too far out along x. The mean moves by d along x;
// the centred corners are (1 + 3d, 0) (-d, 1) (-1 - d, 0) (-d, -1), whose products with the
// reference's corners have no xy part, so that nothing turns: errors 3d, d, d, d.
TEST(AlignedError, OneCornerOfASquareDisplacedIsAsByHand) {
  const double d = 0.01;
  const std::vector<Vector3d> square = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  std::vector<Vector3d> estimate = square;
  estimate[0].x() += 4 * d;
  const AbsoluteError error = aligned_error(pairs_of(estimate, square));
  EXPECT_NEAR(error.statistics.rmse, std::sqrt(12.0 / 4.0) * d, 1e-12);
  EXPECT_NEAR(error.statistics.mean, 6.0 / 4.0 * d, 1e-12);
  EXPECT_NEAR(error.statistics.median, d, 1e-12);
  EXPECT_NEAR(error.statistics.max, 3.0 * d, 1e-12);
  EXPECT_NEAR(error.statistics.deviation, std::sqrt(3.0 - 2.25) * d, 1e-12);
  EXPECT_LT((error.T_reference_estimate.translation() - Vector3d(-d, 0, 0)).norm(), 1e-12);
}

TEST(AlignedError, ScaleIsNotTakenOut) {
  // Twice as large: each corner of the square is off by 1.
  const std::vector<Vector3d> square = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  std::vector<Vector3d> estimate = square;
  for (Vector3d& corner : estimate) corner *= 2.0;
  EXPECT_NEAR(aligned_error(pairs_of(estimate, square)).statistics.rmse, 1.0, 1e-12);
}

TEST(AlignedError, DoesNotChangeWhenTheEstimateIsMovedAsAWhole) {
  const auto pairs = noisy_walk(1);
  const AbsoluteError here = aligned_error(pairs);
  const AbsoluteError there = aligned_error(with_estimate_moved(pairs, some_motion()));
  for (std::size_t i = 0; i < pairs.size(); ++i) EXPECT_NEAR(here.errors[i], there.errors[i], 1e-9);
  EXPECT_TRUE(
      (there.T_reference_estimate * some_motion()).isApprox(here.T_reference_estimate, 1e-9));
}

TEST(AlignedError, AgreesWithHornsQuaternionAndNoMotionNearbyIsBetter) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const auto pairs = with_estimate_moved(noisy_walk(seed), some_motion());
    const AbsoluteError error = aligned_error(pairs);
    EXPECT_NEAR(error.statistics.rmse, rmse_after(horn(pairs), pairs), 1e-9);
    for (int axis = 0; axis < 3; ++axis) {
      for (const double step : {-1e-3, 1e-3}) {
        Isometry3d shifted = error.T_reference_estimate;
        shifted.pretranslate(Vector3d(step * Vector3d::Unit(axis)));
        EXPECT_GT(rmse_after(shifted, pairs), error.statistics.rmse);
        const Vector3d centre = pairs.front().T_world_reference.translation();
        const Isometry3d turned = Eigen::Translation3d(centre) *
                                  Eigen::AngleAxisd(step, Vector3d::Unit(axis)) *
                                  Eigen::Translation3d(-centre) * error.T_reference_estimate;
        EXPECT_GT(rmse_after(turned, pairs), error.statistics.rmse);
      }
    }
  }
}

TEST(AlignedError, AMirrorImageIsTurnedNotMirrored) {
  auto pairs = noisy_walk(2);
  for (PosePair& pair : pairs) pair.T_world_estimate.translation().z() *= -1.0;
  const AbsoluteError error = aligned_error(pairs);
  EXPECT_NEAR(error.T_reference_estimate.linear().determinant(), 1.0, 1e-9);
  EXPECT_NEAR(error.statistics.rmse, rmse_after(horn(pairs), pairs), 1e-9);
}

// 0, 1, 3 on a line against 0, 1, 2 on another: centred -4/3, -1/3, 5/3 against -1, 0, 1; the
// errors 1/3, 1/3, 2/3 have the squares 6/9.
TEST(AlignedError, OfPathsOnALineIsAsByHand) {
  const Vector3d along = Vector3d(1, 2, -2) / 3.0;
  const AbsoluteError error = aligned_error(
      pairs_of({{5, 0, 0}, {5, 1, 0}, {5, 3, 0}}, {0.0 * along, 1.0 * along, 2.0 * along}));
  EXPECT_NEAR(error.statistics.rmse, std::sqrt(6.0 / 9.0 / 3.0), 1e-12);
  EXPECT_NEAR(error.T_reference_estimate.linear().determinant(), 1.0, 1e-12);
}

TEST(AlignedError, OfACameraAtRestIsTheScatterAboutItsMean) {
  const Vector3d place(1000, 2000, 3);
  const std::vector<Vector3d> rest(4, place);
  EXPECT_EQ(aligned_error(pairs_of(rest, rest)).statistics.rmse, 0.0);
  // 0.1 m to either side, twice.
  const Vector3d aside(0.1, 0, 0);
  const auto pairs = pairs_of({place + aside, place - aside, place + aside, place - aside}, rest);
  EXPECT_NEAR(aligned_error(pairs).statistics.rmse, 0.1, 1e-9);
}

}  // namespace
}  // namespace geomap::logs
