// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mapping/map_feature.hpp"
#include "mapping/veto.hpp"

namespace geomap::mapping {

/// @brief The geometric map at one revision: what exports show.
struct MapSnapshot {
  std::int64_t revision = 0;         // number of events that were applied
  std::string hash;                  // map_hash, hexadecimal; empty: unknown
  std::vector<MapFeature> features;  // world frame; any order, exports sort by id
  std::vector<Veto> vetoes = {};     // world frame
};

}  // namespace geomap::mapping
