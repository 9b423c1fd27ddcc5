// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/png_file.hpp"

#include <fmt/format.h>
#include <png.h>

#include <stdexcept>
#include <string>
#include <system_error>

namespace geomap::viewer {
namespace {

namespace fs = std::filesystem;

// libpng's simplified interface holds a description that must be freed.
class Description {
 public:
  Description() { png_.version = PNG_IMAGE_VERSION; }
  ~Description() { png_image_free(&png_); }
  Description(const Description&) = delete;
  Description& operator=(const Description&) = delete;
  png_image* operator->() { return &png_; }
  png_image* get() { return &png_; }

 private:
  png_image png_{};
};

[[noreturn]] void fail(const fs::path& path, const char* what, const std::string& why) {
  throw std::runtime_error(fmt::format("{}: {}: {}", path.string(), what, why));
}

std::size_t bytes_of(const Image& image) {
  return std::size_t{3} * static_cast<std::size_t>(image.width) *
         static_cast<std::size_t>(image.height);
}

}  // namespace

void write_png(const fs::path& path, const Image& image) {
  if (image.width < 1 || image.height < 1 || image.rgb.size() != bytes_of(image)) {
    throw std::invalid_argument("a picture needs pixels, as many as its size says");
  }
  Description png;
  png->width = static_cast<png_uint_32>(image.width);
  png->height = static_cast<png_uint_32>(image.height);
  png->format = PNG_FORMAT_RGB;
  // Beside the old file, which it replaces only when it is whole.
  const fs::path part = path.string() + ".part";
  if (png_image_write_to_file(png.get(), part.c_str(), 0, image.rgb.data(), 0, nullptr) == 0) {
    std::error_code ignored;
    fs::remove(part, ignored);
    fail(path, "cannot be written", png->message);
  }
  std::error_code error;
  fs::rename(part, path, error);
  if (!error) return;
  std::error_code ignored;
  fs::remove(part, ignored);
  fail(path, "cannot be written", error.message());
}

Image read_png(const fs::path& path) {
  Description png;
  if (png_image_begin_read_from_file(png.get(), path.c_str()) == 0) {
    fail(path, "cannot be read", png->message);
  }
  png->format = PNG_FORMAT_RGB;
  Image image{
      .width = static_cast<int>(png->width), .height = static_cast<int>(png->height), .rgb = {}};
  image.rgb.resize(bytes_of(image));
  if (png_image_finish_read(png.get(), nullptr, image.rgb.data(), 0, nullptr) == 0) {
    fail(path, "cannot be read", png->message);
  }
  return image;
}

}  // namespace geomap::viewer
