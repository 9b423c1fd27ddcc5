// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/kinect_disparity.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace geomap::drivers {
namespace {

// By libfreenect's formula with its default constants, worked out apart from this code.
TEST(KinectDisparity, DepthsAreThoseOfLibfreenect) {
  EXPECT_EQ(millimetres_of_disparity(300), 438);
  EXPECT_EQ(millimetres_of_disparity(600), 706);
  EXPECT_EQ(millimetres_of_disparity(800), 1194);
  EXPECT_EQ(millimetres_of_disparity(900), 1824);
  EXPECT_EQ(millimetres_of_disparity(1000), 3864);
  EXPECT_EQ(millimetres_of_disparity(1050), 8767);
}

TEST(KinectDisparity, NoReadingAndWhatIsTooFarHaveNoDepth) {
  EXPECT_EQ(millimetres_of_disparity(kNoDisparity), 0);
  EXPECT_EQ(millimetres_of_disparity(1070), 0);
  EXPECT_EQ(millimetres_of_disparity(1500), 0);
  EXPECT_EQ(disparity_of_millimetres(0), kNoDisparity);
  EXPECT_EQ(disparity_of_millimetres(10001), kNoDisparity);
}

TEST(KinectDisparity, TheInverseIsOffByHalfAStepAtMost) {
  for (int mm = 500; mm <= 9000; ++mm) {
    const std::uint16_t disparity = disparity_of_millimetres(static_cast<std::uint16_t>(mm));
    const int back = millimetres_of_disparity(disparity);
    const int next = millimetres_of_disparity(static_cast<std::uint16_t>(disparity + 1));
    EXPECT_LE(std::abs(back - mm), (next - back) / 2 + 1) << mm;
  }
}

TEST(KinectDisparity, TheDepthCameraHasTheFocalLengthOfLibfreenect) {
  EXPECT_NEAR(nominal_kinect_depth_camera().fx, 120.0 / (2.0 * 0.1042), 1e-9);
}

}  // namespace
}  // namespace geomap::drivers
