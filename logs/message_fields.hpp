// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace geomap::logs {

/// @brief One value of a message, for people.
struct FieldText {
  std::string path;   // for example "changed[0].id.plane"
  std::string value;  // for example "3", "\"kinect\"", "1 2 3 4 .. (16)", "1400 bytes"
};

/// @brief The values of a message of any type of lcmtypes/, in their order. Long arrays are cut
/// short after their first elements, of byte arrays only the size is told.
/// @param wanted path of the field or element to which it is limited, which then may also be one
/// that is cut off otherwise; empty: all.
/// @return nothing when the message cannot be decoded, or has no such field.
std::vector<FieldText> message_fields(std::span<const std::uint8_t> message,
                                      const std::string& wanted = "");

}  // namespace geomap::logs
