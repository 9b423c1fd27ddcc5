// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map_feature.hpp"

namespace geomap::mapping {

std::string to_string(const FeatureId& id) {
  return std::to_string(id.keyframe) + "-" + std::to_string(id.plane);
}

}  // namespace geomap::mapping
