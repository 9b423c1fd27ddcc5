// SPDX-License-Identifier: BSD-3-Clause
// Frames of other people's LCM camera drivers.
#include <optional>
#include <utility>

#include "messaging/convert_frame.hpp"
#include "messaging/frame_assembly.hpp"

namespace geomap::messaging {
namespace {

using bot_core::image_t;
using bot_core::images_t;
using kinect::depth_msg_t;
using kinect::image_msg_t;

/// Drivers copy the 16-bit image of a little-endian host, whatever pixelformat they declare: some
/// say PIXEL_FORMAT_BE_GRAY16, some PIXEL_FORMAT_INVALID. What counts is images_t::image_types.
EncodedImage depth_of(const image_t& image, bool zipped) {
  return {image.data, image.width, image.height, image.row_stride, zipped};
}

enum class KinectVideo { kColor, kJpeg, kNoColor, kUnknown };

KinectVideo video_of(const image_msg_t& image) {
  switch (image.image_data_format) {
    case image_msg_t::VIDEO_RGB:
      return KinectVideo::kColor;
    case image_msg_t::VIDEO_RGB_JPEG:
      return KinectVideo::kJpeg;
    case image_msg_t::VIDEO_NONE:
    case image_msg_t::VIDEO_IR_8BIT:
    case image_msg_t::VIDEO_IR_10BIT:
    case image_msg_t::VIDEO_IR_10BIT_PACKED:
      return KinectVideo::kNoColor;  // depth alone is a frame too
    default:
      return KinectVideo::kUnknown;
  }
}

FrameParts parts_of(std::int64_t utime, const char* sensor, const FrameCameras& cameras) {
  FrameParts parts;
  parts.header.utime = utime;
  parts.header.sensor = sensor;
  parts.header.depth_camera = cameras.depth;
  parts.header.color_camera = cameras.color;
  return parts;
}

/// Nothing where a format is not understood.
std::optional<FrameParts> parts_of(const images_t& message, const FrameCameras& cameras) {
  FrameParts parts = parts_of(message.utime, "openni", cameras);
  bool has_depth = false;
  for (std::size_t i = 0; i < message.images.size(); ++i) {
    const image_t& image = message.images[i];
    const std::int16_t type = message.image_types[i];
    if (type == images_t::DEPTH_MM || type == images_t::DEPTH_MM_ZIPPED) {
      parts.depth = depth_of(image, type == images_t::DEPTH_MM_ZIPPED);
      has_depth = true;
    } else if (type == images_t::LEFT) {
      const bool jpeg = image.pixelformat == image_t::PIXEL_FORMAT_MJPEG;
      if (!jpeg && image.pixelformat != image_t::PIXEL_FORMAT_RGB) return std::nullopt;
      parts.color = EncodedImage{image.data, image.width, image.height, image.row_stride, jpeg};
    }
  }
  return has_depth ? std::optional(std::move(parts)) : std::nullopt;
}

std::optional<FrameParts> parts_of(const kinect::frame_msg_t& message,
                                   const FrameCameras& cameras) {
  const depth_msg_t& depth = message.depth;
  const bool millimetres = depth.depth_data_format == depth_msg_t::DEPTH_MM ||
                           depth.depth_data_format == depth_msg_t::DEPTH_REGISTERED;
  const bool zipped = depth.compression == depth_msg_t::COMPRESSION_ZLIB;
  const KinectVideo video = video_of(message.image);
  if (!millimetres || (!zipped && depth.compression != depth_msg_t::COMPRESSION_NONE) ||
      video == KinectVideo::kUnknown) {
    return std::nullopt;
  }
  // The depth image has the time of the exposure; drivers that leave it out have only that of
  // sending.
  FrameParts parts =
      parts_of(depth.timestamp != 0 ? depth.timestamp : message.timestamp, "kinect", cameras);
  parts.depth = {depth.depth_data, depth.width, depth.height, 0, zipped};
  if (video != KinectVideo::kNoColor) {
    const image_msg_t& image = message.image;
    parts.color =
        EncodedImage{image.image_data, image.width, image.height, 0, video == KinectVideo::kJpeg};
  }
  return parts;
}

template <class Message>
FrameResult frame_of(const Message& message, const FrameCameras& cameras, ColorUse color) {
  std::optional<FrameParts> parts = parts_of(message, cameras);
  if (!parts) return {std::nullopt, FrameFault::kBadFormat};
  return assemble(*std::move(parts), color);
}

template <class Message>
FrameMessageResult own_message_of(const Message& message, const FrameCameras& cameras) {
  const std::optional<FrameParts> parts = parts_of(message, cameras);
  if (!parts) return {std::nullopt, FrameFault::kBadFormat};
  const FrameResult result = assemble(*parts, ColorUse::kDecode);
  if (!result.frame) return {std::nullopt, result.fault};
  const bool has_jpeg = parts->color && parts->color->compressed;
  return {
      to_message(*result.frame, has_jpeg ? parts->color->data : std::span<const std::uint8_t>()),
      FrameFault::kNone};
}

}  // namespace

FrameResult to_frame(const images_t& message, const FrameCameras& cameras, ColorUse color) {
  return frame_of(message, cameras, color);
}

FrameResult to_frame(const kinect::frame_msg_t& message, const FrameCameras& cameras,
                     ColorUse color) {
  return frame_of(message, cameras, color);
}

FrameMessageResult to_own_message(const images_t& message, const FrameCameras& cameras) {
  return own_message_of(message, cameras);
}

FrameMessageResult to_own_message(const kinect::frame_msg_t& message, const FrameCameras& cameras) {
  return own_message_of(message, cameras);
}

}  // namespace geomap::messaging
