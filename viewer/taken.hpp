// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace geomap::viewer {

/// @brief What became of a message.
enum class Taken {
  kNothing,  // understood, but there is nothing new to see
  kChange,   // a layer has changed
  kRefused,  // not sound
};

}  // namespace geomap::viewer
