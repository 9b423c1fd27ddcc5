// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "logs/number_text.hpp"
#include "logs/page_document.hpp"
#include "logs/run_statistics.hpp"

namespace geomap::logs {

/// @brief The mean, and where there is more than one value the range beside it.
Cell spread_cell(const std::optional<Spread>& spread, double scale, int decimals);

/// @brief The same of a figure of accuracy.
Cell spread_cell(const std::optional<Spread>& spread, const FigureKind& kind);

/// @brief Bytes in decimal units: "595 kB".
std::string bytes_text(double bytes);

/// @brief With three digits that count: "0.0104 %"; "-" when the whole is nothing.
std::string percent_text(double part, double whole);

}  // namespace geomap::logs
