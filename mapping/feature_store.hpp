// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <set>
#include <vector>

#include "mapping/feature_index.hpp"
#include "mapping/map_feature.hpp"

namespace geomap::mapping {

/// @brief Features by id. Features are immutable and shared, so a copy of a map costs one pointer
/// per feature.
using FeatureSet = std::map<FeatureId, std::shared_ptr<const MapFeature>>;

/// @brief What one or more events did to the set of features.
struct MapChange {
  std::set<FeatureId> upserted;             // new or changed
  std::set<FeatureId> removed;              // gone without a successor
  std::map<FeatureId, FeatureId> absorbed;  // gone into another feature: id -> survivor
  bool operator==(const MapChange&) const = default;
};

/// @brief What turns one set into the other. A feature that is missing afterwards was absorbed by
/// the one that holds its first observation, or else removed.
MapChange difference(const FeatureSet& before, const FeatureSet& after);

/// @brief A set of features with its spatial index, which notes what was touched. A copy has not
/// been touched.
class FeatureStore {
 public:
  FeatureStore() = default;
  explicit FeatureStore(FeatureSet features);
  FeatureStore(const FeatureStore& other) : FeatureStore(other.features_) {}
  FeatureStore& operator=(const FeatureStore& other) { return *this = FeatureStore(other); }
  FeatureStore(FeatureStore&&) noexcept = default;
  FeatureStore& operator=(FeatureStore&&) noexcept = default;
  ~FeatureStore() = default;

  const FeatureSet& features() const { return features_; }
  const MapFeature& at(const FeatureId& id) const { return *features_.at(id); }

  /// @brief Adds a feature or replaces the one with its id.
  void put(MapFeature feature);
  void erase(const FeatureId& id);

  /// @brief Ids of features whose bounding boxes come within `reach` [m] of the surface's,
  /// ascending.
  std::vector<FeatureId> near(const geometry::PlanarPolygon& surface, double reach) const;

  /// @brief What changed since the last call; costs what was touched, not what the set holds.
  MapChange take_change();

 private:
  void note(const FeatureId& id);

  FeatureSet features_;
  FeatureIndex index_;
  FeatureSet touched_;  // as they were before; null: was not there
};

}  // namespace geomap::mapping
