// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

namespace geomap::viewer {

/// @brief Dear ImGui's widgets on plain values. Each returns true when the value has changed.
bool slider(const char* name, double& value, double low, double high, const char* format);
/// @brief A choice of words; `chosen` is the number of one of them.
bool choice(const char* name, int& chosen, std::span<const char* const> words);

}  // namespace geomap::viewer
