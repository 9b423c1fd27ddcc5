// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "geomap/health_t.hpp"
#include "viewer/scene_model.hpp"
#include "viewer/taken.hpp"

namespace geomap::viewer {

/// @brief Takes over how a process fares. Of a stage that had nothing to do the last figures stay.
void take_health(const geomap::health_t& message, Clock::time_point now, ProcessState& state);

}  // namespace geomap::viewer
