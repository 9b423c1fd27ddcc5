// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "mapping/feature_store.hpp"
#include "mapping/view_feature.hpp"

namespace geomap::mapping {

/// @brief Why a view changed.
enum class ViewCause : std::int8_t {
  kObservation,
  kEdit,
  kKeyframeRemoval,
  kPoseCorrection,
  kUndo,
  kRedo,
  kLoad,
  kReset,
};
inline constexpr ViewCause kLastViewCause = ViewCause::kReset;

/// @brief What turns one revision of a view into the next one.
struct ViewDelta {
  std::int64_t utime = 0;  // id of the newest key frame in the map [us]
  std::int64_t epoch = 0;
  std::int64_t revision = 0;  // of the view afterwards; before, it is one less
  ViewCause cause = ViewCause::kObservation;
  std::vector<ViewFeature> changed;
  std::set<FeatureId> removed;
  std::map<FeatureId, FeatureId> absorbed;  // id -> survivor
  bool operator==(const ViewDelta&) const = default;
};

/// @brief What the operator sees of the map: what was sent to him, which differs from the map by no
/// more than a tolerance. Begins empty, at revision 0.
struct MapView {
  std::int64_t utime = 0;     // id of the newest key frame in the map [us]
  std::int64_t epoch = 0;     // new at each start of the mapper
  std::int64_t revision = 0;  // number of deltas of this epoch
  std::map<FeatureId, ViewFeature> features;
};

/// @brief What an operator who has `view` must be told after a change of the map to `features`. A
/// feature is compared with what was sent, so that small changes never add up.
ViewDelta delta_after(const MapView& view, const FeatureSet& features, const MapChange& change,
                      const ViewTolerance& tolerance);

/// @brief Takes a delta over. @throws std::invalid_argument when it is not the next one.
void apply(const ViewDelta& delta, MapView& view);

/// @brief SHA-256, in hexadecimal, of all features by id.
std::string view_hash(const MapView& view);

}  // namespace geomap::mapping
