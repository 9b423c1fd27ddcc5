// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "viewer/image.hpp"

namespace geomap::viewer {

/// @brief A film of the window: a file through ffmpeg where that is installed, else a folder of
/// numbered PNG files.
class Movie {
 public:
  static constexpr double kFramesPerSecond = 12.0;

  /// @param name without extension. @throws std::runtime_error when it cannot be begun.
  Movie(const std::filesystem::path& name, int width, int height);
  /// @brief Ends it.
  ~Movie();
  Movie(const Movie&) = delete;
  Movie& operator=(const Movie&) = delete;

  /// @brief The next picture. One of another size than the first is left out.
  /// @throws std::runtime_error when it cannot be written.
  void add(const Image& image);
  /// @brief Ends it. @return what went wrong, in words; empty when it is whole.
  std::string finish();
  /// @brief What is being written.
  const std::filesystem::path& path() const { return path_; }

 private:
  void start_ffmpeg();

  std::filesystem::path path_;
  int width_, height_;
  int pictures_ = 0;
  pid_t ffmpeg_ = -1;
  int pipe_ = -1;  // into ffmpeg
};

/// @brief "geomap_20261127_101502" in the current folder, for files that are named by their time.
std::filesystem::path name_by_time();

}  // namespace geomap::viewer
