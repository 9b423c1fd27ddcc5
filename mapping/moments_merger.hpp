// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/clip_memo.hpp"
#include "mapping/merger.hpp"

namespace geomap::mapping {

/// @brief Merging by information: planes are refitted from added moments, not averaged (equation 7
/// of the paper lets a 200-pixel patch vote like a 200 000-pixel one), and because one new polygon
/// can bridge two old ones, merging goes on until nothing changes.
class MomentsMerger : public Merger {
 public:
  explicit MomentsMerger(const MergeConfig& config) : config_(config) {}
  std::int64_t insert(MapFeature feature, FeatureStore& store) const override;
  MapFeature merge(const MapFeature& older, const MapFeature& younger) const override;

 private:
  MergeConfig config_;
  mutable ClipMemo memo_;
};

}  // namespace geomap::mapping
