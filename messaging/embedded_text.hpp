// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace geomap::messaging {

/// @brief config/default.yaml.
extern const char* const kDefaultYaml;

/// @brief All of lcmtypes/*.lcm, one after the other.
extern const char* const kLcmText;

}  // namespace geomap::messaging
