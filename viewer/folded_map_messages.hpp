// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "mapping/geometric_map.hpp"
#include "mapping/logged_edits.hpp"

namespace geomap::viewer {

/// @brief The geometric map of a log that holds planes but no map: folded here, as geomap-mapper
/// would with its default settings. The log's edits have their places in it.
class FoldedMap {
 public:
  FoldedMap();

  /// @brief Takes PLANES, KEYFRAME_UPDATE, MAP_EDIT and MAP_EDIT_REPLY; what is not sound is left
  /// out. @return true when the map has changed.
  bool take(const std::string& channel, std::span<const std::uint8_t> data);
  /// @brief At the end of the log: does the edits that still wait for their places.
  bool finish();

  const mapping::GeometricMap& map() const { return map_; }

 private:
  bool apply(const mapping::MapEvent& event);
  bool take_planes(std::span<const std::uint8_t> data);
  bool take_update(std::span<const std::uint8_t> data);
  void take_edit(std::span<const std::uint8_t> data);
  bool take_reply(std::span<const std::uint8_t> data);
  bool do_placed_edits();

  mapping::GeometricMap map_;
  mapping::LoggedEdits edits_;
};

}  // namespace geomap::viewer
