// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/export_mesh.hpp"

#include <Eigen/Geometry>

#include "geometry/triangulate.hpp"

namespace geomap::mapping {
namespace {

FeatureMesh mesh_of(const MapFeature& feature, std::size_t index) {
  const geometry::Triangulation flat = geometry::triangulate(feature.surface.polygon);
  FeatureMesh mesh;
  mesh.id = feature.id;
  mesh.label = clean_text(feature.label);
  mesh.plane = feature.surface.plane;
  mesh.area = geometry::area(feature.surface.polygon);
  mesh.color = display_color(feature, index);
  mesh.vertices.reserve(flat.vertices.size());
  for (const geometry::GridPoint vertex : flat.vertices) {
    mesh.vertices.push_back(feature.surface.lift(vertex));
  }
  mesh.triangles = flat.triangles;
  return mesh;
}

}  // namespace

std::vector<FeatureMesh> feature_meshes(std::span<const MapFeature> features) {
  std::vector<FeatureMesh> meshes;
  meshes.reserve(features.size());
  for (const MapFeature* feature : sorted_by_id(features)) {
    meshes.push_back(mesh_of(*feature, meshes.size()));
  }
  return meshes;
}

Eigen::Vector3d whole_metre_centre(std::span<const FeatureMesh> meshes) {
  Eigen::AlignedBox3d box;
  for (const FeatureMesh& mesh : meshes) {
    for (const Eigen::Vector3d& vertex : mesh.vertices) box.extend(vertex);
  }
  if (box.isEmpty()) return Eigen::Vector3d::Zero();
  return box.center().array().round();
}

}  // namespace geomap::mapping
