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

}  // namespace

FrameResult to_frame(const images_t& message, const FrameCameras& cameras, ColorUse color) {
  FrameParts parts;
  parts.header.utime = message.utime;
  parts.header.sensor = "openni";
  parts.header.depth_camera = cameras.depth;
  parts.header.color_camera = cameras.color;

  bool has_depth = false;
  for (std::size_t i = 0; i < message.images.size(); ++i) {
    const image_t& image = message.images[i];
    const std::int16_t type = message.image_types[i];
    if (type == images_t::DEPTH_MM || type == images_t::DEPTH_MM_ZIPPED) {
      parts.depth = depth_of(image, type == images_t::DEPTH_MM_ZIPPED);
      has_depth = true;
    } else if (type == images_t::LEFT) {
      const bool jpeg = image.pixelformat == image_t::PIXEL_FORMAT_MJPEG;
      if (!jpeg && image.pixelformat != image_t::PIXEL_FORMAT_RGB) {
        return {std::nullopt, FrameFault::kBadFormat};
      }
      parts.color = EncodedImage{image.data, image.width, image.height, image.row_stride, jpeg};
    }
  }
  if (!has_depth) return {std::nullopt, FrameFault::kBadFormat};
  return assemble(std::move(parts), color);
}

FrameResult to_frame(const kinect::frame_msg_t& message, const FrameCameras& cameras,
                     ColorUse color) {
  FrameParts parts;
  // The depth image has the time of the exposure; drivers that leave it out have only that of
  // sending.
  parts.header.utime = message.depth.timestamp != 0 ? message.depth.timestamp : message.timestamp;
  parts.header.sensor = "kinect";
  parts.header.depth_camera = cameras.depth;
  parts.header.color_camera = cameras.color;

  const depth_msg_t& depth = message.depth;
  const bool millimetres = depth.depth_data_format == depth_msg_t::DEPTH_MM ||
                           depth.depth_data_format == depth_msg_t::DEPTH_REGISTERED;
  const bool zipped = depth.compression == depth_msg_t::COMPRESSION_ZLIB;
  const KinectVideo video = video_of(message.image);
  if (!millimetres || (!zipped && depth.compression != depth_msg_t::COMPRESSION_NONE) ||
      video == KinectVideo::kUnknown) {
    return {std::nullopt, FrameFault::kBadFormat};
  }
  parts.depth = {depth.depth_data, depth.width, depth.height, 0, zipped};
  if (video != KinectVideo::kNoColor) {
    const image_msg_t& image = message.image;
    parts.color =
        EncodedImage{image.image_data, image.width, image.height, 0, video == KinectVideo::kJpeg};
  }
  return assemble(std::move(parts), color);
}

}  // namespace geomap::messaging
