// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "viewer/scene_model.hpp"

namespace geomap::viewer {

/// @brief A corner of a triangle, or an end of a line.
struct Vertex {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  // in the frame of its buffer [m]
  std::array<std::uint8_t, 4> color = {255, 255, 255, 255};
  float along = 0.0F;         // way along the line, for dashes [m]
  std::uint32_t surface = 0;  // number of its surface, where many share a buffer
  bool operator==(const Vertex&) const = default;
};

/// @brief Vertices of a buffer that follow one another.
struct VertexRange {
  int first = 0, count = 0;
};

/// @brief Pieces of a buffer, in the order in which they are drawn.
class VertexRanges {
 public:
  VertexRanges() = default;
  explicit VertexRanges(VertexRange range) { add(range); }
  /// @brief One that begins where the last one ends makes that one longer.
  void add(VertexRange range);
  bool empty() const { return first_.empty(); }
  std::size_t size() const { return first_.size(); }
  const int* first() const { return first_.data(); }
  const int* count() const { return count_.data(); }

 private:
  std::vector<int> first_, count_;
};

/// @brief Vertices in the memory of the graphics card. Needs a current context from the first
/// upload on, for as long as it lives.
class GlBuffer {
 public:
  GlBuffer() = default;
  ~GlBuffer();
  GlBuffer(GlBuffer&& other) noexcept;
  GlBuffer& operator=(GlBuffer&& other) noexcept;

  /// @brief Replaces all that it holds.
  void upload(std::span<const Vertex> vertices);
  void upload(std::span<const ScenePoint> points);
  /// @brief Holds these vertices from now on; the first `unchanged` ones it holds already. Room
  /// grows by doubling, so that what grows at its end costs no more than what is new.
  void extend(std::span<const Vertex> vertices, std::size_t unchanged);

  std::size_t size() const { return size_; }
  VertexRanges whole() const { return VertexRanges({0, static_cast<int>(size_)}); }

  /// @brief Draws pieces, or the first `count` vertices, with the program in use.
  void draw_triangles(const VertexRanges& ranges) const;
  void draw_lines(const VertexRanges& ranges) const;
  void draw_points(std::size_t count) const;

 private:
  void begin();
  void replace(const void* data, std::size_t count, std::size_t stride);
  void draw(unsigned mode, const VertexRanges& ranges) const;

  unsigned array_ = 0, buffer_ = 0;
  std::size_t size_ = 0, room_ = 0;  // vertices
};

}  // namespace geomap::viewer
