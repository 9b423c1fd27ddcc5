// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>

#include "mapping/feature_store.hpp"
#include "mapping/map_feature.hpp"
#include "mapping/merge_config.hpp"

namespace geomap::mapping {

/// @brief Puts a newly observed feature into the map, merging it with what it belongs to.
/// In a merge the smallest id stays. What the operator holds is left alone.
class Merger {
 public:
  virtual ~Merger() = default;
  /// @return how many features of the map it was compared with.
  virtual std::int64_t insert(MapFeature feature, FeatureStore& store) const = 0;
  /// @brief One feature of two, whether they are alike or not.
  virtual MapFeature merge(const MapFeature& older, const MapFeature& younger) const = 0;
};

/// @brief The merger of `config.mode`. @throws std::invalid_argument when the configuration is not
/// valid.
std::unique_ptr<Merger> make_merger(const MergeConfig& config);

}  // namespace geomap::mapping
