// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mapping/export_features.hpp"
#include "mapping/map_feature.hpp"

namespace geomap::mapping {

/// @brief One feature as triangles. World frame (z up), metres.
struct FeatureMesh {
  FeatureId id;
  std::string label;  // fit for a file, see clean_text
  geometry::Plane plane;
  double area = 0.0;  // of the polygon [m²]
  Rgb color{};
  std::vector<Eigen::Vector3d> vertices;                // on the plane
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise about the normal
};

/// @brief Constrained Delaunay triangles of every feature, by id; holes stay open. A feature
/// without area gives a mesh without triangles.
std::vector<FeatureMesh> feature_meshes(std::span<const MapFeature> features);

/// @brief Centre of the vertices' bounding box, rounded to whole metres: coordinates relative to it
/// are good to micrometres as 32-bit floats, and adding it back is exact. Zero without vertices.
Eigen::Vector3d whole_metre_centre(std::span<const FeatureMesh> meshes);

}  // namespace geomap::mapping
