// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/scene_file.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <sstream>

#include "drivers/portable_math.hpp"
#include "drivers/scene_mesh.hpp"
#include "drivers/yaml_map.hpp"
#include "geometry/angles.hpp"

namespace geomap::drivers {
namespace {

using Eigen::Vector3d;
using geometry::radians;

Rgb color_of(const YamlMap& shape) {
  Rgb color{200, 200, 200};
  if (!shape.has("color")) return color;
  const std::vector<double> values = shape.numbers("color", 3);
  for (std::size_t i = 0; i < 3; ++i) {
    if (values[i] < 0.0 || values[i] > 255.0) shape.fail("color", "goes from 0 to 255");
    color[i] = static_cast<std::uint8_t>(values[i]);
  }
  return color;
}

// T_world_shape: rolled about x, pitched about y, turned about z, then moved.
Eigen::Isometry3d pose_of(const YamlMap& shape) {
  Eigen::Isometry3d T_world_shape = Eigen::Isometry3d::Identity();
  const auto angle = [&](const char* key) { return radians(shape.number(key, 0.0)); };
  T_world_shape.linear() = turned_about_z(angle("yaw_deg")) * turned_about_y(angle("pitch_deg")) *
                           turned_about_x(angle("roll_deg"));
  T_world_shape.translation() = shape.vector("position");
  return T_world_shape;
}

void add_rectangle(Scene& scene, const YamlMap& shape) {
  shape.allow_only({"name", "color", "corner", "u", "v", "openings", "both_sides"});
  SceneFace face;
  face.corner = shape.vector("corner");
  face.u = shape.vector("u");
  face.v = shape.vector("v");
  face.both_sides = shape.boolean("both_sides", false);
  const double length_u = face.u.norm();
  const double length_v = face.v.norm();
  if (length_u < 1e-3 || length_v < 1e-3) shape.fail("u and v must be longer than 1 mm");
  if (std::abs(face.u.dot(face.v)) > 1e-9 * length_u * length_v) {
    shape.fail("u and v must be at right angles");
  }
  for (const YamlMap& opening : shape.maps("openings")) {
    opening.allow_only({"u", "v"});
    const std::vector<double> u = opening.numbers("u", 2);
    const std::vector<double> v = opening.numbers("v", 2);
    const bool inside = 0.0 <= u[0] && u[0] < u[1] && u[1] <= length_u && 0.0 <= v[0] &&
                        v[0] < v[1] && v[1] <= length_v;
    if (!inside) opening.fail("an opening goes FROM, TO along u and v, within the rectangle");
    face.openings.emplace_back(Eigen::Vector2d(u[0], v[0]), Eigen::Vector2d(u[1], v[1]));
  }
  if (outline_of(face).parts.size() != 1) {
    shape.fail("the openings leave several pieces: make each a rectangle of its own");
  }
  scene.add_face(shape.text("name"), color_of(shape), face);
}

void add_box(Scene& scene, const YamlMap& shape) {
  shape.allow_only(
      {"name", "color", "position", "yaw_deg", "pitch_deg", "roll_deg", "size", "faces"});
  const Vector3d size = shape.vector("size");
  if (size.minCoeff() <= 0.0) shape.fail("size", "must be above 0");
  std::vector<std::string> which(kBoxFaces.begin(), kBoxFaces.end());
  if (shape.has("faces")) {
    which.clear();
    std::istringstream words(shape.text("faces"));
    for (std::string word; words >> word;) {
      if (std::find(kBoxFaces.begin(), kBoxFaces.end(), word) == kBoxFaces.end()) {
        shape.fail("faces", "are of front, back, left, right, top and bottom, not '" + word + "'");
      }
      which.push_back(word);
    }
  }
  scene.add_box(shape.text("name"), color_of(shape), pose_of(shape), size, which);
}

void add_cylinder(Scene& scene, const YamlMap& shape) {
  shape.allow_only({"name", "color", "position", "yaw_deg", "pitch_deg", "roll_deg", "radius",
                    "top_radius", "height", "open"});
  const double radius = shape.positive("radius");
  scene.add_cylinder(shape.text("name"), color_of(shape), pose_of(shape), radius,
                     shape.positive("top_radius", radius), shape.positive("height"),
                     shape.boolean("open", false));
}

void add_sphere(Scene& scene, const YamlMap& shape) {
  shape.allow_only(
      {"name", "color", "position", "yaw_deg", "pitch_deg", "roll_deg", "radius", "cut"});
  const double radius = shape.positive("radius");
  const double cut = shape.number("cut", radius);
  if (cut <= -radius || cut > radius) shape.fail("cut", "lies between -radius and radius");
  scene.add_sphere(shape.text("name"), color_of(shape), pose_of(shape), radius, cut);
}

void add_mesh(Scene& scene, const YamlMap& shape, const std::filesystem::path& folder) {
  shape.allow_only(
      {"name", "color", "position", "yaw_deg", "pitch_deg", "roll_deg", "file", "scale"});
  Eigen::Affine3d T_world_mesh(pose_of(shape));
  T_world_mesh.scale(shape.positive("scale", 1.0));
  const Mesh mesh = read_mesh(folder / shape.text("file"));
  std::vector<Vector3d> points;
  for (const Vector3d& vertex : mesh.vertices) points.push_back(T_world_mesh * vertex);
  scene.add_triangles(shape.text("name"), color_of(shape), points, mesh.triangles);
}

// A truth file names planes after the shapes: two of one name could not be told apart.
void check_names(const Scene& scene, const YamlMap& root) {
  std::set<std::string> names;
  for (const SceneSurface& surface : scene.surfaces) {
    if (!names.insert(surface.name).second) {
      root.fail("the name '" + surface.name + "' is given twice");
    }
  }
}

}  // namespace

Scene read_scene(const std::filesystem::path& file) {
  const YamlMap root = YamlMap::load(file);
  root.allow_only({"name", "rectangles", "boxes", "cylinders", "spheres", "meshes"});
  Scene scene;
  scene.name = root.text("name");
  for (const YamlMap& shape : root.maps("rectangles")) add_rectangle(scene, shape);
  for (const YamlMap& shape : root.maps("boxes")) add_box(scene, shape);
  for (const YamlMap& shape : root.maps("cylinders")) add_cylinder(scene, shape);
  for (const YamlMap& shape : root.maps("spheres")) add_sphere(scene, shape);
  for (const YamlMap& shape : root.maps("meshes")) add_mesh(scene, shape, file.parent_path());
  if (scene.triangles.empty()) root.fail("the scene is empty");
  check_names(scene, root);
  return scene;
}

}  // namespace geomap::drivers
