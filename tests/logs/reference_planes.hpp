// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "geometry/plane.hpp"
#include "mapping/map_feature.hpp"

namespace geomap::testing {

/// @brief A large plane of a recording, known from fused depth. World frame of the recording.
struct ReferencePlane {
  std::string name;
  geometry::Plane plane;
  Eigen::Vector3d centroid;
};

std::vector<ReferencePlane> load_reference_planes(const std::filesystem::path& file);

struct ReferenceLimits {
  double angle_deg = 1.5;
  double distance = 0.025;  // at the reference's centroid [m]
};

/// @brief What of a map lies on a reference plane.
struct FeaturesOnReference {
  std::string name;
  /// Features of at least 0.05 m² at the reference's centroid (15 cm around it) within the limits:
  /// coplanar parts elsewhere are features of their own. One is right.
  std::vector<const mapping::MapFeature*> features;
  std::vector<double> angles_deg;
  std::vector<double> distances;  // [m]
  /// Others of at least 0.05 m², a fifth of which lies on the first: surfaces mapped twice.
  std::vector<std::string> stacked;
};

FeaturesOnReference features_on(const ReferencePlane& reference,
                                const std::vector<mapping::MapFeature>& map,
                                const ReferenceLimits& limits);

/// One line for each feature.
std::ostream& operator<<(std::ostream& out, const FeaturesOnReference& found);

}  // namespace geomap::testing
