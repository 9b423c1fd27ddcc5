// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "geomap/keyframe_update_t.hpp"
#include "messaging/log_writer.hpp"
#include "perception/keyframe_messages.hpp"
#include "perception/tracker.hpp"

namespace geomap::perception {

/// @brief The key frames of geomap-register on disk, from which it goes on after a restart: an LCM
/// log, DIR/keyframes.lcmlog, of what it published, with thin frames (some 30 kB each).
class KeyframeJournal {
 public:
  /// @brief What was found at the start.
  struct Restored {
    std::size_t keyframes = 0;
    std::size_t refused = 0;  // records that could not be used, damaged ones included
  };

  /// @param folder made where it is missing. @throws std::runtime_error naming the file.
  explicit KeyframeJournal(const std::filesystem::path& folder);

  /// @brief Gives the key frames to a new tracker, and opens the journal for more.
  Restored restore(Tracker& tracker);

  /// @brief Appends a key frame that has entered the tracker's point map. After a return it
  /// survives the end of the process. @throws std::runtime_error as on a full disk.
  void keep(const TrackedFrame& frame, const Tracker& tracker);
  void keep(const geomap::keyframe_update_t& update);
  /// @brief Forgets all.
  void clear();

 private:
  std::filesystem::path file_;
  std::optional<messaging::LogWriter> writer_;
};

}  // namespace geomap::perception
