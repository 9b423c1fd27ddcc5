// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace geomap::logs {

/// @brief scale · value in fixed notation; "-" for what is not known.
std::string number_text(std::optional<double> value, double scale, int decimals);

}  // namespace geomap::logs
