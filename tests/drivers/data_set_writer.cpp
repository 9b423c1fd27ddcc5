// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/data_set_writer.hpp"

// jpeglib.h uses FILE and size_t without including what declares them.
#include <cstddef>
#include <cstdio>
// After those two.
#include <jpeglib.h>
#include <png.h>
#include <stdlib.h>

#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>

namespace geomap::testing {
namespace {

namespace fs = std::filesystem;

std::unique_ptr<FILE, int (*)(FILE*)> open_to_write(const fs::path& path) {
  FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) throw std::runtime_error("cannot write " + path.string());
  return {file, std::fclose};
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "geomap-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void write_png(const fs::path& path, const PngImage& image) {
  const auto file = open_to_write(path);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file.get());
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width),
               static_cast<png_uint_32>(image.height), image.bit_depth, image.color_type,
               image.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
  std::vector<png_color> palette;
  for (std::size_t i = 0; i + 2 < image.palette.size(); i += 3) {
    palette.push_back({image.palette[i], image.palette[i + 1], image.palette[i + 2]});
  }
  if (!palette.empty()) png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
  if (!image.opacities.empty()) {
    png_set_tRNS(png, info, image.opacities.data(), static_cast<int>(image.opacities.size()),
                 nullptr);
  }
  png_write_info(png, info);
  std::vector<std::uint8_t> bytes = image.bytes;
  const std::size_t row_bytes = bytes.size() / static_cast<std::size_t>(image.height);
  std::vector<png_bytep> rows;
  for (int v = 0; v < image.height; ++v) {
    rows.push_back(bytes.data() + static_cast<std::size_t>(v) * row_bytes);
  }
  png_write_image(png, rows.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
}

void write_depth_png(const fs::path& path, const geometry::DepthImage& depth) {
  PngImage image{depth.width, depth.height, 16, PNG_COLOR_TYPE_GRAY, {}};
  for (const std::uint16_t value : depth.millimetres) {
    image.bytes.push_back(static_cast<std::uint8_t>(value >> 8));
    image.bytes.push_back(static_cast<std::uint8_t>(value & 0xff));
  }
  write_png(path, image);
}

void write_color_png(const fs::path& path, const geometry::ColorImage& color) {
  write_png(path, {color.width, color.height, 8, PNG_COLOR_TYPE_RGB, color.rgb});
}

void write_jpeg(const fs::path& path, const geometry::ColorImage& color) {
  const auto file = open_to_write(path);
  jpeg_compress_struct jpeg;
  jpeg_error_mgr errors;
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  jpeg_stdio_dest(&jpeg, file.get());
  jpeg.image_width = static_cast<JDIMENSION>(color.width);
  jpeg.image_height = static_cast<JDIMENSION>(color.height);
  jpeg.input_components = 3;
  jpeg.in_color_space = JCS_RGB;
  jpeg_set_defaults(&jpeg);
  jpeg_start_compress(&jpeg, TRUE);
  std::vector<std::uint8_t> rgb = color.rgb;
  while (jpeg.next_scanline < jpeg.image_height) {
    JSAMPROW row = rgb.data() + std::size_t{3} * jpeg.next_scanline * jpeg.image_width;
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
}

void write_bytes(const fs::path& path, const std::vector<std::uint8_t>& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

void write_text(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }

std::vector<std::uint8_t> file_bytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

geometry::DepthImage some_depth(int number, int width, int height) {
  geometry::DepthImage depth{width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    depth.millimetres.push_back(static_cast<std::uint16_t>(600 + 37 * number + 11 * i));
  }
  depth.millimetres[1] = geometry::DepthImage::kNoReading;
  depth.millimetres[2] = geometry::DepthImage::kInvalid;
  return depth;
}

geometry::ColorImage some_color(int number, int width, int height) {
  geometry::ColorImage color{width, height, {}};
  for (int i = 0; i < 3 * width * height; ++i) {
    color.rgb.push_back(static_cast<std::uint8_t>(5 * number + i / 7));
  }
  return color;
}

Eigen::Isometry3d some_pose(int number) {
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  T_world_camera.translate(Eigen::Vector3d(0.1 * number, -0.2 + 0.01 * number, 1.5));
  T_world_camera.rotate(
      Eigen::AngleAxisd(0.3 + 0.05 * number, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()));
  return T_world_camera;
}

std::string pose_text(const Eigen::Matrix4d& T_world_camera, int digits) {
  std::string text;
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) {
      char number[64];
      std::snprintf(number, sizeof number, " %.*e\t", digits, T_world_camera(r, c));
      text += number;
    }
    text += "\r\n";
  }
  return text;
}

std::string frame_name(int number, const std::string& rest) {
  char name[64];
  std::snprintf(name, sizeof name, "frame-%06d%s", number, rest.c_str());
  return name;
}

void write_seven_scenes_frame(const fs::path& folder, int number) {
  write_depth_png(folder / frame_name(number, ".depth.png"), some_depth(number));
  write_jpeg(folder / frame_name(number, ".color.jpg"), some_color(number));
  write_text(folder / frame_name(number, ".pose.txt"), pose_text(some_pose(number).matrix()));
}

}  // namespace geomap::testing
