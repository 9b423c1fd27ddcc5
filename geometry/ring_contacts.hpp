// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geometry/polygon.hpp"

namespace geomap::geometry {

/// @brief How rings meet, decided exactly. The search ends at the first breach.
struct RingContacts {
  std::optional<std::size_t> not_simple;                        // this ring meets itself
  std::optional<std::pair<std::size_t, std::size_t>> crossing;  // cross, or share a stretch
  bool touching = false;                                        // two rings share a point

  bool none() const { return !not_simple && !crossing && !touching; }
};

RingContacts find_contacts(std::span<const Ring* const> rings);

enum class Side { kInside, kBorder, kOutside };

/// @brief Where a point lies against a simple ring of any orientation.
Side locate(GridPoint point, const Ring& ring);

/// @brief True when `inner` lies inside `outer`. Both are simple, of any orientation, and do not
/// cross; they may touch in points.
bool lies_inside(const Ring& inner, const Ring& outer);

/// @brief The ring without vertices on the straight line between their neighbours (and without
/// spikes, whose tip is such a vertex); empty when nothing is left.
Ring without_collinear(const Ring& ring);

/// @brief All rings of a polygon: of each part the outer ring, then its holes.
std::vector<const Ring*> rings_of(const Polygon& polygon);

}  // namespace geomap::geometry
