// SPDX-License-Identifier: BSD-3-Clause
#include "logs/evaluation_cells.hpp"

#include <fmt/format.h>

namespace geomap::logs {

Cell spread_cell(const std::optional<Spread>& spread, double scale, int decimals) {
  if (!spread) return {"-"};
  Cell cell{number_text(spread->mean, scale, decimals)};
  const std::string least = number_text(spread->min, scale, decimals);
  const std::string most = number_text(spread->max, scale, decimals);
  if (least != most) cell.note = fmt::format("{} .. {}", least, most);
  return cell;
}

Cell spread_cell(const std::optional<Spread>& spread, const FigureKind& kind) {
  return spread_cell(spread, kind.scale, kind.decimals);
}

std::string bytes_text(double bytes) {
  if (bytes < 1e3) return fmt::format("{:.0f} B", bytes);
  if (bytes < 1e6) return fmt::format("{:.3g} kB", bytes / 1e3);
  return fmt::format("{:.1f} MB", bytes / 1e6);
}

std::string percent_text(double part, double whole) {
  return whole > 0.0 ? fmt::format("{:.3g} %", 100.0 * part / whole) : "-";
}

}  // namespace geomap::logs
