// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace geomap::bench {

/// @brief Calls of operator new in this program so far, and the bytes they asked for. What C code
/// and Eigen's dynamic matrices take from malloc is not among them.
struct Allocations {
  std::int64_t calls = 0;
  std::int64_t bytes = 0;

  Allocations operator-(const Allocations& other) const {
    return {calls - other.calls, bytes - other.bytes};
  }
};

/// @brief A program that links allocation_count.cpp has its operator new replaced by a counting
/// one.
Allocations allocations();

}  // namespace geomap::bench
