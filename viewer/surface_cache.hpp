// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>

#include "viewer/scene_model.hpp"

namespace geomap::viewer {

/// @brief A feature in metres, as often as it is needed.
struct Surface {
  geometry::PlanarPolygon polygon;  // world frame
  Eigen::AlignedBox3d box;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  double area = 0.0;  // [m²]
  int number = 0;     // in the order of the ids, from 1, as geomap-edit counts
};

/// @brief The features of the map in metres; only what has changed is worked out again.
class SurfaceCache {
 public:
  void update(const MapLayer& map);
  const std::map<mapping::FeatureId, Surface>& surfaces() const { return surfaces_; }
  /// @brief Null when there is no such feature.
  const Surface* find(const mapping::FeatureId& id) const;

 private:
  Stamp stamp_ = 0;
  Features features_;
  std::map<mapping::FeatureId, Surface> surfaces_;
};

}  // namespace geomap::viewer
