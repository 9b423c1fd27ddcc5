// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/framebuffer.hpp"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace geomap::viewer {

Framebuffer::Framebuffer(int width, int height) {
  glGenFramebuffers(1, &framebuffer_);
  glGenTextures(1, &color_);
  glGenRenderbuffers(1, &depth_);
  resize(width, height);
}

Framebuffer::~Framebuffer() {
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteTextures(1, &color_);
  glDeleteRenderbuffers(1, &depth_);
}

void Framebuffer::resize(int width, int height) {
  if (width == width_ && height == height_) return;
  width_ = std::max(width, 1);
  height_ = std::max(height, 1);
  glBindTexture(GL_TEXTURE_2D, color_);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width_, height_, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glBindTexture(GL_TEXTURE_2D, 0);
  glBindRenderbuffer(GL_RENDERBUFFER, depth_);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width_, height_);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_, 0);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw std::runtime_error(
        fmt::format("the graphics driver makes no picture of {} x {} pixels", width_, height_));
  }
}

void Framebuffer::begin(const Rgba& background) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, width_, height_);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glClearColor(background[0], background[1], background[2], 1.0F);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

Image Framebuffer::read() const { return read_pixels(framebuffer_, width_, height_); }

Image read_pixels(unsigned framebuffer, int width, int height) {
  const auto row = static_cast<std::ptrdiff_t>(3) * width;
  Image image{.width = width, .height = height, .rgb = {}};
  image.rgb.resize(static_cast<std::size_t>(row * height));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
  // OpenGL's rows begin at the bottom.
  for (int y = 0; y < height / 2; ++y) {
    const auto top = image.rgb.begin() + y * row;
    std::swap_ranges(top, top + row, image.rgb.begin() + (height - 1 - y) * row);
  }
  return image;
}

}  // namespace geomap::viewer
