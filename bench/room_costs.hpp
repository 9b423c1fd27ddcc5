// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "logs/pipeline.hpp"
#include "messaging/config.hpp"

namespace geomap::bench {

/// @brief A grid of equal rooms as scripts/make_rooms writes it: when the robot is in which.
struct RoomsWay {
  int side = 10;             // rooms of a row, and rows
  double room_seconds = 26;  // from one room's middle to the next one's

  int room_at(double seconds) const;  // counted from 0; a room begins in its doorway
  int row_of(int room) const { return room / side; }
  /// @brief Rooms at the ends of a row are left to the side, and those beside them see that through
  /// their doorway. All others are the same.
  bool is_comparable(int room) const;
};

/// @brief Means over the key frames of one room.
struct RoomCost {
  int room = 0;
  int keyframes = 0;
  double planes_extracted = 0.0;
  double blocks = 0.0;       // of the point map, visited
  double candidates = 0.0;   // features that planes were compared with
  double tracking = 0.0;     // processor time, decoding and reading included [ms]
  double planes_time = 0.0;  // extraction and merging, processor time [ms]
  double total = 0.0;        // both
  double merging = 0.0;      // of it, by the clock on the wall: median over the key frames [ms]

  int planes = 0;           // in the map when the robot left it
  double heap_bytes = 0.0;  // in use then
};

/// @brief What the memory at the end is held by.
struct MemoryShare {
  std::string holder;
  double bytes = 0.0;
};

struct RoomsRun {
  std::vector<RoomCost> rooms;  // in the order of the way
  std::vector<MemoryShare> memory;
  int keyframes = 0;
  int planes = 0;  // in the map at the end
};

/// @brief Drives the whole pipeline over a log. @throws std::runtime_error when it cannot be read.
RoomsRun run_rooms(const std::string& log, const RoomsWay& way, const messaging::Config& config);

/// @brief The comparable rooms of one row, each figure its median over them.
/// @return one for each row that has such rooms.
std::vector<RoomCost> medians_by_row(const RoomsRun& run, const RoomsWay& way);

}  // namespace geomap::bench
