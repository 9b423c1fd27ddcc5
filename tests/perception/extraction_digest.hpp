// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace geomap::testing {

/// @brief What the plane extractors make of rendered frames and, where recordings are given, of
/// some of theirs: one line for each frame and extractor, its name, the number of planes and a
/// checksum of every bit of labels, noise, planes, outlines and moments.
std::vector<std::string> extraction_digest();

}  // namespace geomap::testing
