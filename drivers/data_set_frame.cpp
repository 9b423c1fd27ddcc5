// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/data_set_frame.hpp"

#include <algorithm>
#include <cctype>

#include "drivers/image_file.hpp"

namespace geomap::drivers {
namespace {

bool is_jpeg_name(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".jpg" || extension == ".jpeg";
}

}  // namespace

geometry::CameraModel resized(const geometry::CameraModel& camera, int width, int height) {
  if (camera.width == width && camera.height == height) return camera;
  const double sx = static_cast<double>(width) / camera.width;
  const double sy = static_cast<double>(height) / camera.height;
  return {width,
          height,
          sx * camera.fx,
          sy * camera.fy,
          sx * (camera.cx + 0.5) - 0.5,
          sy * (camera.cy + 0.5) - 0.5};
}

void load_color(const std::filesystem::path& path, SourceFrame& out) {
  geometry::CameraModel& camera = out.frame.color_camera;
  if (is_jpeg_name(path)) {
    JpegFile jpeg = read_jpeg(path);
    camera.width = jpeg.width;
    camera.height = jpeg.height;
    out.jpeg = std::move(jpeg.bytes);
  } else {
    out.frame.color = read_color_png(path);
    camera.width = out.frame.color.width;
    camera.height = out.frame.color.height;
  }
}

std::string to_string(const FrameRange& range) {
  if (range.to == FrameRange{}.to) return "from " + std::to_string(range.from) + " on";
  return std::to_string(range.from) + " to " + std::to_string(range.to);
}

}  // namespace geomap::drivers
