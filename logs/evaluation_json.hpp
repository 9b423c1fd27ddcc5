// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "logs/evaluation.hpp"

namespace geomap::logs {

/// @brief The text of evaluation.json. Every key is always there, null where nothing could be
/// measured; metres, d_angle in radians, the trajectory's angles in degrees.
std::string evaluation_json(const Evaluation& evaluation);

}  // namespace geomap::logs
