// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "messaging/log_event.hpp"

namespace geomap::messaging {

/// @brief Bytes of a log that hold no readable event.
struct LogDamage {
  std::int64_t offset = 0;  // of the first such byte
  std::int64_t size = 0;    // [byte]
  bool at_end = false;      // the last event is cut short: a logger was killed, or a disk was full
};

/// @brief Reads an LCM log from front to back, in file order, whatever is in it: channels nobody
/// knows, time stamps that go backwards, a damaged stretch in the middle, a cut last event.
///
/// Not built upon LCM's own reader, which allocates whatever size a header claims, and at a damaged
/// header drops the sound event before it and all events behind it. Here reading resumes at the
/// next sound header.
class LogReader {
 public:
  /// @throws std::runtime_error, one line with the path, when the file is missing, unreadable,
  /// empty, or holds no LCM event at all.
  explicit LogReader(const std::string& path);

  /// @brief The next event; nothing at the end.
  std::optional<LogEvent> next();

  /// @brief Where reading stands, and the size of the file [byte].
  std::int64_t position() const { return position_; }
  std::int64_t size() const { return size_; }

  /// @brief What was passed over so far, in file order; complete after next() has returned nothing.
  const std::vector<LogDamage>& damages() const { return damages_; }
  /// @brief True when the end was reached and the last event was cut short.
  bool truncated() const { return !damages_.empty() && damages_.back().at_end; }

 private:
  struct Header;
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::optional<Header> read_header(std::int64_t offset);
  std::optional<Header> find_header();
  std::optional<std::int64_t> find_event_behind_damage(const LogEvent& event, std::int64_t end);
  std::int64_t find_sound_event(std::int64_t number, std::int64_t offset);
  bool is_sound(std::int64_t offset, std::int64_t number);
  bool ends_well(std::int64_t offset);
  std::int64_t find_magic(std::int64_t offset);
  std::size_t read_at(std::int64_t offset, void* bytes, std::size_t size);
  std::optional<LogEvent> read_event(const Header& header);

  std::unique_ptr<std::FILE, CloseFile> file_;
  std::int64_t file_position_ = 0;  // of file_, so that reading in order never seeks
  std::int64_t position_ = 0;
  std::int64_t sound_event_ = -1;  // what find_sound_event last found, so that it searches once
  std::int64_t size_ = 0;
  std::vector<LogDamage> damages_;
};

}  // namespace geomap::messaging
