// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "viewer/scene_model.hpp"

namespace geomap::viewer {

/// @brief Counts a message of `bytes` that has come on a channel.
void note_arrival(std::size_t bytes, Clock::time_point now, ChannelState& channel);

/// @brief The rate as it is now: over the last five seconds, and only once there is a second of
/// them.
void update_rate(Clock::time_point now, ChannelState& channel);

/// @brief What went missing or was refused in the last minute, from how both numbers have grown.
void update_troubles(Clock::time_point now, ChannelState& channel);

}  // namespace geomap::viewer
