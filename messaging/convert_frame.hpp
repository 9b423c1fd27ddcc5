// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "bot_core/images_t.hpp"
#include "geomap/rgbd_frame_t.hpp"
#include "geometry/depth_correction.hpp"
#include "geometry/rgbd_frame.hpp"
#include "kinect/frame_msg_t.hpp"
#include "messaging/frame_images.hpp"

namespace geomap::messaging {

/// @brief A frame, or the reason why there is none.
struct FrameResult {
  std::optional<geometry::RgbdFrame> frame;
  FrameFault fault = FrameFault::kNone;
};

/// @brief Whether a reader needs colour: decoding it costs more than inflating the depth.
enum class ColorUse { kDecode, kSkip };

/// @brief The message of a frame. The depth is deflated; colour is `jpeg` where that is not empty
/// (then its bytes travel unchanged), else the frame's image encoded with `quality`, else absent.
/// @throws std::invalid_argument for a frame whose images and cameras do not fit together.
geomap::rgbd_frame_t to_message(const geometry::RgbdFrame& frame,
                                std::span<const std::uint8_t> jpeg = {}, int quality = 90);

/// @brief The frame of a message. A reader that only needs utime, sequence or sensor takes them
/// from the message, which holds the images still compressed.
FrameResult to_frame(const geomap::rgbd_frame_t& message, ColorUse color = ColorUse::kDecode);

/// @brief Corrects the depth of a message, which is deflated anew; one that cannot be decoded is
/// left as it is.
void correct_depth(geomap::rgbd_frame_t& message, const geometry::DepthCorrection& correction);

/// @brief The cameras of a driver whose messages do not carry them.
struct FrameCameras {
  geometry::CameraModel depth;
  geometry::CameraModel color;
};

/// @brief The frame of an OPENNI_FRAME: depth plain or zipped [mm], colour JPEG or plain RGB.
/// The sequence number is 0: the message has none.
FrameResult to_frame(const bot_core::images_t& message, const FrameCameras& cameras,
                     ColorUse color = ColorUse::kDecode);

/// @brief The frame of a KINECT_FRAME: depth in millimetres, plain or zipped, colour JPEG, plain
/// RGB or none. The 10- and 11-bit disparities of old drivers are kBadFormat.
FrameResult to_frame(const kinect::frame_msg_t& message, const FrameCameras& cameras,
                     ColorUse color = ColorUse::kDecode);

/// @brief A message of our own, or the reason why there is none.
struct FrameMessageResult {
  std::optional<geomap::rgbd_frame_t> message;
  FrameFault fault = FrameFault::kNone;
};

/// @brief The message of our own that says the same. Depth is deflated anew, JPEG colour travels
/// unchanged, plain colour is encoded; all of it is decoded once, to know that it can be.
FrameMessageResult to_own_message(const bot_core::images_t& message, const FrameCameras& cameras);
FrameMessageResult to_own_message(const kinect::frame_msg_t& message, const FrameCameras& cameras);

}  // namespace geomap::messaging
