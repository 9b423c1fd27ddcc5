// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "viewer/gl_buffer.hpp"
#include "viewer/gl_program.hpp"
#include "viewer/gl_table.hpp"
#include "viewer/renderer.hpp"

namespace geomap::viewer {

/// @brief How triangles look. Colours are multiplied with those of the vertices.
struct FillStyle {
  Rgba front = {1.0F, 1.0F, 1.0F, 1.0F};  // of the side that is counter-clockwise
  Rgba back = {1.0F, 1.0F, 1.0F, 1.0F};
  bool writes_depth = true;  // false for what is seen through
};

/// @brief How lines look.
struct LineStyle {
  Rgba tint = {1.0F, 1.0F, 1.0F, 1.0F};  // multiplied with the colours of the vertices
  float width = 1.5F;                    // [px], before DrawContext::scale
  double dash = 0.0;                     // length of a dash and its gap [m]; 0: drawn through
  bool writes_depth = true;
};

/// @brief How points look.
struct PointStyle {
  struct Heights {
    double low = 0.0, high = 1.0;  // world z at both ends of the ramp [m]
  };
  float size = 2.0F;  // [px], before DrawContext::scale
  bool is_round = false;
  std::optional<Heights> heights = {};      // colour by height in place of the points' own
  std::optional<double> hidden_above = {};  // world z from which on points are left out [m]
  Rgba veil = {};                           // paled towards this colour by its opacity
  double setback = 0.0;  // they give way to what lies less than this behind them [m]
};

/// @brief How one of many surfaces looks that share a buffer.
struct SurfaceStyle {
  Rgba front, back, outline;
  float width = 1.5F;  // of the outline [px], before DrawContext::scale
};

/// @brief Surfaces that are drawn together: all faces, then all outlines.
struct SurfaceRun {
  VertexRanges faces, outlines;
};

/// @brief Draws buffers for all renderers, and counts what is uploaded. Vertices are relative to
/// their buffer's frame, and only its place in the view is rounded to single precision: so a scene
/// 1 km from the origin looks as one at the origin does.
///
/// Every method needs a current context; those that draw leave depth test on, blending off.
class Painter {
 public:
  void upload(GlBuffer& buffer, std::span<const Vertex> vertices);
  void upload(GlBuffer& buffer, std::span<const ScenePoint> points);
  std::int64_t uploads() const { return uploads_; }

  /// @brief As upload(), but the first `unchanged` vertices are in the buffer already.
  void extend(GlBuffer& buffer, std::span<const Vertex> vertices, std::size_t unchanged);

  /// @brief Triangles and lines: all of the buffer, or pieces of it.
  void fill(const DrawContext& context, const GlBuffer& buffer,
            const Eigen::Isometry3d& T_world_buffer, const FillStyle& style);
  void fill(const DrawContext& context, const GlBuffer& buffer, const VertexRanges& ranges,
            const Eigen::Isometry3d& T_world_buffer, const FillStyle& style);
  void lines(const DrawContext& context, const GlBuffer& buffer,
             const Eigen::Isometry3d& T_world_buffer, const LineStyle& style);
  void lines(const DrawContext& context, const GlBuffer& buffer, const VertexRanges& ranges,
             const Eigen::Isometry3d& T_world_buffer, const LineStyle& style);
  /// @brief One run after another.
  /// @param styles by Vertex::surface; none: those of the last call.
  void surfaces(const DrawContext& context, const GlBuffer& buffer,
                std::span<const SurfaceRun> runs, const Eigen::Isometry3d& T_world_buffer,
                std::span<const SurfaceStyle> styles, bool faces_write_depth);
  /// @param count of points from the first on.
  void points(const DrawContext& context, const GlBuffer& buffer, std::size_t count,
              const Eigen::Isometry3d& T_world_buffer, const PointStyle& style);
  std::size_t points_drawn() const { return points_drawn_; }  // since the beginning

 private:
  // Made when first needed.
  std::optional<GlProgram> fill_, lines_, points_, surface_faces_, surface_outlines_;
  GlTable styles_;
  std::int64_t uploads_ = 0;
  std::size_t points_drawn_ = 0;
};

/// @brief Length of a dash and its gap [m] of some 12 pixels at a point. Goes in steps of two, so
/// that dashes do not crawl while the camera moves.
double dash_length(const DrawContext& context, const Eigen::Vector3d& point);

}  // namespace geomap::viewer
