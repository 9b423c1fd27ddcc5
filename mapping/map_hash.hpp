// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mapping/feature_store.hpp"

namespace geomap::mapping {

/// @brief SHA-256, in hexadecimal, of the exact state of all features by id: plane, frame, moments,
/// rings, observations, colour, label. Not of revision, history or timings.
std::string map_hash(const FeatureSet& features);

}  // namespace geomap::mapping
