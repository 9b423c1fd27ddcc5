// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>

#include "mapping/view_feature.hpp"

namespace geomap::mapping {

/// @brief The features for people, a line each, numbered in the order of the ids as in pictures;
/// those that `is_wanted` lets through.
std::string feature_table(const std::map<FeatureId, ViewFeature>& features,
                          const std::function<bool(const ViewFeature&)>& is_wanted);

/// @brief The same as JSON: a list of {"number", "id", "label", "held", "area", "centroid",
/// "normal", "d", "observations", "rms"}.
std::string feature_json(const std::map<FeatureId, ViewFeature>& features,
                         const std::function<bool(const ViewFeature&)>& is_wanted);

}  // namespace geomap::mapping
