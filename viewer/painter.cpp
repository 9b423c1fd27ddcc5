// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/painter.hpp"

#include <epoxy/gl.h>

#include <cmath>
#include <vector>

#include "viewer/shader_text.hpp"

namespace geomap::viewer {
namespace {

constexpr double kDashPixels = 12.0;

// Blending and writing of depth for the length of one drawing.
class DrawState {
 public:
  DrawState(bool blends, bool writes_depth, float depth_offset) {
    if (blends) glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(writes_depth ? GL_TRUE : GL_FALSE);
    glDepthFunc(GL_LEQUAL);
    // Fills step back and lines forward, so that an outline is not eaten by what it goes round.
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(depth_offset, depth_offset);
  }
  ~DrawState() {
    glDisable(GL_BLEND);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    glUseProgram(0);
  }
  DrawState(const DrawState&) = delete;
  DrawState& operator=(const DrawState&) = delete;
};

GlProgram& made(std::optional<GlProgram>& program, const char* name,
                const GlProgram::Sources& sources) {
  if (!program) program.emplace(name, sources);
  program->use();
  return *program;
}

Eigen::Vector2f viewport_of(const DrawContext& context) {
  return {static_cast<float>(context.camera.width()), static_cast<float>(context.camera.height())};
}

// Four rows for each style, as the shaders read them.
std::vector<Rgba> table_of(std::span<const SurfaceStyle> styles, float scale) {
  std::vector<Rgba> rows;
  rows.reserve(4 * styles.size());
  for (const SurfaceStyle& style : styles) {
    const Rgba width = {0.5F * style.width * scale, 0.0F, 0.0F, 0.0F};
    rows.insert(rows.end(), {style.front, style.back, style.outline, width});
  }
  return rows;
}

// In clip coordinates, what moves a point away from the eye along its line of sight.
Rgba clip_backwards(const DrawContext& context, double distance) {
  const Eigen::Vector4f shift = (-distance * context.camera.projection().col(2)).cast<float>();
  return {shift[0], shift[1], shift[2], shift[3]};
}

Eigen::Matrix4d clip_from_buffer(const DrawContext& context,
                                 const Eigen::Isometry3d& T_world_buffer) {
  // In this order the far parts of both translations cancel in double precision.
  return context.camera.projection() * (context.camera.view() * T_world_buffer.matrix());
}

const std::array<Rgba, 9>& ramp_samples() {
  static const std::array<Rgba, 9> kSamples = [] {
    std::array<Rgba, 9> samples{};
    for (std::size_t i = 0; i < samples.size(); ++i) {
      samples[i] = ramp(static_cast<double>(i) / 8.0);
    }
    return samples;
  }();
  return kSamples;
}

// Its product with a point of the buffer is the share of the height between low and high.
Rgba height_row(const Eigen::Isometry3d& T_world_buffer, const PointStyle::Heights& heights) {
  const double range = std::max(heights.high - heights.low, 1e-6);
  const Eigen::Vector4d row =
      (T_world_buffer.matrix().row(2).transpose() - Eigen::Vector4d(0, 0, 0, heights.low)) / range;
  return {static_cast<float>(row[0]), static_cast<float>(row[1]), static_cast<float>(row[2]),
          static_cast<float>(row[3])};
}

}  // namespace

void Painter::upload(GlBuffer& buffer, std::span<const Vertex> vertices) {
  buffer.upload(vertices);
  ++uploads_;
}

void Painter::upload(GlBuffer& buffer, std::span<const ScenePoint> points) {
  buffer.upload(points);
  ++uploads_;
}

void Painter::extend(GlBuffer& buffer, std::span<const Vertex> vertices, std::size_t unchanged) {
  buffer.extend(vertices, unchanged);
  ++uploads_;
}

void Painter::fill(const DrawContext& context, const GlBuffer& buffer,
                   const Eigen::Isometry3d& T_world_buffer, const FillStyle& style) {
  fill(context, buffer, buffer.whole(), T_world_buffer, style);
}

void Painter::fill(const DrawContext& context, const GlBuffer& buffer, const VertexRanges& ranges,
                   const Eigen::Isometry3d& T_world_buffer, const FillStyle& style) {
  const DrawState state(true, style.writes_depth, 1.0F);
  const GlProgram& program = made(fill_, "fill", {kFillVertex, "", kFillFragment});
  program.set("clip_from_buffer", clip_from_buffer(context, T_world_buffer));
  program.set("front", style.front);
  program.set("back", style.back);
  buffer.draw_triangles(ranges);
}

void Painter::lines(const DrawContext& context, const GlBuffer& buffer,
                    const Eigen::Isometry3d& T_world_buffer, const LineStyle& style) {
  lines(context, buffer, buffer.whole(), T_world_buffer, style);
}

void Painter::lines(const DrawContext& context, const GlBuffer& buffer, const VertexRanges& ranges,
                    const Eigen::Isometry3d& T_world_buffer, const LineStyle& style) {
  const DrawState state(true, style.writes_depth, -1.0F);
  const GlProgram& program = made(lines_, "lines", {kLineVertex, kLineGeometry, kLineFragment});
  program.set("clip_from_buffer", clip_from_buffer(context, T_world_buffer));
  program.set("viewport", viewport_of(context));
  program.set("half_width", 0.5 * style.width * context.scale);
  program.set("dash", style.dash);
  program.set("tint", style.tint);
  buffer.draw_lines(ranges);
}

void Painter::surfaces(const DrawContext& context, const GlBuffer& buffer,
                       std::span<const SurfaceRun> runs, const Eigen::Isometry3d& T_world_buffer,
                       std::span<const SurfaceStyle> styles, bool faces_write_depth) {
  if (runs.empty()) return;
  if (!styles.empty()) styles_.upload(table_of(styles, context.scale));
  styles_.bind();
  const Eigen::Matrix4d clip = clip_from_buffer(context, T_world_buffer);
  const GlProgram& faces = made(surface_faces_, "faces", {kSurfaceVertex, "", kSurfaceFragment});
  faces.set("clip_from_buffer", clip);
  const GlProgram& outlines =
      made(surface_outlines_, "outlines", {kSurfaceLineVertex, kLineGeometry, kLineFragment});
  outlines.set("clip_from_buffer", clip);
  outlines.set("viewport", viewport_of(context));
  outlines.set("dash", 0.0);
  for (const SurfaceRun& run : runs) {
    if (!run.faces.empty()) {
      const DrawState state(true, faces_write_depth, 1.0F);
      faces.use();
      buffer.draw_triangles(run.faces);
    }
    if (!run.outlines.empty()) {
      const DrawState state(true, true, -1.0F);
      outlines.use();
      buffer.draw_lines(run.outlines);
    }
  }
  glUseProgram(0);
}

void Painter::points(const DrawContext& context, const GlBuffer& buffer, std::size_t count,
                     const Eigen::Isometry3d& T_world_buffer, const PointStyle& style) {
  const DrawState state(false, true, 0.0F);
  const GlProgram& program = made(points_, "points", {kPointVertex, "", kPointFragment});
  program.set("clip_from_buffer", clip_from_buffer(context, T_world_buffer));
  program.set("size", style.size * context.scale);
  program.set("is_round", style.is_round ? 1.0 : 0.0);
  program.set("by_height", style.heights ? 1.0 : 0.0);
  program.set("height_row",
              height_row(T_world_buffer, style.heights.value_or(PointStyle::Heights{})));
  program.set("ramp", ramp_samples());
  program.set("hides", style.hidden_above ? 1.0 : 0.0);
  const double height = style.hidden_above.value_or(0.0);
  program.set("hidden_row", height_row(T_world_buffer, {.low = height, .high = height + 1.0}));
  program.set("veil", style.veil);
  program.set("clip_backwards", clip_backwards(context, style.setback));
  glEnable(GL_PROGRAM_POINT_SIZE);
  buffer.draw_points(count);
  glDisable(GL_PROGRAM_POINT_SIZE);
  points_drawn_ += std::min(count, buffer.size());
}

double dash_length(const DrawContext& context, const Eigen::Vector3d& point) {
  const double wanted =
      kDashPixels * static_cast<double>(context.scale) * context.camera.metres_per_pixel(point);
  if (!std::isfinite(wanted) || wanted <= 0.0) return 0.1;
  return std::exp2(std::round(std::log2(wanted)));
}

}  // namespace geomap::viewer
