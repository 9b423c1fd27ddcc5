// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "messaging/convert_frame.hpp"

namespace geomap::messaging {

/// @brief The parts of a frame, found in whichever message type carried them.
struct FrameParts {
  geometry::RgbdFrame header;  // utime, sequence, sensor and cameras; images empty
  EncodedImage depth;
  std::optional<EncodedImage> color;
};

/// @brief Checks that the parts fit together and decodes them.
FrameResult assemble(FrameParts parts, ColorUse color);

}  // namespace geomap::messaging
