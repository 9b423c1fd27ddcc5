// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "messaging/convert_frame.hpp"

namespace geomap::logs {

struct LogImportSettings {
  messaging::FrameCameras cameras;  // of the frames: their messages carry none
  std::string channel;              // of the frames; empty: the one that there is
  bool skip_bad = false;            // leave out and count frames that cannot be read
};

/// @brief What went into the log.
struct LogImportSummary {
  std::string channel;         // where the frames were
  std::size_t frames = 0;      // now on RGBD_FRAME
  std::size_t frames_bad = 0;  // skipped, as LogImportSettings::skip_bad says
  std::string first_bad;       // why the first of them was
  std::size_t copied = 0;      // events that are no frames
  std::size_t damages = 0;     // places without a readable event
  std::uintmax_t log_bytes = 0;
};

/// @brief Turns the frames of another LCM camera driver, bot_core.images_t or kinect.frame_msg_t on
/// any channel, into RGBD_FRAME. All other events are copied; order and time stamps stay.
///
/// `out` is replaced only when all is written.
///
/// @throws messaging::ConfigError when `out` is the same file; std::runtime_error, one line, when
/// `log` is no log, holds no frames, RGBD_FRAME already or frames on several channels of which none
/// was chosen, for a frame that cannot be read (unless settings.skip_bad), or on Ctrl-C.
LogImportSummary import_log(const std::string& log, const LogImportSettings& settings,
                            const std::string& out);

/// @brief The summary in one line for people.
std::string to_string(const LogImportSummary& summary);

}  // namespace geomap::logs
