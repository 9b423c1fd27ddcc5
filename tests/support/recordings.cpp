// SPDX-License-Identifier: BSD-3-Clause
#include "support/recordings.hpp"

#include <cstdlib>

namespace geomap::testing {

std::optional<std::filesystem::path> recording(const std::string& name) {
  const char* root = std::getenv("GEOMAP_DATA");
  if (root == nullptr) return std::nullopt;
  const std::filesystem::path path = std::filesystem::path(root) / name;
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return std::nullopt;
  return path;
}

}  // namespace geomap::testing
