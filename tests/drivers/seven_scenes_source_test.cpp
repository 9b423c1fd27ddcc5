// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/seven_scenes_source.hpp"

#include "drivers/data_set_writer.hpp"
#include "support/recordings.hpp"

namespace geomap::drivers {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

class SevenScenes : public ::testing::Test {
 protected:
  testing::TemporaryFolder folder_;

  void write_frames(std::initializer_list<int> numbers) {
    for (const int number : numbers) testing::write_seven_scenes_frame(folder_.path(), number);
  }
  void write_pose(int number, const Eigen::Matrix4d& M, int digits = 18) {
    testing::write_text(folder_ / testing::frame_name(number, ".pose.txt"),
                        testing::pose_text(M, digits));
  }
  void expect_refused(const std::string& why, FrameRange range = {}) {
    EXPECT_THAT(
        [&] { SevenScenesSource(folder_.path(), range); },
        ThrowsMessage<SourceError>(AllOf(HasSubstr(folder_.path().string()), HasSubstr(why))));
  }
};

std::vector<std::int64_t> utimes_after_start(SevenScenesSource source) {
  std::vector<std::int64_t> utimes;
  while (const auto out = source.next()) {
    EXPECT_EQ(out->frame.sequence, static_cast<std::int64_t>(utimes.size()));
    utimes.push_back(out->frame.utime - 1'000'000'000'000'000);
  }
  return utimes;
}

TEST(SevenScenesUtime, IsTheNearestMicrosecondToThirtyFramesASecond) {
  EXPECT_EQ(seven_scenes_utime(0), 1'000'000'000'000'000);
  for (std::int64_t i = 0; i < 100'000; ++i) {
    const std::int64_t error = 30 * (seven_scenes_utime(i) - seven_scenes_utime(0)) - i * 1'000'000;
    ASSERT_LT(std::abs(error), 15) << i;  // in units of 1/30 us
  }
}

TEST_F(SevenScenes, FramesComeInTheOrderOfTheirFileNumbers) {
  write_frames({12, 2, 0});
  EXPECT_EQ(SevenScenesSource(folder_.path()).size(), 3U);
  EXPECT_THAT(utimes_after_start(SevenScenesSource(folder_.path())),
              ElementsAre(0, 66'667, 400'000));
}

TEST_F(SevenScenes, BothEndsOfTheRangeBelongToIt) {
  write_frames({0, 3, 6, 9, 12});
  EXPECT_THAT(utimes_after_start(SevenScenesSource(folder_.path(), {3, 9})),
              ElementsAre(100'000, 200'000, 300'000));
}

TEST_F(SevenScenes, AFrameHoldsItsFilesContents) {
  write_frames({7});
  const auto out = SevenScenesSource(folder_.path()).next();
  ASSERT_TRUE(out);
  auto expected = testing::some_depth(7).millimetres;
  expected[2] = geometry::DepthImage::kNoReading;
  EXPECT_EQ(out->frame.depth.millimetres, expected);
  EXPECT_EQ(out->jpeg, testing::file_bytes(folder_ / "frame-000007.color.jpg"));
  EXPECT_TRUE(out->frame.color.empty());
  EXPECT_EQ(out->frame.color_camera.width, 20);
  EXPECT_TRUE(out->truth_T_world_camera->isApprox(testing::some_pose(7), 1e-14));
}

TEST_F(SevenScenes, ColorMayBeAPngOrBeMissingEverywhere) {
  write_frames({0});
  std::filesystem::remove(folder_ / "frame-000000.color.jpg");
  const auto without = SevenScenesSource(folder_.path()).next();
  EXPECT_TRUE(without->jpeg.empty() && without->frame.color.empty());

  testing::write_color_png(folder_ / "frame-000000.color.png", testing::some_color(4));
  const auto with = SevenScenesSource(folder_.path()).next();
  EXPECT_EQ(with->frame.color.rgb, testing::some_color(4).rgb);
}

TEST_F(SevenScenes, AnImageMissingAmongOthersIsAnErrorOfThatFrameOnly) {
  write_frames({0, 1, 2, 3});
  std::filesystem::remove(folder_ / "frame-000000.color.jpg");
  std::filesystem::remove(folder_ / "frame-000002.depth.png");
  SevenScenesSource source(folder_.path());
  EXPECT_EQ(source.size(), 4U);
  EXPECT_THAT([&] { source.next(); },
              ThrowsMessage<SourceError>(HasSubstr("frame-000000.color.jpg: no such file")));
  EXPECT_EQ(source.next()->frame.sequence, 0);
  EXPECT_THAT([&] { source.next(); },
              ThrowsMessage<SourceError>(HasSubstr("frame-000002.depth.png: no such file")));
  EXPECT_EQ(source.next()->frame.utime, seven_scenes_utime(3));
  EXPECT_FALSE(source.next());
}

TEST_F(SevenScenes, IntrinsicsComeFromTheFolderElseTheyAreThePublishedOnes) {
  testing::write_depth_png(folder_ / "frame-000000.depth.png", testing::some_depth(0, 640, 480));
  const geometry::CameraModel published{640, 480, 585.0, 585.0, 320.0, 240.0};
  EXPECT_EQ(SevenScenesSource(folder_.path()).next()->frame.depth_camera, published);

  testing::write_text(folder_ / "camera-intrinsics.txt",
                      "5.1e+02 0.0 3.1e+02\n0.0 5.2e+02 2.3e+02\n0.0 0.0 1.0\n");
  const geometry::CameraModel given{640, 480, 510.0, 520.0, 310.0, 230.0};
  EXPECT_EQ(SevenScenesSource(folder_.path()).next()->frame.depth_camera, given);

  testing::write_text(folder_ / "camera-intrinsics.txt", "510 0 310\n0 -520 230\n0 0 1\n");
  EXPECT_THROW(SevenScenesSource{folder_.path()}, SourceError);
}

TEST_F(SevenScenes, PublishedIntrinsicsAreScaledToTheImagesSize) {
  testing::write_depth_png(folder_ / "frame-000000.depth.png", testing::some_depth(0, 320, 240));
  const geometry::CameraModel half = SevenScenesSource(folder_.path()).next()->frame.depth_camera;
  const geometry::CameraModel full{640, 480, 585.0, 585.0, 320.0, 240.0};
  // The centre of a pixel of the half image lies between the centres of pixels 2u and 2u + 1.
  EXPECT_LT((half.ray(30, 50) - full.ray(60.5, 100.5)).norm(), 1e-12);
}

TEST_F(SevenScenes, APosePrintedWithFewDigitsBecomesARotationAgain) {
  write_frames({0});
  write_pose(0, testing::some_pose(5).matrix(), 4);
  const Eigen::Isometry3d T = *SevenScenesSource(folder_.path()).next()->truth_T_world_camera;
  const Eigen::Matrix3d R = T.linear();
  EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_LT((T.matrix() - testing::some_pose(5).matrix()).norm(), 1e-3);
}

TEST_F(SevenScenes, APoseThatIsNoRigidTransformIsRefused) {
  write_frames({0});
  Eigen::Matrix4d scaled = testing::some_pose(1).matrix();
  scaled.topLeftCorner<3, 3>() *= 1.05;
  Eigen::Matrix4d mirrored = testing::some_pose(1).matrix();
  mirrored.col(0).head<3>() *= -1.0;
  Eigen::Matrix4d projective = testing::some_pose(1).matrix();
  projective(3, 0) = 0.5;
  for (const Eigen::Matrix4d& M : {scaled, mirrored, projective}) {
    write_pose(0, M);
    EXPECT_THAT(
        [&] { SevenScenesSource(folder_.path()).next(); },
        ThrowsMessage<SourceError>(HasSubstr("frame-000000.pose.txt: not a rigid transform")));
  }
  Eigen::Matrix4d lost = testing::some_pose(1).matrix();
  lost(0, 3) = std::numeric_limits<double>::quiet_NaN();
  write_pose(0, lost);
  EXPECT_THAT([&] { SevenScenesSource(folder_.path()).next(); },
              ThrowsMessage<SourceError>(HasSubstr("line 1: 'nan' is not a finite number")));
  testing::write_text(folder_ / "frame-000000.pose.txt", "1 0 0 0\n0 1 0 0\n");
  EXPECT_THAT([&] { SevenScenesSource(folder_.path()).next(); },
              ThrowsMessage<SourceError>(HasSubstr("8 numbers where a matrix of 4 x 4 is wanted")));
}

TEST_F(SevenScenes, AFrameWithoutPoseFileHasNoTruth) {
  write_frames({0, 1});
  std::filesystem::remove(folder_ / "frame-000000.pose.txt");
  SevenScenesSource source(folder_.path());
  EXPECT_TRUE(source.has_truth());
  EXPECT_FALSE(source.next()->truth_T_world_camera);
  EXPECT_TRUE(source.next()->truth_T_world_camera);
  EXPECT_FALSE(SevenScenesSource(folder_.path(), {0, 0}).has_truth());
}

TEST_F(SevenScenes, WhatIsNoSequenceIsRefusedWithWhatWasLookedFor) {
  expect_refused("not a 7-Scenes sequence: no frame-NNNNNN.depth.png in it");
  testing::write_text(folder_ / "frame-000000.pose.txt", "");
  testing::write_text(folder_ / "frame-000000.color.jpg", "");
  testing::write_text(folder_ / "frame--00001.depth.png", "");
  testing::write_text(folder_ / "frame-0000000001.depth.png", "");
  std::filesystem::create_directory(folder_ / "seq-02");
  std::filesystem::create_directory(folder_ / "seq-01");
  expect_refused("it holds seq-01");
  const std::filesystem::path file = folder_ / "frame-000000.pose.txt";
  EXPECT_THAT([&] { SevenScenesSource{file}; },
              ThrowsMessage<SourceError>(HasSubstr("not a folder")));
  EXPECT_THAT([&] { SevenScenesSource{folder_ / "nowhere"}; },
              ThrowsMessage<SourceError>(HasSubstr("nowhere: no such folder")));
}

TEST_F(SevenScenes, AnEmptyRangeIsRefusedWithWhatThereIs) {
  write_frames({3, 4});
  expect_refused("no frame 10 to 20, there are frames 3 to 4", {10, 20});
  expect_refused("no frame from 5 on, there are frames 3 to 4", {5});
  expect_refused("no frame 4 to 3", {4, 3});
}

TEST(SevenScenesRecording, TheRedKitchenHasRigidPosesAndPlausibleDepth) {
  GEOMAP_REQUIRE_RECORDING(folder, "redkitchen");
  SevenScenesSource source(folder, {0, 29});
  ASSERT_EQ(source.size(), 30U);
  std::optional<Eigen::Vector3d> last;
  while (const auto out = source.next()) {
    ASSERT_TRUE(out->truth_T_world_camera);
    const Eigen::Matrix3d R = out->truth_T_world_camera->linear();
    EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 1e-14);
    const Eigen::Vector3d position = out->truth_T_world_camera->translation();
    if (last) {
      EXPECT_LT((position - *last).norm(), 0.1);  // a hand moves slower than 3 m/s
    }
    last = position;
    const geometry::DepthImage& depth = out->frame.depth;
    const auto readings = std::count_if(depth.millimetres.begin(), depth.millimetres.end(),
                                        geometry::DepthImage::is_reading);
    EXPECT_GT(readings, 640 * 480 / 2);
    EXPECT_THAT(out->jpeg, ::testing::Not(IsEmpty()));
    EXPECT_EQ(out->frame.color_camera, out->frame.depth_camera);
  }
}

}  // namespace
}  // namespace geomap::drivers
