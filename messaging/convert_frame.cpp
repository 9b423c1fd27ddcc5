// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/convert_frame.hpp"

#include <stdexcept>
#include <utility>
#include <vector>

#include "messaging/convert_geometry.hpp"
#include "messaging/depth_codec.hpp"
#include "messaging/frame_assembly.hpp"
#include "messaging/jpeg.hpp"

namespace geomap::messaging {
namespace {

using bot_core::image_t;
using geometry::CameraModel;
using geometry::RgbdFrame;

FrameFault find_fault(const CameraModel& camera, const EncodedImage& image) {
  if (!camera.valid()) return FrameFault::kBadIntrinsics;
  const bool fits = camera.width == image.width && camera.height == image.height;
  return fits ? FrameFault::kNone : FrameFault::kBadSize;
}

std::size_t pixel_count(const CameraModel& camera) {
  return static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
}

void require_consistent(const RgbdFrame& frame, bool has_jpeg) {
  if (!frame.depth_camera.valid() || frame.depth.width != frame.depth_camera.width ||
      frame.depth.height != frame.depth_camera.height ||
      frame.depth.millimetres.size() != pixel_count(frame.depth_camera)) {
    throw std::invalid_argument("to_message: the depth image does not fit its camera");
  }
  if (!has_jpeg && frame.color.empty()) return;
  const bool fits =
      frame.color_camera.valid() && (has_jpeg || (frame.color.width == frame.color_camera.width &&
                                                  frame.color.height == frame.color_camera.height));
  if (!fits) throw std::invalid_argument("to_message: the colour image does not fit its camera");
}

image_t to_image(const RgbdFrame& frame, const CameraModel& camera, std::int32_t pixel_size,
                 std::int32_t pixelformat, std::vector<std::uint8_t> data) {
  image_t image{};
  image.utime = frame.utime;
  image.width = camera.width;
  image.height = camera.height;
  image.row_stride = pixel_size * camera.width;
  image.pixelformat = pixelformat;
  image.size = static_cast<std::int32_t>(data.size());
  image.data = std::move(data);
  return image;
}

EncodedImage encoded(const image_t& image, bool compressed) {
  return {image.data, image.width, image.height, image.row_stride, compressed};
}

image_t depth_image(const RgbdFrame& frame) {
  return to_image(frame, frame.depth_camera, 2, geomap::rgbd_frame_t::DEPTH_ZLIB,
                  compress_depth(frame.depth.millimetres));
}

}  // namespace

FrameResult assemble(FrameParts parts, ColorUse color) {
  RgbdFrame frame = std::move(parts.header);
  FrameFault fault = find_fault(frame.depth_camera, parts.depth);
  if (fault == FrameFault::kNone && parts.color) {
    fault = find_fault(frame.color_camera, *parts.color);
  }
  if (fault != FrameFault::kNone) return {std::nullopt, fault};

  DepthResult depth = read_depth(parts.depth);
  if (depth.fault != FrameFault::kNone) return {std::nullopt, depth.fault};
  frame.depth = std::move(depth.image);

  if (parts.color && color == ColorUse::kDecode) {
    ColorResult decoded = read_color(*parts.color);
    if (decoded.fault != FrameFault::kNone) return {std::nullopt, decoded.fault};
    frame.color = std::move(decoded.image);
  }
  return {std::move(frame), FrameFault::kNone};
}

geomap::rgbd_frame_t to_message(const RgbdFrame& frame, std::span<const std::uint8_t> jpeg,
                                int quality) {
  require_consistent(frame, !jpeg.empty());
  geomap::rgbd_frame_t message{};
  message.utime = frame.utime;
  message.sequence = frame.sequence;
  message.sensor = frame.sensor;
  message.depth_camera = to_message(frame.depth_camera);
  message.color_camera = to_message(frame.color_camera);
  message.depth = depth_image(frame);
  if (!jpeg.empty() || !frame.color.empty()) {
    message.color = to_image(frame, frame.color_camera, 3, image_t::PIXEL_FORMAT_MJPEG,
                             jpeg.empty() ? encode_jpeg(frame.color, quality)
                                          : std::vector<std::uint8_t>(jpeg.begin(), jpeg.end()));
  }
  return message;
}

FrameResult to_frame(const geomap::rgbd_frame_t& message, ColorUse color) {
  FrameParts parts;
  parts.header.utime = message.utime;
  parts.header.sequence = message.sequence;
  parts.header.sensor = message.sensor;
  parts.header.depth_camera = from_message(message.depth_camera);
  parts.header.color_camera = from_message(message.color_camera);

  const bool deflated = message.depth.pixelformat == geomap::rgbd_frame_t::DEPTH_ZLIB;
  if (!deflated && message.depth.pixelformat != image_t::PIXEL_FORMAT_LE_GRAY16) {
    return {std::nullopt, FrameFault::kBadFormat};
  }
  parts.depth = encoded(message.depth, deflated);

  if (!message.color.data.empty()) {
    const bool jpeg = message.color.pixelformat == image_t::PIXEL_FORMAT_MJPEG;
    if (!jpeg && message.color.pixelformat != image_t::PIXEL_FORMAT_RGB) {
      return {std::nullopt, FrameFault::kBadFormat};
    }
    parts.color = encoded(message.color, jpeg);
  }
  return assemble(std::move(parts), color);
}

void correct_depth(geomap::rgbd_frame_t& message, const geometry::DepthCorrection& correction) {
  const FrameResult decoded = to_frame(message, ColorUse::kSkip);
  if (!decoded.frame) return;
  message.depth = depth_image(geometry::corrected(*decoded.frame, correction));
}

}  // namespace geomap::messaging
