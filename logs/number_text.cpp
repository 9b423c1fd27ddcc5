// SPDX-License-Identifier: BSD-3-Clause
#include "logs/number_text.hpp"

#include <fmt/format.h>

namespace geomap::logs {

std::string number_text(std::optional<double> value, double scale, int decimals) {
  return value ? fmt::format("{:.{}f}", *value * scale, decimals) : "-";
}

}  // namespace geomap::logs
