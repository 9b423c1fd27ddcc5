// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/log_writer.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <lcm/lcm-cpp.hpp>
#include <limits>
#include <stdexcept>

namespace geomap::messaging {

LogWriter::LogWriter(const std::string& path, Mode mode) : path_(path) {
  errno = 0;
  file_ = std::make_unique<lcm::LogFile>(path, mode == Mode::kAppend ? "a" : "w");
  if (!file_->good()) fail();
}

LogWriter::~LogWriter() = default;
LogWriter::LogWriter(LogWriter&&) noexcept = default;
LogWriter& LogWriter::operator=(LogWriter&&) noexcept = default;

void LogWriter::write_bytes(const std::string& channel, std::int64_t utime,
                            std::span<const std::uint8_t> data) {
  if (!file_) throw std::logic_error("LogWriter: written to after close()");
  if (data.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    throw std::runtime_error("log '" + path_ + "': a message on " + channel + " is too large");
  }
  lcm::LogEvent event{};
  event.timestamp = utime;
  event.channel = channel;
  event.datalen = static_cast<std::int32_t>(data.size());
  event.data =
      const_cast<std::uint8_t*>(data.data());  // LCM's interface lacks const; it only reads
  errno = 0;
  if (file_->writeEvent(&event) != 0) fail();
}

void LogWriter::copy(const LogEvent& event) {
  if (!file_) throw std::logic_error("LogWriter: written to after close()");
  std::FILE* file = file_->getFilePtr();
  const auto write = [&](const auto& bytes) {
    return std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  };
  errno = 0;
  if (!write(log_header(event)) || !write(event.channel) || !write(event.data)) fail();
}

void LogWriter::flush() {
  if (!file_) return;
  errno = 0;
  if (std::fflush(file_->getFilePtr()) != 0) fail();
}

void LogWriter::sync() {
  flush();
  if (!file_) return;
  errno = 0;
  if (fsync(fileno(file_->getFilePtr())) != 0) fail();
}

void LogWriter::close() {
  flush();
  file_.reset();
}

void LogWriter::fail() const {
  const std::string reason = errno == 0 ? "write error" : std::strerror(errno);
  throw std::runtime_error("cannot write log '" + path_ + "': " + reason);
}

}  // namespace geomap::messaging
