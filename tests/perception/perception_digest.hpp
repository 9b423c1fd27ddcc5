// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace geomap::testing {

/// @brief What extraction and registration make of rendered frames and, where recordings are given,
/// of some of theirs. One line for each frame and algorithm with a checksum of every bit: labels,
/// planes, outlines and moments; corrected depth, points of the map and the aligned pose.
std::vector<std::string> perception_digest();

}  // namespace geomap::testing
