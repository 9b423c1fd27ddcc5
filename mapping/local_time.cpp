// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/local_time.hpp"

#include <array>
#include <ctime>

namespace geomap::mapping {
namespace {

std::string text_of(std::time_t seconds, const char* format) {
  std::tm local{};
  std::array<char, 64> text{};
  // A year beyond what can be written has no text.
  if (localtime_r(&seconds, &local)) std::strftime(text.data(), text.size(), format, &local);
  return text.data();
}

}  // namespace

std::string local_time(std::int64_t utime, const char* format) {
  return text_of(static_cast<std::time_t>(utime / 1'000'000), format);
}

std::string local_time(const char* format) { return text_of(std::time(nullptr), format); }

}  // namespace geomap::mapping
