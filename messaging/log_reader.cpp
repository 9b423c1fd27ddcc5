// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/log_reader.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "messaging/big_endian.hpp"

namespace geomap::messaging {
namespace {

constexpr std::int64_t kLongestChannel = 255;  // LCM itself sends 63
constexpr std::int64_t kLargestData = std::int64_t{1} << 30;

/// How far a number is behind another one; huge when it is before it.
std::uint64_t distance_of_numbers(std::int64_t number, std::int64_t later) {
  return static_cast<std::uint64_t>(later) - static_cast<std::uint64_t>(number);
}

/// Few events, even if they are damaged, can lie between numbers with this distance.
bool is_soon(std::uint64_t distance) { return distance >= 1 && distance <= 100; }

}  // namespace

/// A header whose event lies within the file, or one that the end of the file cuts short.
struct LogReader::Header {
  std::int64_t number = 0;
  std::int64_t log_utime = 0;
  std::int64_t channel_length = 0;
  std::int64_t data_length = 0;
  bool is_cut_short = false;

  std::int64_t event_size() const {
    return static_cast<std::int64_t>(kLogHeaderSize) + channel_length + data_length;
  }
};

LogReader::LogReader(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw std::runtime_error("'" + path + "' is a folder, not an LCM log");
  }
  file_.reset(std::fopen(path.c_str(), "rb"));
  if (!file_ || fseeko(file_.get(), 0, SEEK_END) != 0) {
    throw std::runtime_error("cannot read log '" + path + "': " + std::strerror(errno));
  }
  size_ = ftello(file_.get());
  file_position_ = size_;
  if (size_ == 0) throw std::runtime_error("log '" + path + "' is empty");
  if (!find_header()) throw std::runtime_error("'" + path + "' is not an LCM log");
}

std::optional<LogEvent> LogReader::next() {
  while (const std::optional<Header> header = find_header()) {
    std::optional<LogEvent> event = read_event(*header);
    if (!event) {  // the disk failed, or the file was cut while it was read
      damages_.push_back({position_, size_ - position_, true});
      position_ = size_;
      return std::nullopt;
    }
    const std::int64_t end = file_position_;
    if (const auto next_event = find_event_behind_damage(*event, end)) {
      damages_.push_back({position_, *next_event - position_, false});
      position_ = *next_event;
      continue;
    }
    position_ = end;
    return event;
  }
  return std::nullopt;
}

/// The next event, where this one's length is damaged. One that is too long covers events that the
/// log counts soon after it. One that is too short ends where none begins, and is followed, behind
/// the rest of its data, by the event that the log counts next; if that is another one, it is the
/// header behind this event that is damaged.
std::optional<std::int64_t> LogReader::find_event_behind_damage(const LogEvent& event,
                                                                std::int64_t end) {
  const std::optional<Header> follower = read_header(end);
  if (follower && distance_of_numbers(event.number, follower->number) == 1) return std::nullopt;
  const std::int64_t offset = find_sound_event(event.number, position_ + 1);
  if (offset == size_ || offset == end) return std::nullopt;
  const std::uint64_t distance = distance_of_numbers(event.number, read_header(offset)->number);
  const bool is_covered = offset < end && (is_soon(distance) || !ends_well(end));
  const bool is_next = offset > end && distance == 1;
  return is_covered || is_next ? std::optional(offset) : std::nullopt;
}

/// Where, at or behind `offset`, the next event begins that ends well, or that the log counts soon
/// after `number`; the end when there is none.
std::int64_t LogReader::find_sound_event(std::int64_t number, std::int64_t offset) {
  while (sound_event_ < offset) {
    sound_event_ = find_magic(offset);
    if (sound_event_ == size_ || is_sound(sound_event_, number)) break;
    offset = sound_event_ + 1;
  }
  return sound_event_;
}

bool LogReader::is_sound(std::int64_t offset, std::int64_t number) {
  const std::optional<Header> header = read_header(offset);
  if (!header || header->is_cut_short) return false;
  return is_soon(distance_of_numbers(number, header->number)) ||
         ends_well(offset + header->event_size());
}

