// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "mapping/feature_store.hpp"
#include "mapping/veto.hpp"

namespace geomap::mapping {

/// @brief What a fold over events has made. Its parts are shared, so a copy is cheap.
struct MapContents {
  FeatureSet features;
  VetoSet vetoes;
  /// Edits that do nothing as things are, most often since what they speak of is gone (orphans):
  /// number -> why, in words. They are kept and work again when it is back.
  std::map<std::int64_t, std::string> idle_edits;
};

/// @brief The same while it is being folded.
struct MapState {
  FeatureStore store;
  VetoSet vetoes;
  std::map<std::int64_t, std::string> idle_edits;

  MapState() = default;
  explicit MapState(const MapContents& contents)
      : store(contents.features), vetoes(contents.vetoes), idle_edits(contents.idle_edits) {}
  MapContents contents() const { return {store.features(), vetoes, idle_edits}; }
};

}  // namespace geomap::mapping
