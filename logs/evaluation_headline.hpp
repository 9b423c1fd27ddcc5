// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "logs/page_document.hpp"
#include "logs/run_statistics.hpp"

namespace geomap::logs {

/// @brief What someone with ten seconds wants to know: accuracy without and with much noise, time
/// for a key frame and size of the map, of the first variant that merges by moments.
Table headline_table(std::span<const RunGroup> groups);

}  // namespace geomap::logs
