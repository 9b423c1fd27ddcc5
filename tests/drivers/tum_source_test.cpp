// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/tum_source.hpp"

#include "drivers/data_set_writer.hpp"

namespace geomap::drivers {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// Depth at 0, 100 and 200 ms; colour 5 ms later, but 21 ms late for the second; truth at every 50
// ms.
class Tum : public ::testing::Test {
 protected:
  testing::TemporaryFolder root_;
  const std::filesystem::path folder_ = root_ / "rgbd_dataset_freiburg1_desk";

  void SetUp() override {
    std::filesystem::create_directories(folder_ / "depth");
    std::filesystem::create_directories(folder_ / "rgb");
    testing::write_text(folder_ / "depth.txt",
                        "# depth maps\n10.000000 depth/0.png\n10.100000 depth/1.png\n"
                        "10.200000 depth/2.png\n");
    testing::write_text(folder_ / "rgb.txt",
                        "# color images\n10.005000 rgb/0.png\n10.121000 rgb/1.png\n"
                        "10.205000 rgb/2.jpg\n");
    testing::write_text(folder_ / "groundtruth.txt",
                        "# ground truth trajectory\n10.1500 1 0 0 0 0 0 1\n"
                        "10.2500 3 0 0 0 0 0 1\n");
    for (const int i : {0, 1, 2}) {
      testing::write_depth_png(folder_ / ("depth/" + std::to_string(i) + ".png"),
                               {2, 1, {5000, static_cast<std::uint16_t>(10'000 + i)}});
    }
    testing::write_color_png(folder_ / "rgb/0.png", testing::some_color(0, 2, 1));
    testing::write_jpeg(folder_ / "rgb/2.jpg", testing::some_color(2, 2, 1));
  }
};

TEST_F(Tum, AFrameIsADepthImageWithTheColorNearestInTime) {
  TumSource source(folder_);
  ASSERT_EQ(source.size(), 2U);
  EXPECT_EQ(source.remark(), "1 depth images without a colour image within 20 ms left out");

  const auto first = source.next();
  EXPECT_EQ(first->frame.utime, 10'000'000);
  EXPECT_THAT(first->frame.depth.millimetres, ::testing::ElementsAre(1000, 2000));
  EXPECT_EQ(first->frame.color.rgb, testing::some_color(0, 2, 1).rgb);
  const auto second = source.next();
  EXPECT_EQ(second->frame.utime, 10'200'000);
  EXPECT_EQ(second->frame.sequence, 1);
  EXPECT_EQ(second->jpeg, testing::file_bytes(folder_ / "rgb/2.jpg"));
  EXPECT_FALSE(source.next());
}

TEST_F(Tum, TruthIsInterpolatedToTheDepthImagesTime) {
  TumSource source(folder_);
  EXPECT_TRUE(source.has_truth());
  EXPECT_FALSE(source.next()->truth_T_world_camera);  // before the trajectory
  EXPECT_NEAR(source.next()->truth_T_world_camera->translation().x(), 2.0, 1e-12);

  std::filesystem::remove(folder_ / "groundtruth.txt");
  EXPECT_FALSE(TumSource(folder_).has_truth());
}

TEST_F(Tum, TheRangeCountsAssociatedFrames) {
  TumSource source(folder_, {1, 1});
  EXPECT_EQ(source.next()->frame.utime, 10'200'000);
  EXPECT_FALSE(source.next());
  EXPECT_THAT(
      [&] {
        TumSource(folder_, {2, 9});
      },
      ThrowsMessage<SourceError>(HasSubstr("no frame 2 to 9, there are frames 0 to 1")));
}

TEST_F(Tum, IntrinsicsFollowTheFoldersName) {
  const geometry::CameraModel freiburg1{640, 480, 517.3, 516.5, 318.6, 255.3};
  const geometry::CameraModel freiburg2{640, 480, 520.9, 521.0, 325.1, 249.7};
  const geometry::CameraModel freiburg3{640, 480, 535.4, 539.2, 320.1, 247.6};
  const geometry::CameraModel ros{640, 480, 525.0, 525.0, 319.5, 239.5};
  EXPECT_EQ(tum_camera(folder_), freiburg1);
  EXPECT_EQ(tum_camera(folder_ / ""), freiburg1);
  EXPECT_EQ(tum_camera("/data/rgbd_dataset_freiburg2_pioneer_360/"), freiburg2);
  EXPECT_EQ(tum_camera("/data/freiburg1/rgbd_dataset_freiburg3_cabinet"), freiburg3);
  EXPECT_EQ(tum_camera("/data/my_desk"), ros);

  const auto frame = TumSource(folder_).next()->frame;
  EXPECT_DOUBLE_EQ(frame.depth_camera.fx, 517.3 * 2 / 640);
  EXPECT_EQ(frame.color_camera, frame.depth_camera);
}

TEST_F(Tum, MissingListsAreNamed) {
  std::filesystem::remove(folder_ / "rgb.txt");
  EXPECT_THAT([&] { TumSource{folder_}; },
              ThrowsMessage<SourceError>(HasSubstr("not a TUM RGB-D sequence: no rgb.txt in it")));
  std::filesystem::remove(folder_ / "depth.txt");
  EXPECT_THAT([&] { TumSource{folder_}; },
              ThrowsMessage<SourceError>(HasSubstr("no depth.txt and no rgb.txt in it")));
  EXPECT_THAT([&] { TumSource{folder_ / "nowhere"}; },
              ThrowsMessage<SourceError>(HasSubstr("nowhere: no such folder")));
}

TEST_F(Tum, AListedImageThatIsMissingIsAnErrorOfThatFrame) {
  std::filesystem::remove(folder_ / "depth/0.png");
  TumSource source(folder_);
  EXPECT_THAT([&] { source.next(); },
              ThrowsMessage<SourceError>(HasSubstr("depth/0.png: no such file")));
  EXPECT_EQ(source.next()->frame.utime, 10'200'000);
}

TEST_F(Tum, BadListsAreRefusedByLine) {
  testing::write_text(folder_ / "depth.txt", "# head\n10.0\n");
  EXPECT_THAT([&] { TumSource{folder_}; },
              ThrowsMessage<SourceError>(HasSubstr("depth.txt, line 2: no file name")));
  testing::write_text(folder_ / "depth.txt", "99.0 depth/0.png\n");
  EXPECT_THAT([&] { TumSource{folder_}; },
              ThrowsMessage<SourceError>(
                  HasSubstr("none of the 1 depth images has a colour image within 20 ms")));
}

}  // namespace
}  // namespace geomap::drivers
