// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace geomap::viewer {

/// @brief A line of text to be typed. @return true when Enter was pressed in it.
bool text_field(const char* name, const char* hint, std::string& text);

}  // namespace geomap::viewer
