// SPDX-License-Identifier: BSD-3-Clause
#include "label_sheet.hpp"

#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace geomap::bench {
namespace {

using geometry::ColorImage;
using geometry::DepthImage;
using Color = std::array<std::uint8_t, 3>;

constexpr int kThinning = 2;
constexpr int kGap = 4;            // between pictures [pixel]
constexpr double kFarthest = 5.0;  // shown as dark as depth gets [m]

// Hues a golden angle apart, so that neighbouring numbers look different.
Color color_of(int label) {
  const double hue = std::fmod(0.618034 * label, 1.0), value = label % 2 == 0 ? 1.0 : 0.75;
  const auto channel = [&](double shift) {
    const double h = std::abs(std::fmod(hue + shift, 1.0) * 6.0 - 3.0) - 1.0;
    return static_cast<std::uint8_t>(255.0 * value * (0.2 + 0.8 * std::clamp(h, 0.0, 1.0)));
  };
  return {channel(0.0), channel(2.0 / 3.0), channel(1.0 / 3.0)};
}

template <typename ColorOf>  // of the index of a pixel with a reading
ColorImage paint(const DepthImage& depth, ColorOf&& color_of_pixel) {
  ColorImage image{depth.width, depth.height, {}};
  image.rgb.reserve(3 * depth.millimetres.size());
  for (std::size_t i = 0; i < depth.millimetres.size(); ++i) {
    const Color color = DepthImage::is_reading(depth.millimetres[i]) ? color_of_pixel(i) : Color{};
    image.rgb.insert(image.rgb.end(), color.begin(), color.end());
  }
  return image;
}

void copy_thinned(const ColorImage& from, int left, int top, ColorImage& sheet) {
  for (int v = 0; v < from.height / kThinning; ++v) {
    for (int u = 0; u < from.width / kThinning; ++u) {
      const auto source = std::ptrdiff_t{3} * (kThinning * v * from.width + kThinning * u);
      const auto target = std::ptrdiff_t{3} * ((top + v) * sheet.width + left + u);
      std::copy_n(from.rgb.begin() + source, 3, sheet.rgb.begin() + target);
    }
  }
}

}  // namespace

ColorImage picture_of_depth(const DepthImage& depth) {
  return paint(depth, [&](std::size_t i) {
    const double far = std::min(1.0, 1e-3 * depth.millimetres[i] / kFarthest);
    const auto grey = static_cast<std::uint8_t>(255.0 - 215.0 * far);
    return Color{grey, grey, grey};
  });
}

ColorImage picture_of_labels(const DepthImage& depth, std::span<const std::int16_t> label) {
  return paint(depth, [&](std::size_t i) {
    return label[i] < 0 ? Color{50, 50, 50} : color_of(label[i]);
  });
}

void write_contact_sheet(const std::vector<std::vector<ColorImage>>& rows,
                         const std::filesystem::path& file) {
  if (rows.empty() || rows.front().empty()) throw std::invalid_argument("no pictures");
  const ColorImage& first = rows.front().front();
  const int width = first.width / kThinning + kGap, height = first.height / kThinning + kGap;
  ColorImage sheet{
      width * static_cast<int>(rows.front().size()), height * static_cast<int>(rows.size()), {}};
  sheet.rgb.assign(std::size_t{3} * static_cast<std::size_t>(sheet.width * sheet.height), 255);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (rows[row].size() != rows.front().size()) throw std::invalid_argument("rows differ");
    for (std::size_t column = 0; column < rows[row].size(); ++column) {
      const ColorImage& picture = rows[row][column];
      if (picture.width != first.width || picture.height != first.height) {
        throw std::invalid_argument("pictures differ in size");
      }
      copy_thinned(picture, width * static_cast<int>(column), height * static_cast<int>(row),
                   sheet);
    }
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(sheet.width);
  image.height = static_cast<png_uint_32>(sheet.height);
  image.format = PNG_FORMAT_RGB;
  if (png_image_write_to_file(&image, file.c_str(), 0, sheet.rgb.data(), 0, nullptr) == 0) {
    throw std::runtime_error("cannot write " + file.string() + ": " + image.message);
  }
}

}  // namespace geomap::bench
