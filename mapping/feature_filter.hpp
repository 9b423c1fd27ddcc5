// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>

#include "mapping/view_feature.hpp"

namespace geomap::mapping {

/// @brief What is said of a feature in a list. World frame, metres.
struct FeatureFacts {
  double area = 0.0;    // [m²]
  double height = 0.0;  // of the centroid above the world's origin
  double slope = 0.0;   // of the normal: 1 up, 0 level, -1 down
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
};
FeatureFacts facts_of(const ViewFeature& feature);

/// @brief Conditions for a feature, for example "area>0.5 and label=table": fields area, height,
/// slope, observations, rms, held (0 or 1) and label, with < <= > >= = and !=, joined by "and".
/// @throws std::invalid_argument that says what is wrong with the text.
std::function<bool(const ViewFeature&)> parse_filter(const std::string& text);

/// @brief The feature that a person names: its number in the order of the ids, from 1, with or
/// without "#"; its id; or the end of its id, where only one ends so.
/// @throws std::invalid_argument when there is none, or several.
FeatureId find_feature(const std::string& name, const std::map<FeatureId, ViewFeature>& features);

}  // namespace geomap::mapping
