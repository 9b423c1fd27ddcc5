// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "geomap/map_edit_record_t.hpp"
#include "viewer/map_source.hpp"
#include "viewer/taken.hpp"

namespace geomap::viewer {

/// @brief One edit of a history as people see it.
HistoryEntry entry_of(const geomap::map_edit_record_t& record);

/// @brief The mapper's history of edits, put together from its records, in whatever order they
/// come.
///
/// All records of an instant are shown at once, by show(): a history of thousands comes in a burst.
/// A mapper that was started anew has another history: the former one stays until that is whole.
class EditRecords {
 public:
  Taken take(const geomap::map_edit_record_t& record, Clock::time_point now);
  /// @brief Brings history() and vetoes() up to date. @return true when they have changed.
  bool show();

  /// @brief All edits, ascending by number.
  const std::vector<HistoryEntry>& history() const { return history_; }
  /// @brief The surfaces that edits in force keep closed, by edit.
  const std::vector<mapping::Veto>& vetoes() const { return vetoes_; }

  /// @brief True when nothing is known to be missing of the history of a mapper.
  bool is_whole(std::int64_t epoch) const;

 private:
  struct Record {
    HistoryEntry entry;
    std::vector<mapping::Veto> vetoes;
  };
  struct Collection {
    std::int64_t epoch = 0;
    std::size_t count = 0;  // of records that there are
    std::map<std::int64_t, Record> records;
  };

  static std::optional<Record> read(const geomap::map_edit_record_t& message);
  Collection& collection_for(const geomap::map_edit_record_t& message);

  std::optional<Collection> shown_, coming_;
  Clock::time_point heard_;
  bool has_news_ = false;  // that show() has not shown yet
  std::vector<HistoryEntry> history_;
  std::vector<mapping::Veto> vetoes_;
};

}  // namespace geomap::viewer
