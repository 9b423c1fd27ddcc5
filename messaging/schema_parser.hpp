// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "messaging/message_schema.hpp"

namespace geomap::messaging {

/// @brief The structs of .lcm text in order, with names and arrays filled in; nested types,
/// fingerprints and sizes are left to SchemaRegistry. @throws std::invalid_argument, with the
/// reason.
std::vector<MessageSchema> parse_lcm(const std::string& text);

}  // namespace geomap::messaging
