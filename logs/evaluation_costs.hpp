// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "logs/page_document.hpp"
#include "logs/run_statistics.hpp"

namespace geomap::logs {

/// @brief The paper's Table 4: time per key frame by stage, one column for each group of runs; the
/// mean over runs of their means, with their p50 and p95.
Table time_table(std::span<const RunGroup* const> groups);

/// @brief The paper's Table 5: bytes of the raw data, the point map and the geometric map.
Table reduction_table(std::span<const RunGroup* const> groups);

/// @brief Mean time of all stages [s]; nothing where a report lacks it.
std::optional<Spread> total_time(const RunGroup& group);

/// @brief The geometric map's share of the raw data.
std::optional<Spread> map_share(const RunGroup& group);

}  // namespace geomap::logs
