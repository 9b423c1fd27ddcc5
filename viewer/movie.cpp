// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/movie.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "mapping/local_time.hpp"
#include "viewer/png_file.hpp"

extern char** environ;

namespace geomap::viewer {
namespace {

bool is_installed(const char* program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
  }
  return false;
}

}  // namespace

Movie::Movie(const std::filesystem::path& name, int width, int height)
    : path_(name), width_(width), height_(height) {
  if (is_installed("ffmpeg")) {
    path_ += ".mp4";
    start_ffmpeg();
  } else {
    std::filesystem::create_directories(path_);
  }
}

void Movie::start_ffmpeg() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw std::runtime_error(fmt::format("{}: {}", path_.string(), std::strerror(errno)));
  }
  const std::string size = fmt::format("{}x{}", width_, height_);
  const std::string rate = fmt::format("{}", kFramesPerSecond);
  const std::string out = path_.string();
  // Sizes that are not even have no place in the usual colour format.
  const std::array<const char*, 19> words = {
      "ffmpeg", "-loglevel",  "error",    "-y",
      "-f",     "rawvideo",   "-pix_fmt", "rgb24",
      "-s",     size.c_str(), "-r",       rate.c_str(),
      "-i",     "-",          "-vf",      "pad=ceil(iw/2)*2:ceil(ih/2)*2,format=yuv420p",
      "--",     out.c_str(),  nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  const int error = posix_spawnp(&ffmpeg_, "ffmpeg", &actions, nullptr,
                                 const_cast<char* const*>(words.data()), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[0]);
  pipe_ = ends[1];
  if (error != 0) {
    close(pipe_);
    throw std::runtime_error(fmt::format("ffmpeg: {}", std::strerror(error)));
  }
}

Movie::~Movie() { finish(); }

std::string Movie::finish() {
  if (pipe_ < 0) return "";
  close(std::exchange(pipe_, -1));
  int status = 0;
  waitpid(ffmpeg_, &status, 0);
  return status == 0 ? "" : fmt::format("{}: ffmpeg has not made a film of it", path_.string());
}

void Movie::add(const Image& image) {
  if (image.width != width_ || image.height != height_) return;
  if (ffmpeg_ < 0) {
    write_png(path_ / fmt::format("{:05}.png", ++pictures_), image);
    return;
  }
  std::size_t written = 0;
  while (written < image.rgb.size()) {
    const ssize_t more = write(pipe_, image.rgb.data() + written, image.rgb.size() - written);
    if (more < 0 && errno == EINTR) continue;
    if (more <= 0) {
      throw std::runtime_error(fmt::format("{}: ffmpeg has given up", path_.string()));
    }
    written += static_cast<std::size_t>(more);
  }
}

std::filesystem::path name_by_time() { return mapping::local_time("geomap_%Y%m%d_%H%M%S"); }

}  // namespace geomap::viewer
