// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

namespace geomap::messaging {

/// @brief A file that appears when it is whole or not at all: it is written under name(),
/// `out`.part, and keep() gives it its name, replacing an older one. Without keep() it is removed.
class PartFile {
 public:
  /// @brief The name under which `out` is written.
  static std::string part_of(const std::string& out) { return out + ".part"; }

  /// @throws std::runtime_error when `out` exists and is not a regular file.
  explicit PartFile(const std::string& out) : out_(out), part_(part_of(out)) {
    if (std::filesystem::exists(out_) && !std::filesystem::is_regular_file(out_)) {
      throw std::runtime_error(out + ": exists and is no regular file");
    }
  }
  ~PartFile() {
    std::error_code ignored;
    if (!kept_) std::filesystem::remove(part_, ignored);
  }
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  std::string name() const { return part_.string(); }

  /// @brief To be called when all is written. @throws std::filesystem::filesystem_error.
  void keep() {
    std::filesystem::rename(part_, out_);
    kept_ = true;
  }

 private:
  std::filesystem::path out_, part_;
  bool kept_ = false;
};

}  // namespace geomap::messaging
