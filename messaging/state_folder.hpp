// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace geomap::messaging {

/// @brief The folder in which one process keeps what shall survive it. Locked as long as the object
/// lives, or until the process dies, however it does.
class StateFolder {
 public:
  /// @brief Makes the folder when there is none.
  /// @throws std::runtime_error, one line with the path, when that cannot be done or another
  /// process uses the folder.
  explicit StateFolder(const std::filesystem::path& path);
  ~StateFolder();
  StateFolder(const StateFolder&) = delete;
  StateFolder& operator=(const StateFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path file(const std::string& name) const { return path_ / name; }

  /// @brief Returns when the names in the folder are on disk: files that were made or renamed.
  /// @throws std::runtime_error.
  void sync() const;

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

/// @brief True for what may name a file inside a folder: 1 to 64 letters, digits, and any of _ - .
/// that does not begin with a dot.
bool is_plain_name(const std::string& name);

}  // namespace geomap::messaging
