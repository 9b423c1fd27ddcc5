// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "viewer/scene_model.hpp"

namespace geomap::viewer {

/// @brief A corner of a triangle, or an end of a line.
struct Vertex {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  // in the frame of its buffer [m]
  std::array<std::uint8_t, 4> color = {255, 255, 255, 255};
  float along = 0.0F;  // way along the line, for dashes [m]
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

  std::size_t size() const { return size_; }

  /// @brief Draws all vertices, or the first `count`, with the program in use.
  void draw_triangles() const;
  void draw_lines() const;
  void draw_points(std::size_t count) const;

 private:
  void replace(const void* data, std::size_t count, std::size_t stride);
  void draw(unsigned mode, std::size_t count) const;

  unsigned array_ = 0, buffer_ = 0;
  std::size_t size_ = 0;
};

}  // namespace geomap::viewer
