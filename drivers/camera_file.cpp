// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/camera_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <span>

#include "drivers/frame_source.hpp"
#include "drivers/text_file.hpp"
#include "drivers/yaml_map.hpp"

namespace geomap::drivers {
namespace {

constexpr double kLargestTerm = 1.0;  // of a correction: a depth off by its own size is no depth

int size_of(const YamlMap& map, std::string_view key) {
  const double value = map.positive(key);
  if (value != std::floor(value) || value > 8192.0) map.fail(key, "is no size of an image");
  return static_cast<int>(value);
}

std::optional<geometry::CameraModel> camera_of(const YamlMap& file, std::string_view key) {
  if (!file.has(key)) return std::nullopt;
  const YamlMap map = file.map(key);
  map.allow_only({"width", "height", "fx", "fy", "cx", "cy"});
  return geometry::CameraModel{size_of(map, "width"), size_of(map, "height"), map.positive("fx"),
                               map.positive("fy"),    map.number("cx"),       map.number("cy")};
}

std::string to_text(const char* key, const std::optional<geometry::CameraModel>& camera) {
  if (!camera) return "";
  return fmt::format("{}: {{width: {}, height: {}, fx: {}, fy: {}, cx: {}, cy: {}}}\n", key,
                     camera->width, camera->height, camera->fx, camera->fy, camera->cx, camera->cy);
}

}  // namespace

CameraFile read_camera_file(const std::filesystem::path& path) {
  using geometry::DepthCorrection;
  const YamlMap map = YamlMap::load(path);
  map.allow_only({"name", "depth", "color", "depth_correction"});
  CameraFile file;
  file.name = map.text("name");
  file.depth = camera_of(map, "depth");
  file.color = camera_of(map, "color");
  if (!map.has("depth_correction")) return file;
  const std::vector<double> terms = map.numbers("depth_correction", DepthCorrection::kTerms);
  for (const double term : terms) {
    if (std::abs(term) > kLargestTerm) map.fail("depth_correction", "is too large");
  }
  file.correction = DepthCorrection(DepthCorrection::Terms(terms.data()));
  return file;
}

void write_camera_file(const CameraFile& camera, const std::filesystem::path& path) {
  YAML::Emitter name;
  name << camera.name;
  std::string text = fmt::format("name: {}\n", name.c_str()) + to_text("depth", camera.depth) +
                     to_text("color", camera.color);
  if (!camera.correction.is_none()) {
    const auto& terms = camera.correction.coefficients();
    text += fmt::format(
        "# By geomap-calibrate-depth: true depth is depth (1 + s), s a polynomial of the place in "
        "the image.\ndepth_correction: [{}]\n",
        fmt::join(std::span(terms.data(), static_cast<std::size_t>(terms.size())), ", "));
  }
  write_text_file(path, text);
}

}  // namespace geomap::drivers
