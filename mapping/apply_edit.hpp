// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <string>

#include "mapping/edit.hpp"
#include "mapping/map_contents.hpp"
#include "mapping/merge_config.hpp"
#include "mapping/merger.hpp"

namespace geomap::mapping {

/// @brief The feature that holds most of these observations; of equals, the oldest. Nothing when
/// none holds any. @param observations ascending.
std::optional<FeatureId> holder_of(std::span<const ObservationId> observations,
                                   const FeatureSet& features);

/// @brief Does to a map what an edit says. Targets that are gone are left out.
///
/// Whatever the operator gives a shape or a place of his own is held there, to the last bit, and
/// the surface that it was observed on is closed to observations, or else they would draw it a
/// second time.
/// @param T_world_anchor where the edit's geometry hangs now.
/// @return why nothing was done, in words; empty when something was.
std::string apply_edit(const Edit& edit, const Eigen::Isometry3d& T_world_anchor,
                       const Merger& merger, const MergeConfig& config, MapState& state);

}  // namespace geomap::mapping
