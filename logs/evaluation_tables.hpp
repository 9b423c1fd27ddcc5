// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>

#include "logs/evaluation_bounds.hpp"
#include "logs/page_document.hpp"
#include "logs/run_statistics.hpp"

namespace geomap::logs {

/// @brief The paper's Table 1: its rows, and below each what our runs of that set gave; means over
/// seeds with their ranges, bold where better than all of the paper's rows of the set. Sets that
/// the paper does not have are left out.
Table accuracy_table(std::span<const RunGroup> groups);

/// @brief The same figures for the sets that the paper does not have.
Table further_sets_table(std::span<const RunGroup> groups);

/// @brief What the paper does not measure, for all sets.
Table coverage_table(std::span<const RunGroup> groups);

/// @brief The paper's Tables 2 and 3: one row a true plane.
Table plane_table(const RunGroup& group);

/// @brief The bounds, the worst seed of each, and whether it meets them.
Table bounds_table(std::span<const BoundResult> results);

}  // namespace geomap::logs
