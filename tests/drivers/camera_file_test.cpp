// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/camera_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "drivers/data_set_writer.hpp"
#include "drivers/frame_source.hpp"

namespace geomap::drivers {
namespace {

using geometry::DepthCorrection;
using ::testing::HasSubstr;

class CameraFileTest : public ::testing::Test {
 protected:
  std::filesystem::path path() const { return folder_ / "camera.yaml"; }
  void write(const std::string& text) const { std::ofstream(path()) << text; }
  std::string error_of(const std::string& text) const {
    write(text);
    try {
      read_camera_file(path());
    } catch (const SourceError& error) {
      return error.what();
    }
    return "none";
  }

 private:
  testing::TemporaryFolder folder_;
};

TEST_F(CameraFileTest, WhatIsWrittenComesBackToTheLastBit) {
  CameraFile file;
  file.name = "robot 1: \"front\"";
  file.depth = {640, 480, 575.8 + 1e-13, 576.1, 1.0 / 3.0, 239.5};
  DepthCorrection::Terms terms;
  for (int i = 0; i < DepthCorrection::kTerms; ++i) terms(i) = 1e-3 / (3.0 + i);
  file.correction = DepthCorrection(terms);
  write_camera_file(file, path());
  const CameraFile read = read_camera_file(path());
  EXPECT_EQ(read.name, file.name);
  ASSERT_TRUE(read.depth);
  EXPECT_EQ(read.depth->fx, file.depth->fx);
  EXPECT_EQ(read.depth->cx, file.depth->cx);
  EXPECT_FALSE(read.color);
  EXPECT_EQ(read.correction.coefficients(), terms);
}

TEST_F(CameraFileTest, ACameraWithoutCorrectionHasNone) {
  write("name: x\ncolor: {width: 640, height: 480, fx: 525, fy: 525, cx: 319.5, cy: 239.5}\n");
  const CameraFile read = read_camera_file(path());
  EXPECT_TRUE(read.correction.is_none());
  EXPECT_EQ(read.color.value().width, 640);
}

TEST_F(CameraFileTest, TheFilesOfTheProjectCanBeRead) {
  const CameraFile kinect =
      read_camera_file(std::filesystem::path(GEOMAP_SOURCE_DIR) / "config/cameras/kinect-v1.yaml");
  EXPECT_TRUE(kinect.depth.value().valid());
  EXPECT_TRUE(kinect.color.value().valid());
}

TEST_F(CameraFileTest, WhatIsWrongIsSaidWithItsPlace) {
  EXPECT_THAT(error_of("nam: x\n"), HasSubstr("camera.yaml:1"));
  EXPECT_THAT(error_of("name: x\ndepth_correction: [1, 2]\n"), HasSubstr("camera.yaml:2"));
  EXPECT_THAT(error_of("name: x\ndepth_correction: [2,0,0,0,0,0,0,0,0,0,0,0,0,0]\n"),
              HasSubstr("too large"));
  EXPECT_THAT(error_of("name: x\ndepth: {width: 640.5, height: 480, fx: 1, fy: 1, cx: 0, cy: 0}\n"),
              HasSubstr("no size of an image"));
  EXPECT_THAT(error_of("name: x\ndepth: {width: 640, height: 480, fx: 0, fy: 1, cx: 0, cy: 0}\n"),
              HasSubstr("fx"));
  EXPECT_THAT(error_of("name: x\ndepth_correction: [.nan,0,0,0,0,0,0,0,0,0,0,0,0,0]\n"),
              HasSubstr("camera.yaml:2"));
}

}  // namespace
}  // namespace geomap::drivers
