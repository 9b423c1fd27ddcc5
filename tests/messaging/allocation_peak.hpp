// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace geomap::testing {

/// @brief Most memory [byte] taken through operator new at one time since reset_allocation_peak(),
/// beyond what was taken then. Of this thread.
void reset_allocation_peak();
std::size_t allocation_peak();

}  // namespace geomap::testing
