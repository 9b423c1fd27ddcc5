// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "geomap/keyframe_t.hpp"
#include "perception/registration.hpp"

namespace geomap::perception {

/// @brief A registered frame as the channel KEYFRAME carries it.
/// @param frame as it was received; its images are left out when the registration was rejected.
/// @param session of the publisher; @param sequence of its key frames, rejected ones included.
geomap::keyframe_t to_message(const RegistrationResult& registration,
                              const geomap::rgbd_frame_t& frame, std::int64_t session,
                              std::int64_t sequence);

}  // namespace geomap::perception
