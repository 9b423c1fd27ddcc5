// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <memory>

#include "mapping/map_feature.hpp"
#include "mapping/merge_config.hpp"

namespace geomap::mapping {

/// @brief Why a surface is closed to observations.
enum class VetoCause : std::int8_t {
  kDeleted,   // the operator has taken out what was there
  kObserved,  // what is observed there belongs to a feature that he holds
  kPlaced,    // a feature that he holds was put there
};
inline constexpr VetoCause kLastVetoCause = VetoCause::kPlaced;

/// @brief A region of a surface that no observation fills.
struct Veto {
  std::int64_t edit = 0;  // number of the edit that made it
  VetoCause cause = VetoCause::kDeleted;
  MapFeature feature;        // as it was
  geometry::Polygon region;  // its polygon, grown by the gap tolerance, in its frame
};

/// @brief What names a veto.
struct VetoKey {
  std::int64_t edit = 0;
  FeatureId feature;
  VetoCause cause = VetoCause::kDeleted;
  auto operator<=>(const VetoKey&) const = default;
};
using VetoSet = std::map<VetoKey, std::shared_ptr<const Veto>>;

/// @brief The feature's surface is closed to observations from now on.
void add_veto(std::int64_t edit, VetoCause cause, const MapFeature& feature,
              const MergeConfig& config, VetoSet& vetoes);

/// @brief Takes out of a newly observed feature what lies on a vetoed surface: within its region,
/// on its side, and no farther from it than merging could ever grant by the sensor's noise and the
/// poses. A surface before or behind it is left alone, and so is what lies beside it but for rims
/// too thin to be told from noise.
/// @return false when nothing is left.
bool cut_vetoed(MapFeature& feature, const VetoSet& vetoes, const MergeConfig& config);

}  // namespace geomap::mapping
