// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "viewer/image.hpp"
#include "viewer/palette.hpp"

namespace geomap::viewer {

/// @brief A picture with depth that is drawn into, off the screen. Needs a current context for as
/// long as it lives.
class Framebuffer {
 public:
  /// @brief Size [px], at least 1 x 1. @throws std::runtime_error when the driver refuses it.
  Framebuffer(int width, int height);
  ~Framebuffer();
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;

  int width() const { return width_; }
  int height() const { return height_; }
  /// @brief What was drawn is gone, unless the size is what it was.
  void resize(int width, int height);

  /// @brief From now on everything is drawn into it, all of it; begins with one colour and nothing
  /// in front. Depth test on, blending off.
  void begin(const Rgba& background);

  Image read() const;
  // OpenGL's names of it and its colours.
  unsigned id() const { return framebuffer_; }
  unsigned texture() const { return color_; }

 private:
  int width_ = 0, height_ = 0;
  unsigned framebuffer_ = 0, color_ = 0, depth_ = 0;
};

/// @brief What is drawn in a framebuffer, 0 being the window's, from its lower left corner on.
Image read_pixels(unsigned framebuffer, int width, int height);

}  // namespace geomap::viewer
