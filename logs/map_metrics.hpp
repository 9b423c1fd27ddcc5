// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "mapping/map_feature.hpp"

namespace geomap::logs {

/// @brief When two features of a map count as one surface mapped twice.
struct DuplicateRule {
  double min_area = 0.05;      // of each feature [m²]
  double max_angle_deg = 5.0;  // between their normals, either side
  double max_distance = 0.05;  // between the planes at the overlap's centroid [m]
  double min_share = 0.2;      // of the smaller feature's area that lies on the other one
};

/// @brief Area of `b` that lies on `a` [m²], where the two planes agree by the rule; otherwise 0.
double stacked_area(const mapping::MapFeature& a, const mapping::MapFeature& b,
                    const DuplicateRule& rule = {});

/// @brief Pairs of features (indices) that are one surface mapped twice: walls that became double.
/// A good map has none.
std::vector<std::pair<std::size_t, std::size_t>> find_duplicates(
    std::span<const mapping::MapFeature> features, const DuplicateRule& rule = {});

}  // namespace geomap::logs
