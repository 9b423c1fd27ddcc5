// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace geomap::messaging {

/// @brief The bytes of a message as they go on the wire and into a log.
/// Every count field must equal the size of its vector: LCM does not check.
/// @throws std::length_error when the message does not fit into LCM's 32-bit size.
template <class Message>
std::vector<std::uint8_t> encode(const Message& message) {
  const int size = message.getEncodedSize();
  if (size < 0) throw std::length_error(std::string(Message::getTypeName()) + " is too large");
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  if (message.encode(bytes.data(), 0, size) != size) {
    throw std::length_error(std::string(Message::getTypeName()) + " cannot be encoded");
  }
  return bytes;
}

}  // namespace geomap::messaging
