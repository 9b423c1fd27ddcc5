// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace geomap::logs {

/// @brief What makes a terminal of this size show a text in place of all it shows: its own commands
/// (ECMA-48), and as much of the text as there is room for.
std::string repaint(const std::string& text, std::size_t columns, std::size_t rows);

/// @brief Prints a text that is new every second: a terminal shows it in place of the one before, a
/// file or pipe gets one after the other.
void show(const std::string& text);

}  // namespace geomap::logs
