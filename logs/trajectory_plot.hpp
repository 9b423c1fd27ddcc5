// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "logs/trajectory_metrics.hpp"

namespace geomap::logs {

/// @brief An SVG sheet: the aligned estimate over the reference from above (x, y) and from the side
/// (z over x or y, along which the path is longer), both at one scale in the reference's world, and
/// the distance between them over time, aligned and anchored.
/// @param metrics with one pair or more.
/// @param reference is drawn between the first and the last pair, with all its poses.
std::string trajectory_svg(const TrajectoryMetrics& metrics, const Trajectory& reference,
                           const std::string& title);

}  // namespace geomap::logs
