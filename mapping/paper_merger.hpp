// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/merger.hpp"

namespace geomap::mapping {

/// @brief Merging as the paper prints it (Arbeiter et al. 2012, equations 4-12), for comparison.
/// Mended only where it cannot work: |d1 - d2| in (6b); normal and d turned together when the
/// normals oppose; the averaged normal of (7) normalised together with d; the plane frame of
/// geometry/plane_frame.hpp in place of (8)-(10), which divide by n_x + n_y + n_z and print t with
/// a wrong sign. Kept as printed: distances compared at the world's origin, coefficients averaged
/// by merge count, any intersection suffices, candidates fixed once.
class PaperMerger : public Merger {
 public:
  explicit PaperMerger(const MergeConfig& config) : config_(config) {}
  std::int64_t insert(MapFeature feature, FeatureStore& store) const override;
  MapFeature merge(const MapFeature& older, const MapFeature& younger) const override;

 private:
  MergeConfig config_;
};

}  // namespace geomap::mapping
