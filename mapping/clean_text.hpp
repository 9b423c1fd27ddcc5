// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace geomap::mapping {

/// @brief An operator's text made fit for a file: valid UTF-8 (what is not becomes U+FFFD), and
/// blanks instead of control characters, which XML forbids and which break lines of text formats.
std::string clean_text(std::string_view text);

}  // namespace geomap::mapping
