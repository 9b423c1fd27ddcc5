// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "messaging/convert_frame.hpp"
#include "messaging/depth_codec.hpp"
#include "messaging/jpeg.hpp"

namespace geomap::messaging {
namespace {

constexpr int kWidth = 6;
constexpr int kHeight = 4;
const geometry::CameraModel kCamera{kWidth, kHeight, 5.0, 5.0, 2.5, 1.5};
const FrameCameras kCameras{kCamera, kCamera};

std::vector<std::uint16_t> depth_values() {
  std::vector<std::uint16_t> values;
  for (int i = 0; i < kWidth * kHeight; ++i)
    values.push_back(static_cast<std::uint16_t>(500 + 40 * i));
  return values;
}

std::vector<std::uint8_t> plain_depth() {
  const std::vector<std::uint16_t> values = depth_values();
  return *inflate_bytes(compress_depth(values), 2 * values.size());
}

geometry::ColorImage color_image() {
  return {kWidth, kHeight, std::vector<std::uint8_t>(3 * kWidth * kHeight, 90)};
}

bot_core::image_t image(std::int32_t format, std::int32_t stride, std::vector<std::uint8_t> data) {
  bot_core::image_t message{};
  message.width = kWidth;
  message.height = kHeight;
  message.row_stride = stride;
  message.pixelformat = format;
  message.size = static_cast<std::int32_t>(data.size());
  message.data = std::move(data);
  return message;
}

/// As openni2-camera-lcm publishes with -j -z, or without.
bot_core::images_t openni_frame(bool compressed) {
  using bot_core::image_t;
  using bot_core::images_t;
  images_t message{};
  message.utime = 123456;
  message.n_images = 2;
  message.image_types = {images_t::LEFT,
                         compressed ? images_t::DEPTH_MM_ZIPPED : images_t::DEPTH_MM};
  message.images = {
      compressed ? image(image_t::PIXEL_FORMAT_MJPEG, 3 * kWidth, encode_jpeg(color_image()))
                 : image(image_t::PIXEL_FORMAT_RGB, 3 * kWidth, color_image().rgb),
      compressed ? image(image_t::PIXEL_FORMAT_INVALID, 2 * kWidth, compress_depth(depth_values()))
                 : image(image_t::PIXEL_FORMAT_BE_GRAY16, 2 * kWidth, plain_depth())};
  return message;
}

kinect::frame_msg_t kinect_frame(bool compressed) {
  kinect::frame_msg_t message{};
  message.timestamp = 999;
  message.depth.timestamp = 654321;
  message.depth.width = kWidth;
  message.depth.height = kHeight;
  message.depth.depth_data_format = kinect::depth_msg_t::DEPTH_MM;
  message.depth.compression =
      compressed ? kinect::depth_msg_t::COMPRESSION_ZLIB : kinect::depth_msg_t::COMPRESSION_NONE;
  message.depth.depth_data = compressed ? compress_depth(depth_values()) : plain_depth();
  message.depth.depth_data_nbytes = static_cast<std::int32_t>(message.depth.depth_data.size());
  message.image.width = kWidth;
  message.image.height = kHeight;
  message.image.image_data_format =
      compressed ? kinect::image_msg_t::VIDEO_RGB_JPEG : kinect::image_msg_t::VIDEO_RGB;
  message.image.image_data = compressed ? encode_jpeg(color_image()) : color_image().rgb;
  message.image.image_data_nbytes = static_cast<std::int32_t>(message.image.image_data.size());
  return message;
}

void expect_the_frame(const FrameResult& result, std::int64_t utime) {
  ASSERT_TRUE(result.frame) << to_string(result.fault);
  EXPECT_EQ(result.frame->utime, utime);
  EXPECT_EQ(result.frame->depth.millimetres, depth_values());
  EXPECT_EQ(result.frame->depth_camera, kCamera);
  EXPECT_EQ(result.frame->color_camera, kCamera);
  ASSERT_EQ(result.frame->color.rgb.size(), color_image().rgb.size());
  EXPECT_NEAR(result.frame->color.rgb[5], 90, 2);
}

TEST(OpenniFrame, IsReadPlainAndCompressed) {
  expect_the_frame(to_frame(openni_frame(false), kCameras), 123456);
  expect_the_frame(to_frame(openni_frame(true), kCameras), 123456);
}

TEST(OpenniFrame, MayHaveItsImagesInAnyOrderAndOthersBeside) {
  bot_core::images_t message = openni_frame(true);
  std::swap(message.images[0], message.images[1]);
  std::swap(message.image_types[0], message.image_types[1]);
  message.images.push_back(message.images[0]);
  message.image_types.push_back(bot_core::images_t::RIGHT);
  expect_the_frame(to_frame(message, kCameras), 123456);
}

TEST(OpenniFrame, WithoutDepthIsRefused) {
  bot_core::images_t message = openni_frame(true);
  message.image_types[1] = bot_core::images_t::DISPARITY;
  EXPECT_EQ(to_frame(message, kCameras).fault, FrameFault::kBadFormat);
  EXPECT_EQ(to_frame(bot_core::images_t{}, kCameras).fault, FrameFault::kBadFormat);
}

TEST(OpenniFrame, OfAnotherSizeThanTheConfiguredCameraIsRefused) {
  FrameCameras cameras = kCameras;
  cameras.depth.width = 640;
  EXPECT_EQ(to_frame(openni_frame(true), cameras).fault, FrameFault::kBadSize);
}

TEST(KinectFrame, IsReadPlainAndCompressed) {
  expect_the_frame(to_frame(kinect_frame(false), kCameras), 654321);
  expect_the_frame(to_frame(kinect_frame(true), kCameras), 654321);
}

TEST(KinectFrame, WithoutATimeOfExposureHasThatOfSending) {
  kinect::frame_msg_t message = kinect_frame(true);
  message.depth.timestamp = 0;
  EXPECT_EQ(to_frame(message, kCameras).frame->utime, 999);
}

TEST(KinectFrame, WithInfraredInsteadOfColorIsAFrameWithoutColor) {
  kinect::frame_msg_t message = kinect_frame(true);
  message.image.image_data_format = kinect::image_msg_t::VIDEO_IR_8BIT;
  const FrameResult result = to_frame(message, kCameras);
  ASSERT_TRUE(result.frame);
  EXPECT_TRUE(result.frame->color.empty());
}

TEST(KinectFrame, InFormatsThatAreNotMillimetresIsRefused) {
  kinect::frame_msg_t message = kinect_frame(false);
  message.depth.depth_data_format = kinect::depth_msg_t::DEPTH_11BIT;
  EXPECT_EQ(to_frame(message, kCameras).fault, FrameFault::kBadFormat);
  message = kinect_frame(false);
  message.depth.compression = 7;
  EXPECT_EQ(to_frame(message, kCameras).fault, FrameFault::kBadFormat);
  message = kinect_frame(false);
  message.image.image_data_format = kinect::image_msg_t::VIDEO_BAYER;
  EXPECT_EQ(to_frame(message, kCameras).fault, FrameFault::kBadFormat);
}

TEST(OwnMessage, SaysTheSameAndKeepsTheJpegBytes) {
  const auto jpeg = encode_jpeg(color_image());
  for (const bool compressed : {false, true}) {
    const FrameMessageResult openni = to_own_message(openni_frame(compressed), kCameras);
    const FrameMessageResult kinect = to_own_message(kinect_frame(compressed), kCameras);
    expect_the_frame(to_frame(openni.message.value()), 123456);
    expect_the_frame(to_frame(kinect.message.value()), 654321);
    if (!compressed) continue;
    EXPECT_EQ(openni.message->color.data, jpeg);
    EXPECT_EQ(kinect.message->color.data, jpeg);
  }
}

TEST(OwnMessage, IsNotMadeOfWhatCannotBeDecoded) {
  bot_core::images_t message = openni_frame(true);
  message.images[0].data.resize(20);
  EXPECT_EQ(to_own_message(message, kCameras).fault, FrameFault::kBadJpeg);
  message = openni_frame(true);
  message.images[1].data.resize(20);
  EXPECT_EQ(to_own_message(message, kCameras).fault, FrameFault::kBadDepth);
}

TEST(KinectFrame, WithNegativeSizesIsRefused) {
  kinect::frame_msg_t message = kinect_frame(false);
  message.depth.width = -6;
  EXPECT_EQ(to_frame(message, kCameras).fault, FrameFault::kBadSize);
}

}  // namespace
}  // namespace geomap::messaging
