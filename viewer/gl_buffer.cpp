// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/gl_buffer.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace geomap::viewer {
namespace {

static_assert(sizeof(Vertex) == 24 && offsetof(Vertex, color) == 12 &&
              offsetof(Vertex, along) == 16 && offsetof(Vertex, surface) == 20);
static_assert(sizeof(ScenePoint) == 16 && offsetof(ScenePoint, color) == 12);

void set_attribute(GLuint index, GLint components, GLenum type, std::size_t stride,
                   std::size_t offset) {
  glEnableVertexAttribArray(index);
  glVertexAttribPointer(index, components, type, type == GL_UNSIGNED_BYTE ? GL_TRUE : GL_FALSE,
                        static_cast<GLsizei>(stride), reinterpret_cast<const void*>(offset));
}

// Where the bound array finds its vertices in the bound buffer.
void set_vertex_attributes() {
  set_attribute(0, 3, GL_FLOAT, sizeof(Vertex), offsetof(Vertex, position));
  set_attribute(1, 4, GL_UNSIGNED_BYTE, sizeof(Vertex), offsetof(Vertex, color));
  set_attribute(2, 1, GL_FLOAT, sizeof(Vertex), offsetof(Vertex, along));
  glEnableVertexAttribArray(3);
  glVertexAttribIPointer(3, 1, GL_UNSIGNED_INT, sizeof(Vertex),
                         reinterpret_cast<const void*>(offsetof(Vertex, surface)));
}

}  // namespace

void VertexRanges::add(VertexRange range) {
  if (range.count <= 0) return;
  if (!empty() && first_.back() + count_.back() == range.first) {
    count_.back() += range.count;
    return;
  }
  first_.push_back(range.first);
  count_.push_back(range.count);
}

GlBuffer::~GlBuffer() {
  if (array_ != 0) glDeleteVertexArrays(1, &array_);
  if (buffer_ != 0) glDeleteBuffers(1, &buffer_);
}

GlBuffer::GlBuffer(GlBuffer&& other) noexcept
    : array_(std::exchange(other.array_, 0U)),
      buffer_(std::exchange(other.buffer_, 0U)),
      size_(std::exchange(other.size_, 0U)),
      room_(std::exchange(other.room_, 0U)) {}

GlBuffer& GlBuffer::operator=(GlBuffer&& other) noexcept {
  std::swap(array_, other.array_);
  std::swap(buffer_, other.buffer_);
  std::swap(size_, other.size_);
  std::swap(room_, other.room_);
  return *this;
}

void GlBuffer::upload(std::span<const Vertex> vertices) {
  begin();
  replace(vertices.data(), vertices.size(), sizeof(Vertex));
  set_vertex_attributes();
  glBindVertexArray(0);
}

void GlBuffer::upload(std::span<const ScenePoint> points) {
  begin();
  replace(points.data(), points.size(), sizeof(ScenePoint));
  set_attribute(0, 3, GL_FLOAT, sizeof(ScenePoint), 0);
  set_attribute(1, 4, GL_UNSIGNED_BYTE, sizeof(ScenePoint), offsetof(ScenePoint, color));
  glBindVertexArray(0);
}

void GlBuffer::extend(std::span<const Vertex> vertices, std::size_t unchanged) {
  begin();
  if (vertices.size() > room_) {
    const std::size_t room = std::max(vertices.size(), 2 * room_);
    replace(nullptr, room, sizeof(Vertex));
    set_vertex_attributes();
    unchanged = 0;
  }
  const std::span<const Vertex> changed = vertices.subspan(std::min(unchanged, vertices.size()));
  glBufferSubData(GL_ARRAY_BUFFER,
                  static_cast<GLintptr>((vertices.size() - changed.size()) * sizeof(Vertex)),
                  static_cast<GLsizeiptr>(changed.size_bytes()), changed.data());
  size_ = vertices.size();
  glBindVertexArray(0);
}

void GlBuffer::begin() {
  if (array_ == 0) glGenVertexArrays(1, &array_);
  if (buffer_ == 0) glGenBuffers(1, &buffer_);
  glBindVertexArray(array_);
  glBindBuffer(GL_ARRAY_BUFFER, buffer_);
}

void GlBuffer::replace(const void* data, std::size_t count, std::size_t stride) {
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(count * stride), data, GL_STATIC_DRAW);
  size_ = room_ = count;
}

void GlBuffer::draw_triangles(const VertexRanges& ranges) const { draw(GL_TRIANGLES, ranges); }
void GlBuffer::draw_lines(const VertexRanges& ranges) const { draw(GL_LINES, ranges); }

void GlBuffer::draw_points(std::size_t count) const {
  draw(GL_POINTS, VertexRanges({0, static_cast<int>(std::min(count, size_))}));
}

void GlBuffer::draw(unsigned mode, const VertexRanges& ranges) const {
  if (ranges.empty()) return;
  glBindVertexArray(array_);
  glMultiDrawArrays(mode, ranges.first(), ranges.count(), static_cast<GLsizei>(ranges.size()));
  glBindVertexArray(0);
}

}  // namespace geomap::viewer
