// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "drivers/portable_math.hpp"
#include "geometry/polygon_clip.hpp"

namespace geomap::drivers {
namespace {

using Eigen::Vector3d;

// Facets about the axis of what is round: at a radius of 1 m they are off by 0.3 mm.
constexpr int kAround = 128;

// Along one edge: where the grid of a face with openings has its lines.
std::vector<double> grid_lines(double length, const std::vector<Eigen::AlignedBox2d>& openings,
                               int axis) {
  std::vector<double> lines = {0.0, length};
  for (const Eigen::AlignedBox2d& opening : openings) {
    lines.push_back(opening.min()[axis]);
    lines.push_back(opening.max()[axis]);
  }
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return lines;
}

// Corner and edges of a unit box's faces, normals outwards; the box stands on z = 0.
SceneFace unit_box_face(const std::string& which) {
  SceneFace face;
  const auto set = [&](const Vector3d& corner, const Vector3d& u, const Vector3d& v) {
    face.corner = corner;
    face.u = u;
    face.v = v;
  };
  const Vector3d x = Vector3d::UnitX();
  const Vector3d y = Vector3d::UnitY();
  const Vector3d z = Vector3d::UnitZ();
  if (which == "front") set({-0.5, 0.5, 0.0}, -y, z);
  if (which == "back") set({0.5, -0.5, 0.0}, y, z);
  if (which == "left") set({0.5, 0.5, 0.0}, -x, z);
  if (which == "right") set({-0.5, -0.5, 0.0}, x, z);
  if (which == "top") set({-0.5, -0.5, 1.0}, x, y);
  if (which == "bottom") set({-0.5, 0.5, 0.0}, x, -y);
  return face;
}

Vector3d on_circle(int step, double radius, double z) {
  const double angle = 2.0 * std::numbers::pi * step / kAround;
  const auto [sine, cosine] = portable_sincos(angle);
  return {radius * cosine, radius * sine, z};
}

// Triangles between two rings of kAround points, of which either may be a single point.
void stitch(std::vector<std::array<std::uint32_t, 3>>& triangles, std::uint32_t lower,
            std::uint32_t upper) {
  for (std::uint32_t i = 0; i < kAround; ++i) {
    const std::uint32_t next = (i + 1) % kAround;
    triangles.push_back({lower + i, lower + next, upper + next});
    triangles.push_back({lower + i, upper + next, upper + i});
  }
}

}  // namespace

geometry::Polygon outline_of(const SceneFace& face) {
  std::vector<geometry::Ring> openings;
  for (const Eigen::AlignedBox2d& opening : face.openings) {
    openings.push_back(geometry::rectangle(opening.min(), opening.max()));
  }
  const std::vector<geometry::Ring> whole = {
      geometry::rectangle(Eigen::Vector2d::Zero(), {face.u.norm(), face.v.norm()})};
  return geometry::subtract(geometry::from_rings(whole, geometry::FillRule::kNonZero),
                            geometry::from_rings(openings, geometry::FillRule::kNonZero));
}

void Scene::add_face(const std::string& surface_name, const Rgb& color, const SceneFace& face) {
  const std::uint32_t surface =
      add_surface(surface_name, color, static_cast<std::int32_t>(faces.size()));
  faces.push_back(face);
  const std::vector<double> us = grid_lines(face.u.norm(), face.openings, 0);
  const std::vector<double> vs = grid_lines(face.v.norm(), face.openings, 1);
  const Vector3d u = face.u.normalized();
  const Vector3d v = face.v.normalized();
  const auto first = static_cast<std::uint32_t>(vertices.size());
  for (const double b : vs) {
    for (const double a : us) add_vertex(face.corner + a * u + b * v);
  }
  const auto columns = static_cast<std::uint32_t>(us.size());
  for (std::uint32_t j = 0; j + 1 < vs.size(); ++j) {
    for (std::uint32_t i = 0; i + 1 < us.size(); ++i) {
      const Eigen::Vector2d middle(0.5 * (us[i] + us[i + 1]), 0.5 * (vs[j] + vs[j + 1]));
      const auto is_air = [&](const Eigen::AlignedBox2d& o) { return o.contains(middle); };
      if (std::any_of(face.openings.begin(), face.openings.end(), is_air)) continue;
      const std::uint32_t k = first + j * columns + i;
      triangles.push_back({{k, k + 1, k + 1 + columns}, surface});
      triangles.push_back({{k, k + 1 + columns, k + columns}, surface});
    }
  }
}

void Scene::add_box(const std::string& box_name, const Rgb& color,
                    const Eigen::Isometry3d& T_world_box, const Vector3d& size,
                    std::span<const std::string> which) {
  for (const std::string& name_of_face : which) {
    SceneFace face = unit_box_face(name_of_face);
    face.corner = T_world_box * face.corner.cwiseProduct(size);
    face.u = T_world_box.linear() * face.u.cwiseProduct(size);
    face.v = T_world_box.linear() * face.v.cwiseProduct(size);
    add_face(box_name + "_" + name_of_face, color, face);
  }
}

void Scene::add_cylinder(const std::string& cylinder_name, const Rgb& color,
                         const Eigen::Isometry3d& T_world_cylinder, double radius,
                         double top_radius, double height, bool open) {
  std::vector<Vector3d> points;
  std::vector<std::array<std::uint32_t, 3>> indices;
  const std::array<std::array<double, 2>, 4> rings = {
      {{0.0, 0.0}, {radius, 0.0}, {top_radius, height}, {0.0, height}}};
  for (const auto& [r, z] : rings) {
    for (int i = 0; i < kAround; ++i) points.push_back(T_world_cylinder * on_circle(i, r, z));
  }
  for (std::uint32_t ring = 0; ring < (open ? 2U : 3U); ++ring) {
    stitch(indices, ring * kAround, (ring + 1) * kAround);
  }
  add_triangles(cylinder_name, color, points, indices);
}

void Scene::add_sphere(const std::string& sphere_name, const Rgb& color,
                       const Eigen::Isometry3d& T_world_sphere, double radius, double cut) {
  constexpr int kRings = kAround / 2;
  const double top = std::acos(std::clamp(-cut / radius, -1.0, 1.0));  // from the lower pole
  std::vector<Vector3d> points;
  std::vector<std::array<std::uint32_t, 3>> indices;
  for (int ring = 0; ring <= kRings; ++ring) {
    const auto [sine, cosine] = portable_sincos(top * ring / kRings);
    for (int i = 0; i < kAround; ++i) {
      points.push_back(T_world_sphere * on_circle(i, radius * sine, -radius * cosine));
    }
  }
  for (std::uint32_t ring = 0; ring < kRings; ++ring) {
    stitch(indices, ring * kAround, (ring + 1) * kAround);
  }
  add_triangles(sphere_name, color, points, indices);
}

void Scene::add_triangles(const std::string& surface_name, const Rgb& color,
                          std::span<const Vector3d> points,
                          std::span<const std::array<std::uint32_t, 3>> indices) {
  const std::uint32_t surface = add_surface(surface_name, color, -1);
  const auto first = static_cast<std::uint32_t>(vertices.size());
  for (const Vector3d& point : points) add_vertex(point);
  for (const auto& [a, b, c] : indices) {
    if (std::max({a, b, c}) >= points.size()) {
      throw std::invalid_argument(surface_name + ": a triangle names a vertex that is not there");
    }
    const Vector3d normal = (points[b] - points[a]).cross(points[c] - points[a]);
    if (normal.norm() < 1e-12) continue;  // at a pole, or of a careless mesh
    triangles.push_back({{first + a, first + b, first + c}, surface});
  }
}

std::uint32_t Scene::add_surface(const std::string& surface_name, const Rgb& color,
                                 std::int32_t face) {
  surfaces.push_back({surface_name, color, face});
  return static_cast<std::uint32_t>(surfaces.size() - 1);
}

std::uint32_t Scene::add_vertex(const Vector3d& point) {
  vertices.push_back(point);
  return static_cast<std::uint32_t>(vertices.size() - 1);
}

}  // namespace geomap::drivers
