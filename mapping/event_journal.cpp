// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/event_journal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "mapping/map_hash.hpp"
#include "mapping/map_journal.hpp"
#include "mapping/map_messages.hpp"
#include "messaging/channels.hpp"

namespace geomap::mapping {
namespace {

namespace fs = std::filesystem;
namespace channels = messaging::channels;

constexpr std::string_view kPrefix = "journal-";
constexpr std::string_view kSuffix = ".lcmlog";

// Of "journal-000012.lcmlog".
std::optional<std::int64_t> number_of(const std::string& name) {
  if (!name.starts_with(kPrefix) || !name.ends_with(kSuffix)) return std::nullopt;
  std::int64_t number = 0;
  const char* end = name.data() + name.size() - kSuffix.size();
  const auto [stop, error] = std::from_chars(name.data() + kPrefix.size(), end, number);
  if (error != std::errc() || stop != end || number < 1) return std::nullopt;
  return number;
}

std::int64_t size_of(const fs::path& path) {
  return static_cast<std::int64_t>(fs::file_size(path));
}

}  // namespace

EventJournal::EventJournal(const fs::path& folder, const JournalLimits& limits)
    : folder_(folder), limits_(limits) {}

GeometricMap EventJournal::open(const MergeConfig& merge, const HistoryConfig& history) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_.path())) {
    number_ = std::max(number_, number_of(entry.path().filename().string()).value_or(0));
  }
  if (number_ == 0) {
    GeometricMap map(merge, history);
    recovery_ = "no map in " + folder_.path().string() + " yet";
    replace(map);
    return map;
  }
  LoadedJournal journal = load_journal(segment(number_));
  begin_bytes_ = journal.begin;
  bytes_ = journal.end;
  base_keyframe_ = journal.saved.base_keyframe;
  events_since_state_ = static_cast<int>(journal.later.size());
  drop_torn_record();
  remove_others();

  recovery_ = fmt::format("{}: {} events and {} later ones", segment(number_).string(),
                          journal.saved.events.size(), journal.later.size());
  if (journal.torn > 0) {
    recovery_ += fmt::format("; the last record was torn, {} bytes dropped", journal.torn);
  }
  if (journal.damaged > 0) {
    recovery_ +=
        fmt::format("; {} bytes in the middle are damaged and passed over", journal.damaged);
  }
  const bool is_folded_anew = !is_same_merging(journal.saved.merge, merge);
  GeometricMap map = reopen(std::move(journal.saved), merge, history);
  for (const MapEvent& event : journal.later) map.apply(event);
  if (is_folded_anew) {
    recovery_ += "; folded anew, because the settings of merging differ";
    replace(map);
  }
  recovery_ +=
      fmt::format("; the map has {} features of {} key frames, map_hash {}", map.features().size(),
                  map.history().keyframes().size(), map_hash(map.features(), map.vetoes()));
  return map;
}

void EventJournal::add(const MapEvent& event, const GeometricMap& map) {
  waiting_.push_back(event);
  store(map);
}

void EventJournal::replace(const GeometricMap& map) {
  is_replaced_ = true;
  store(map);
}

void EventJournal::retry(const GeometricMap& map) {
  if (!trouble_.empty()) store(map);
}

fs::path EventJournal::file_of(const std::string& name) const {
  if (!messaging::is_plain_name(name) || name.starts_with(kPrefix) || name == "lock") {
    throw std::invalid_argument("'" + name + "' is no name for a map");
  }
  return folder_.file(name + std::string(kSuffix));
}

fs::path EventJournal::segment(std::int64_t number) const {
  return folder_.file(fmt::format("{}{:06}{}", kPrefix, number, kSuffix));
}

// Former journals, and what a kill has left of one that was being begun.
void EventJournal::remove_others() const {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_.path())) {
    const std::string name = entry.path().filename().string();
    const auto number = number_of(name);
    if ((number && *number != number_) || name.ends_with(".part")) {
      fs::remove(entry.path(), ignored);
    }
  }
}

void EventJournal::store(const GeometricMap& map) {
  try {
    if (is_replaced_ || !fs::exists(segment(number_))) {
      begin_segment(map);
    } else {
      append_waiting();
      if (events_since_state_ >= limits_.events_per_state) keep_state(map);
    }
    trouble_.clear();
  } catch (const std::runtime_error& error) {
    drop_torn_record();
    trouble_ = fmt::format("the map goes on, but is not stored: {}", error.what());
  }
}

void EventJournal::append_waiting() {
  if (!writer_) {
    writer_ = std::make_unique<messaging::LogWriter>(segment(number_).string(),
                                                     messaging::LogWriter::Mode::kAppend);
  }
  for (const MapEvent& event : waiting_) {
    const geomap::map_event_t message = to_message(event);
    writer_->write(channels::kMapEvent, message.utime, message);
  }
  writer_->sync();
  bytes_ = size_of(segment(number_));
  events_since_state_ += static_cast<int>(waiting_.size());
  waiting_.clear();
}

// A restart need not fold what is behind this; the file must not grow for ever.
void EventJournal::keep_state(const GeometricMap& map) {
  const SavedMap saved = map.saved();
  if (saved.base_keyframe != base_keyframe_ ||
      bytes_ > 2 * begin_bytes_ + limits_.most_spare_bytes) {
    begin_segment(map);
    return;
  }
  const geomap::map_state_t state = state_of(saved);
  writer_->write(channels::kMapState, state.utime, state);
  writer_->sync();
  bytes_ = size_of(segment(number_));
  events_since_state_ = 0;
}

void EventJournal::begin_segment(const GeometricMap& map) {
  save_map(segment(number_ + 1), map);
  ++number_;
  writer_.reset();
  bytes_ = begin_bytes_ = size_of(segment(number_));
  base_keyframe_ = map.history().forgotten_through();
  events_since_state_ = 0;
  waiting_.clear();
  folder_.sync();
  is_replaced_ = false;
  remove_others();
}

// What is behind the last whole record would make the next one unreadable.
void EventJournal::drop_torn_record() {
  writer_.reset();
  std::error_code error;
  const std::uintmax_t size = fs::file_size(segment(number_), error);
  const auto whole = static_cast<std::uintmax_t>(bytes_);
  if (!error && size > whole) fs::resize_file(segment(number_), whole, error);
}

}  // namespace geomap::mapping
