// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/gl_buffer.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace geomap::viewer {
namespace {

static_assert(sizeof(Vertex) == 20 && offsetof(Vertex, color) == 12 &&
              offsetof(Vertex, along) == 16);
static_assert(sizeof(ScenePoint) == 16 && offsetof(ScenePoint, color) == 12);

void set_attribute(GLuint index, GLint components, GLenum type, std::size_t stride,
                   std::size_t offset) {
  glEnableVertexAttribArray(index);
  glVertexAttribPointer(index, components, type, type == GL_UNSIGNED_BYTE ? GL_TRUE : GL_FALSE,
                        static_cast<GLsizei>(stride), reinterpret_cast<const void*>(offset));
}

}  // namespace

GlBuffer::~GlBuffer() {
  if (array_ != 0) glDeleteVertexArrays(1, &array_);
  if (buffer_ != 0) glDeleteBuffers(1, &buffer_);
}

GlBuffer::GlBuffer(GlBuffer&& other) noexcept
    : array_(std::exchange(other.array_, 0U)),
      buffer_(std::exchange(other.buffer_, 0U)),
      size_(std::exchange(other.size_, 0U)) {}

GlBuffer& GlBuffer::operator=(GlBuffer&& other) noexcept {
  std::swap(array_, other.array_);
  std::swap(buffer_, other.buffer_);
  std::swap(size_, other.size_);
  return *this;
}

void GlBuffer::upload(std::span<const Vertex> vertices) {
  replace(vertices.data(), vertices.size(), sizeof(Vertex));
  set_attribute(2, 1, GL_FLOAT, sizeof(Vertex), offsetof(Vertex, along));
  glBindVertexArray(0);
}

void GlBuffer::upload(std::span<const ScenePoint> points) {
  replace(points.data(), points.size(), sizeof(ScenePoint));
  glBindVertexArray(0);
}

void GlBuffer::replace(const void* data, std::size_t count, std::size_t stride) {
  if (array_ == 0) glGenVertexArrays(1, &array_);
  if (buffer_ == 0) glGenBuffers(1, &buffer_);
  glBindVertexArray(array_);
  glBindBuffer(GL_ARRAY_BUFFER, buffer_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(count * stride), data, GL_STATIC_DRAW);
  set_attribute(0, 3, GL_FLOAT, stride, 0);
  set_attribute(1, 4, GL_UNSIGNED_BYTE, stride, 12);
  size_ = count;
}

void GlBuffer::draw_triangles() const { draw(GL_TRIANGLES, size_); }
void GlBuffer::draw_lines() const { draw(GL_LINES, size_); }
void GlBuffer::draw_points(std::size_t count) const { draw(GL_POINTS, std::min(count, size_)); }

void GlBuffer::draw(unsigned mode, std::size_t count) const {
  if (count == 0) return;
  glBindVertexArray(array_);
  glDrawArrays(mode, 0, static_cast<GLsizei>(count));
  glBindVertexArray(0);
}

}  // namespace geomap::viewer
