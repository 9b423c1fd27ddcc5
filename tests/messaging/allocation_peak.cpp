// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/allocation_peak.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace {

thread_local std::int64_t taken = 0;
thread_local std::int64_t peak = 0;

// The size of a block stands before it.
constexpr std::size_t kPrefix = alignof(std::max_align_t);

}  // namespace

void* operator new(std::size_t size) {
  void* block = std::malloc(size + kPrefix);
  if (block == nullptr) throw std::bad_alloc();
  *static_cast<std::size_t*>(block) = size;
  taken += static_cast<std::int64_t>(size);
  peak = std::max(peak, taken);
  return static_cast<char*>(block) + kPrefix;
}

void operator delete(void* pointer) noexcept {
  if (pointer == nullptr) return;
  void* block = static_cast<char*>(pointer) - kPrefix;
  taken -= static_cast<std::int64_t>(*static_cast<std::size_t*>(block));
  std::free(block);
}

void operator delete(void* pointer, std::size_t /*size*/) noexcept { operator delete(pointer); }

namespace geomap::testing {

void reset_allocation_peak() {
  taken = 0;
  peak = 0;
}

std::size_t allocation_peak() { return static_cast<std::size_t>(peak); }

}  // namespace geomap::testing
