// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "messaging/encode.hpp"
#include "messaging/log_event.hpp"

namespace lcm {
class LogFile;
}

namespace geomap::messaging {

/// @brief Writes an LCM log. The bytes are a function of what is written: no wall clock.
class LogWriter {
 public:
  /// @brief How to treat a file that exists.
  enum class Mode { kReplace, kAppend };

  /// @throws std::runtime_error, one line with the path, when the file cannot be written.
  explicit LogWriter(const std::string& path, Mode mode = Mode::kReplace);
  /// @brief Closes without a report; call close() to know that all is on disk.
  ~LogWriter();
  LogWriter(LogWriter&&) noexcept;
  LogWriter& operator=(LogWriter&&) noexcept;

  /// @brief Appends a message. @param utime time stamp of the event [us]: the message's own utime.
  /// @throws std::runtime_error when it cannot be written, for example on a full disk.
  template <class Message>
  void write(const std::string& channel, std::int64_t utime, const Message& message) {
    write_bytes(channel, utime, encode(message));
  }
  void write_bytes(const std::string& channel, std::int64_t utime,
                   std::span<const std::uint8_t> data);
  /// @brief Appends an event of another log, byte for byte: its number stays what it was there.
  void copy(const LogEvent& event);

  /// @brief Hands everything to the operating system, so that a crash of the program loses nothing.
  /// @throws std::runtime_error as above.
  void flush();
  /// @brief Returns when everything is on disk, so that a loss of power loses nothing.
  /// @throws std::runtime_error as above.
  void sync();
  /// @brief Flushes and closes. @throws std::runtime_error as above.
  void close();

 private:
  [[noreturn]] void fail() const;

  std::string path_;
  std::unique_ptr<lcm::LogFile> file_;
};

}  // namespace geomap::messaging
