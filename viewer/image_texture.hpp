// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/rgbd_frame.hpp"
#include "viewer/image.hpp"

namespace geomap::viewer {

/// @brief A picture for a panel. Needs a current context as long as it lives.
class ImageTexture {
 public:
  ImageTexture();
  ~ImageTexture();
  ImageTexture(const ImageTexture&) = delete;
  ImageTexture& operator=(const ImageTexture&) = delete;

  void set(const Image& image);
  /// @brief OpenGL's name; 0: there is no picture yet.
  unsigned name() const { return has_picture_ ? texture_ : 0; }

 private:
  unsigned texture_ = 0;
  bool has_picture_ = false;
};

/// @brief Depth as brightness and colour, near bright; what has no reading is black.
Image depth_picture(const geometry::DepthImage& depth);

}  // namespace geomap::viewer
