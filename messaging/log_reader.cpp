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

// An event is a magic word, number, time stamp, length of the channel name, length of the data
// (big-endian, 4, 8, 8, 4 and 4 bytes), the channel name and the data.
constexpr std::array<std::uint8_t, 4> kMagic = {0xED, 0xA1, 0xDA, 0x01};
constexpr std::size_t kHeaderSize = 28;
constexpr std::int64_t kLongestChannel = 255;  // LCM itself sends 63
constexpr std::int64_t kLargestData = std::int64_t{1} << 30;

}  // namespace

/// A header whose event lies within the file, or one that the end of the file cuts short.
struct LogReader::Header {
  std::int64_t number = 0;
  std::int64_t log_utime = 0;
  std::int64_t channel_length = 0;
  std::int64_t data_length = 0;
  bool is_cut_short = false;

  std::int64_t event_size() const {
    return static_cast<std::int64_t>(kHeaderSize) + channel_length + data_length;
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
    if (const auto swallowed = find_swallowed_event(*event, end)) {
      damages_.push_back({position_, *swallowed - position_, false});
      position_ = *swallowed;
      continue;
    }
    position_ = end;
    return event;
  }
  return std::nullopt;
}

/// A header whose length was damaged may claim the events behind it. What ends where nothing
/// begins, and holds a sound event, is such a one.
std::optional<std::int64_t> LogReader::find_swallowed_event(const LogEvent& event,
                                                            std::int64_t end) {
  if (ends_well(end)) return std::nullopt;
  const std::int64_t data_at = end - static_cast<std::int64_t>(event.data.size());
  for (auto at = event.data.begin();; ++at) {
    at = std::search(at, event.data.end(), kMagic.begin(), kMagic.end());
    if (at == event.data.end()) return std::nullopt;
    const std::int64_t offset = data_at + (at - event.data.begin());
    const std::optional<Header> header = read_header(offset);
    if (header && !header->is_cut_short && ends_well(offset + header->event_size())) return offset;
  }
}

/// True where the file ends or the next event begins.
bool LogReader::ends_well(std::int64_t offset) {
  std::array<std::uint8_t, kMagic.size()> bytes{};
  return offset == size_ ||
         (read_at(offset, bytes.data(), bytes.size()) == bytes.size() && bytes == kMagic);
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
  std::array<std::uint8_t, kHeaderSize> bytes{};
  const std::size_t count = read_at(offset, bytes.data(), bytes.size());
  const std::size_t compared = std::min(count, kMagic.size());
  if (!std::equal(kMagic.begin(), kMagic.begin() + static_cast<std::ptrdiff_t>(compared),
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
  const std::int64_t channel_at = position_ + static_cast<std::int64_t>(kHeaderSize);
  const std::int64_t data_at = channel_at + header.channel_length;
  if (read_at(channel_at, event.channel.data(), event.channel.size()) != event.channel.size() ||
      read_at(data_at, event.data.data(), event.data.size()) != event.data.size()) {
    return std::nullopt;
  }
  return event;
}

/// Where the next magic word begins at or behind `offset`; the end when there is none.
std::int64_t LogReader::find_magic(std::int64_t offset) {
  std::vector<std::uint8_t> buffer(1 << 16);
  while (offset < size_) {
    const std::size_t count = read_at(offset, buffer.data(), buffer.size());
    if (count < kMagic.size()) break;
    const auto end = buffer.begin() + static_cast<std::ptrdiff_t>(count);
    const auto found = std::search(buffer.begin(), end, kMagic.begin(), kMagic.end());
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
