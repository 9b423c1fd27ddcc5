// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/operator_name.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>

#include "mapping/clean_text.hpp"
#include "mapping/edit.hpp"

namespace geomap::mapping {

std::string operator_name() {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  const char* user = std::getenv("USER");
  const std::string name = fmt::format("{}@{}", user ? user : "operator", host.data());
  return clean_text(name.substr(0, kLongestAuthor));
}

std::int64_t CommandNumbers::next() {
  const auto now = std::chrono::duration_cast<std::chrono::microseconds>(
      std::chrono::system_clock::now().time_since_epoch());
  last_ = std::max<std::int64_t>(last_ + 1, now.count());
  return last_;
}

}  // namespace geomap::mapping
