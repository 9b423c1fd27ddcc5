// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/map_snapshot.hpp"
#include "viewer/scene_model.hpp"

namespace geomap::viewer {

/// @brief The operator's view as a map for exports: surfaces, labels, what is held, colours and
/// deviations. What the view does not tell is missing, see MapSource::snapshot().
mapping::MapSnapshot snapshot_of(const MapLayer& layer);

}  // namespace geomap::viewer
