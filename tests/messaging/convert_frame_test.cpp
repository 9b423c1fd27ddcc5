// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/convert_frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "messaging/depth_codec.hpp"
#include "messaging/encode.hpp"
#include "messaging/jpeg.hpp"
#include "messaging/safe_decode.hpp"
#include "support/plane_renderer.hpp"

namespace geomap::messaging {
namespace {

geometry::RgbdFrame some_frame() {
  const geometry::CameraModel camera = testing::kinect_camera(8);
  const Eigen::Isometry3d T = testing::look_at({2.0, 2.0, 1.5}, {0.0, 0.0, 0.5});
  geometry::RgbdFrame frame = testing::render(testing::small_room(), camera, T, 0.003).frame;
  frame.utime = 1'000'000'000'033'333;
  frame.sequence = 17;
  frame.sensor = "kinect";
  frame.color_camera = camera;
  frame.color = {camera.width, camera.height,
                 std::vector<std::uint8_t>(frame.depth.millimetres.size() * 3, 77)};
  return frame;
}

rgbd_frame_t sent(const rgbd_frame_t& message) {
  const std::vector<std::uint8_t> bytes = encode(message);
  auto result = safe_decode<rgbd_frame_t>(bytes.data(), bytes.size());
  if (!result.message) throw std::runtime_error(to_string(result.reason));
  return *result.message;
}

TEST(ConvertFrame, EverythingButColorIsTheSameAfterTheWire) {
  const geometry::RgbdFrame frame = some_frame();
  const FrameResult back = to_frame(sent(to_message(frame)));
  ASSERT_TRUE(back.frame) << to_string(back.fault);
  EXPECT_EQ(back.frame->utime, frame.utime);
  EXPECT_EQ(back.frame->sequence, frame.sequence);
  EXPECT_EQ(back.frame->sensor, frame.sensor);
  EXPECT_EQ(back.frame->depth.width, frame.depth.width);
  EXPECT_EQ(back.frame->depth.millimetres, frame.depth.millimetres);
  EXPECT_EQ(back.frame->depth_camera, frame.depth_camera);
  EXPECT_EQ(back.frame->color_camera, frame.color_camera);
  ASSERT_EQ(back.frame->color.rgb.size(), frame.color.rgb.size());
  EXPECT_NEAR(back.frame->color.rgb[0], 77, 2);
}

TEST(ConvertFrame, CorrectingAMessageIsCorrectingItsFrame) {
  const geometry::RgbdFrame frame = some_frame();
  const geometry::DepthCorrection correction(geometry::DepthCorrection::Terms::Constant(0.002));
  rgbd_frame_t message = to_message(frame);
  const std::vector<std::uint8_t> color = message.color.data;
  correct_depth(message, correction);
  const FrameResult back = to_frame(sent(message));
  ASSERT_TRUE(back.frame) << to_string(back.fault);
  EXPECT_EQ(back.frame->depth.millimetres,
            geometry::corrected(frame, correction).depth.millimetres);
  EXPECT_NE(back.frame->depth.millimetres, frame.depth.millimetres);
  EXPECT_EQ(message.color.data, color);
}

TEST(ConvertFrame, AMessageThatCannotBeDecodedIsNotCorrected) {
  rgbd_frame_t message = to_message(some_frame());
  message.depth.data.resize(10);
  const std::vector<std::uint8_t> before = encode(message);
  correct_depth(message,
                geometry::DepthCorrection(geometry::DepthCorrection::Terms::Constant(0.1)));
  EXPECT_EQ(encode(message), before);
}

TEST(ConvertFrame, ReadyJpegBytesTravelUnchanged) {
  geometry::RgbdFrame frame = some_frame();
  const std::vector<std::uint8_t> jpeg = encode_jpeg(frame.color, 50);
  frame.color = {};  // an importer has the bytes only
  const rgbd_frame_t message = sent(to_message(frame, jpeg));
  EXPECT_EQ(message.color.data, jpeg);
  EXPECT_EQ(to_frame(message).frame->color.rgb, decode_jpeg(jpeg)->rgb);
}

TEST(ConvertFrame, AFrameWithoutColorIsAFrame) {
  geometry::RgbdFrame frame = some_frame();
  frame.color = {};
  const FrameResult back = to_frame(sent(to_message(frame)));
  ASSERT_TRUE(back.frame);
  EXPECT_TRUE(back.frame->color.empty());
}

TEST(ConvertFrame, ColorCanBeSkipped) {
  const FrameResult back = to_frame(sent(to_message(some_frame())), ColorUse::kSkip);
  ASSERT_TRUE(back.frame);
  EXPECT_TRUE(back.frame->color.empty());
  EXPECT_FALSE(back.frame->depth.empty());
}

TEST(ConvertFrame, ImagesThatDoNotFitTheirCamerasAreACallersMistake) {
  geometry::RgbdFrame frame = some_frame();
  frame.depth_camera.width += 1;
  EXPECT_THROW(to_message(frame), std::invalid_argument);
  frame = some_frame();
  frame.depth.millimetres.pop_back();
  EXPECT_THROW(to_message(frame), std::invalid_argument);
  frame = some_frame();
  frame.color_camera = {};
  EXPECT_THROW(to_message(frame), std::invalid_argument);
  frame.color = {};
  const std::vector<std::uint8_t> jpeg = {1, 2, 3};
  EXPECT_THROW(to_message(frame, jpeg), std::invalid_argument);
}

/// A sound message in which one thing is wrong.
class HostileFrame : public ::testing::Test {
 protected:
  FrameFault fault() const { return to_frame(message_).fault; }
  rgbd_frame_t message_ = sent(to_message(some_frame()));
};

TEST_F(HostileFrame, IsAcceptedAsLongAsNothingIsWrong) { EXPECT_EQ(fault(), FrameFault::kNone); }

TEST_F(HostileFrame, WithImagesOfAnotherSizeThanItsCamera) {
  message_.depth_camera.height += 1;
  EXPECT_EQ(fault(), FrameFault::kBadSize);
}

TEST_F(HostileFrame, WithAbsurdSizes) {
  for (const int size : {0, -1, 100000, std::numeric_limits<int>::max()}) {
    message_.depth.width = message_.depth_camera.width = size;
    EXPECT_NE(fault(), FrameFault::kNone) << size;
  }
}

TEST_F(HostileFrame, WithAbsurdStrides) {
  for (const int stride : {-1, 1, 1'000'000, std::numeric_limits<int>::max()}) {
    message_.depth.row_stride = stride;
    EXPECT_EQ(fault(), FrameFault::kBadSize) << stride;
  }
}

TEST_F(HostileFrame, WithAnUnknownPixelFormat) {
  message_.depth.pixelformat = bot_core::image_t::PIXEL_FORMAT_GRAY;
  EXPECT_EQ(fault(), FrameFault::kBadFormat);
}

TEST_F(HostileFrame, WithAnUnknownColorFormat) {
  message_.color.pixelformat = 12345;
  EXPECT_EQ(fault(), FrameFault::kBadFormat);
}

TEST_F(HostileFrame, WithDamagedDepth) {
  message_.depth.data[message_.depth.data.size() / 2] ^= 0x10;
  EXPECT_EQ(fault(), FrameFault::kBadDepth);
  message_.depth.data.clear();
  EXPECT_EQ(fault(), FrameFault::kBadDepth);
}

TEST_F(HostileFrame, WithDamagedColor) {
  message_.color.data.resize(message_.color.data.size() / 2);
  EXPECT_EQ(fault(), FrameFault::kBadJpeg);
}

TEST_F(HostileFrame, WithColorOfAnotherSizeThanItSays) {
  message_.color.data = encode_jpeg({16, 16, std::vector<std::uint8_t>(768, 1)});
  EXPECT_EQ(fault(), FrameFault::kBadJpeg);
}

TEST_F(HostileFrame, WithImpossibleIntrinsics) {
  message_.depth_camera.fx = 0.0;
  EXPECT_EQ(fault(), FrameFault::kBadIntrinsics);
  message_.depth_camera.fx = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fault(), FrameFault::kBadIntrinsics);
}

TEST_F(HostileFrame, WithoutASingleReading) {
  std::vector<std::uint16_t> nothing(
      static_cast<std::size_t>(message_.depth.width * message_.depth.height), 0);
  nothing[3] = geometry::DepthImage::kInvalid;
  message_.depth.data = compress_depth(nothing);
  EXPECT_EQ(fault(), FrameFault::kNoReading);
}

TEST(FrameFault, EveryFaultHasANameOfItsOwn) {
  std::vector<std::string> names;
  for (int i = 0; i <= static_cast<int>(FrameFault::kNoReading); ++i) {
    names.push_back(to_string(static_cast<FrameFault>(i)));
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

}  // namespace
}  // namespace geomap::messaging
