// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/image_texture.hpp"

#include <epoxy/gl.h>

#include <algorithm>

#include "viewer/palette.hpp"

namespace geomap::viewer {
namespace {

constexpr double kNearest = 400.0, kFarthest = 5000.0;  // of the ramp [mm]

}  // namespace

ImageTexture::ImageTexture() {
  glGenTextures(1, &texture_);
  glBindTexture(GL_TEXTURE_2D, texture_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glBindTexture(GL_TEXTURE_2D, 0);
}

ImageTexture::~ImageTexture() { glDeleteTextures(1, &texture_); }

void ImageTexture::set(const Image& image) {
  if (image.width <= 0 || image.height <= 0) return;
  glBindTexture(GL_TEXTURE_2D, texture_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, image.width, image.height, 0, GL_RGB, GL_UNSIGNED_BYTE,
               image.rgb.data());
  glBindTexture(GL_TEXTURE_2D, 0);
  has_picture_ = true;
}

Image depth_picture(const geometry::DepthImage& depth) {
  Image image{depth.width, depth.height, {}};
  image.rgb.reserve(3 * depth.millimetres.size());
  for (const std::uint16_t value : depth.millimetres) {
    if (!geometry::DepthImage::is_reading(value)) {
      image.rgb.insert(image.rgb.end(), 3, 0);
      continue;
    }
    const double share = std::clamp((kFarthest - value) / (kFarthest - kNearest), 0.0, 1.0);
    const Rgba color = ramp(share);
    for (std::size_t i = 0; i < 3; ++i) {
      image.rgb.push_back(static_cast<std::uint8_t>(255.0F * color[i]));
    }
  }
  return image;
}

}  // namespace geomap::viewer
