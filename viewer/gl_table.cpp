// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/gl_table.hpp"

#include <epoxy/gl.h>

namespace geomap::viewer {

GlTable::~GlTable() {
  if (texture_ != 0) glDeleteTextures(1, &texture_);
  if (buffer_ != 0) glDeleteBuffers(1, &buffer_);
}

void GlTable::upload(std::span<const Rgba> rows) {
  if (buffer_ == 0) glGenBuffers(1, &buffer_);
  if (texture_ == 0) glGenTextures(1, &texture_);
  glBindBuffer(GL_TEXTURE_BUFFER, buffer_);
  glBufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(rows.size_bytes()), rows.data(),
               GL_STREAM_DRAW);
  glBindTexture(GL_TEXTURE_BUFFER, texture_);
  glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, buffer_);
  glBindTexture(GL_TEXTURE_BUFFER, 0);
  glBindBuffer(GL_TEXTURE_BUFFER, 0);
}

void GlTable::bind() const { glBindTexture(GL_TEXTURE_BUFFER, texture_); }

}  // namespace geomap::viewer
