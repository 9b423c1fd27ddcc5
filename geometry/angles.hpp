// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

namespace geomap::geometry {

/// @brief Settings and people speak degrees, everything else radians.
constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }
constexpr double degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

}  // namespace geomap::geometry