/// True where the file ends or the next event begins.
bool LogReader::ends_well(std::int64_t offset) {
  std::array<std::uint8_t, kLogMagic.size()> bytes{};
  return offset == size_ ||
         (read_at(offset, bytes.data(), bytes.size()) == bytes.size() && bytes == kLogMagic);
}

/// Moves to the next sound header and notes what it passes over.
std::optional<LogReader::Header> LogReader::find_header() {
  const std::int64_t start = position_;
  bool starts_cut_short = false;
  std::optional<Header> header;
  while (position_ < size_) {
    header = read_header(position_);
    if (header && !header->is_cut_short) break;
    starts_cut_short = starts_cut_short || (header && position_ == start);
    header.reset();
    position_ = find_magic(position_ + 1);
  }
  if (position_ > start) {
    damages_.push_back({start, position_ - start, starts_cut_short && position_ == size_});
  }
  return header;
}

std::optional<LogReader::Header> LogReader::read_header(std::int64_t offset) {
  std::array<std::uint8_t, kLogHeaderSize> bytes{};
  const std::size_t count = read_at(offset, bytes.data(), bytes.size());
  const std::size_t compared = std::min(count, kLogMagic.size());
  if (!std::equal(kLogMagic.begin(), kLogMagic.begin() + static_cast<std::ptrdiff_t>(compared),
                  bytes.begin()))
    return std::nullopt;

  Header header;
  header.is_cut_short = true;
  if (count < bytes.size()) return header;
  header.number = static_cast<std::int64_t>(read_unsigned(bytes.data() + 4, 8));
  header.log_utime = static_cast<std::int64_t>(read_unsigned(bytes.data() + 12, 8));
  header.channel_length = static_cast<std::int64_t>(read_unsigned(bytes.data() + 20, 4));
  header.data_length = static_cast<std::int64_t>(read_unsigned(bytes.data() + 24, 4));
  if (header.channel_length == 0 || header.channel_length > kLongestChannel ||
      header.data_length > kLargestData) {
    return std::nullopt;
  }
  header.is_cut_short = offset + header.event_size() > size_;
  return header;
}

std::optional<LogEvent> LogReader::read_event(const Header& header) {
  LogEvent event;
  event.number = header.number;
  event.log_utime = header.log_utime;
  event.channel.resize(static_cast<std::size_t>(header.channel_length));
  event.data.resize(static_cast<std::size_t>(header.data_length));
  const std::int64_t channel_at = position_ + static_cast<std::int64_t>(kLogHeaderSize);
  const std::int64_t data_at = channel_at + header.channel_length;
  if (read_at(channel_at, event.channel.data(), event.channel.size()) != event.channel.size() ||
      read_at(data_at, event.data.data(), event.data.size()) != event.data.size()) {
    return std::nullopt;
  }
  return event;
}

/// Where the next magic word begins at or behind `offset`; the end when there is none.
std::int64_t LogReader::find_magic(std::int64_t offset) {
  std::array<std::uint8_t, 4096> buffer;
  while (offset < size_) {
    const std::size_t count = read_at(offset, buffer.data(), buffer.size());
    if (count < kLogMagic.size()) break;
    const auto end = buffer.begin() + static_cast<std::ptrdiff_t>(count);
    const auto found = std::search(buffer.begin(), end, kLogMagic.begin(), kLogMagic.end());
    if (found != end) return offset + (found - buffer.begin());
    offset += static_cast<std::int64_t>(count) - 3;  // a word may lie across two blocks
  }
  return size_;
}

std::size_t LogReader::read_at(std::int64_t offset, void* bytes, std::size_t size) {
  if (offset != file_position_ && fseeko(file_.get(), offset, SEEK_SET) != 0) return 0;
  const std::size_t count = size == 0 ? 0 : std::fread(bytes, 1, size, file_.get());
  file_position_ = offset + static_cast<std::int64_t>(count);
  return count;
}

}  // namespace geomap::messaging
