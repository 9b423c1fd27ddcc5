// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "viewer/painter.hpp"
#include "viewer/surface_shape.hpp"

namespace geomap::viewer {

/// @brief Many surfaces in one buffer, which is drawn in few calls. Its axes are the world's.
class SurfaceBatch {
 public:
  struct Part {
    VertexRange faces, outline;
  };

  /// @brief Replaces all that it holds; Vertex::surface is the place in `shapes`.
  void set(std::span<const SurfaceShape* const> shapes, Painter& painter);

  const GlBuffer& buffer() const { return buffer_; }
  const Eigen::Isometry3d& T_world_batch() const { return T_world_batch_; }
  const Part& operator[](std::size_t i) const { return parts_[i]; }
  std::size_t size() const { return parts_.size(); }

 private:
  GlBuffer buffer_;
  std::vector<Part> parts_;
  Eigen::Isometry3d T_world_batch_ = Eigen::Isometry3d::Identity();
};

}  // namespace geomap::viewer
