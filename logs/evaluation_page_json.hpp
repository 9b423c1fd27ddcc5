// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "logs/evaluation_bounds.hpp"
#include "logs/run_statistics.hpp"

namespace geomap::logs {

/// @brief All aggregated figures as JSON: under `sets` by set and variant, each figure as mean,
/// min, max and count (null where nothing was measured); `bounds`; `paper`; `missing`. Metres,
/// radians, seconds, bytes.
std::string evaluation_page_json(const RunCollection& collection, std::span<const RunGroup> groups,
                                 std::span<const BoundResult> bounds);

}  // namespace geomap::logs
