// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "messaging/message_schema.hpp"

namespace geomap::testing {

/// @brief A sound message of a type with random contents, and where in it things lie.
struct RandomMessage {
  struct Place {
    std::size_t offset = 0;
    std::size_t size = 0;
  };
  std::vector<std::uint8_t> bytes;
  std::vector<Place> counts;   // of arrays and strings
  std::vector<Place> doubles;  // any
};

/// @brief Arrays get 0 to 3 elements, or at least one with `full`.
RandomMessage random_message(const messaging::MessageSchema& schema, std::mt19937& random,
                             bool full = false);

/// @brief Overwrites a big-endian number.
void write_number(std::vector<std::uint8_t>& bytes, RandomMessage::Place place,
                  std::uint64_t value);

}  // namespace geomap::testing
