// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mapping/feature_store.hpp"
#include "mapping/veto.hpp"

namespace geomap::mapping {

/// @brief SHA-256, in hexadecimal, of the exact state of all features by id: plane, frame, moments,
/// rings, observations, colour, labels, whether it is held; and of the vetoes, where there are any.
/// Not of revision, history, numbers of edits or timings.
std::string map_hash(const FeatureSet& features, const VetoSet& vetoes = {});

}  // namespace geomap::mapping
