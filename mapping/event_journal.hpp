// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mapping/geometric_map.hpp"
#include "messaging/log_writer.hpp"
#include "messaging/state_folder.hpp"

namespace geomap::mapping {

/// @brief How much a journal may hold.
struct JournalLimits {
  int events_per_state = 256;                // between two MAP_STATE: what a restart folds again
  std::int64_t most_spare_bytes = 16 << 20;  // beyond twice a map, until a new file is begun
};

/// @brief Keeps a map on disk while it changes: whatever add() returned for is there after a kill
/// or a loss of power. The folder holds one journal (load_journal) at a time; when it has become
/// much larger than the map needs, the next one is begun, with the map and the events that it can
/// be folded from.
///
/// What cannot be stored, as on a full disk, waits in memory and is tried again; nothing stored is
/// lost by it. The map itself goes on.
class EventJournal {
 public:
  /// @throws std::runtime_error when the folder cannot be used, or another process uses it.
  explicit EventJournal(const std::filesystem::path& folder, const JournalLimits& limits = {});

  /// @brief The map as it was last, or an empty one. To be called once, first.
  /// @throws std::runtime_error, one line with the path, when what is stored cannot be read.
  GeometricMap open(const MergeConfig& merge, const HistoryConfig& history);
  /// @brief What open() found and did, for people.
  const std::string& recovery() const { return recovery_; }

  /// @brief Stores an event that `map` has just accepted.
  void add(const MapEvent& event, const GeometricMap& map);
  /// @brief Stores a map that has taken the place of the former one.
  void replace(const GeometricMap& map);
  /// @brief Tries again to store what waits. Does nothing when all is stored.
  void retry(const GeometricMap& map);

  /// @brief Why something is not stored, in words; empty when all is.
  const std::string& trouble() const { return trouble_; }

  /// @brief File of a map that was saved by name. @throws std::invalid_argument for a name that is
  /// not plain, or that of a journal.
  std::filesystem::path file_of(const std::string& name) const;

 private:
  std::filesystem::path segment(std::int64_t number) const;
  void remove_others() const;
  void store(const GeometricMap& map);
  void append_waiting();
  void keep_state(const GeometricMap& map);
  void begin_segment(const GeometricMap& map);
  void drop_torn_record();

  messaging::StateFolder folder_;
  JournalLimits limits_;
  std::int64_t number_ = 0;       // of the journal; 0: there is none
  std::int64_t begin_bytes_ = 0;  // of it when it was begun
  std::int64_t bytes_ = 0;        // of it that are whole and on disk
  std::optional<std::int64_t> base_keyframe_;
  int events_since_state_ = 0;
  std::unique_ptr<messaging::LogWriter> writer_;
  std::vector<MapEvent> waiting_;
  bool is_replaced_ = false;  // the map on disk is a former one
  std::string recovery_, trouble_;
};

}  // namespace geomap::mapping
