// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "messaging/log_reader.hpp"
#include "viewer/scene_model.hpp"

namespace geomap::viewer {

/// @brief The time line of a log: seconds from its beginning, which never go back. Stamps that are
/// late, as those of several threads are, stand still; a jump of more than ten minutes is a gap
/// between two recordings, or damage, and is left out.
class LogTime {
 public:
  /// @brief Time of the next event of the log [s]. @param utime its stamp [us].
  double note(std::int64_t utime);

 private:
  std::optional<std::int64_t> newest_;
  double seconds_ = 0.0;
};

/// @brief What is in a log and how long it is, found out bit by bit.
class LogSurvey {
 public:
  /// @throws std::runtime_error as messaging::LogReader.
  explicit LogSurvey(const std::string& log) : reader_(log) {}

  /// @brief Reads on until a time. @return true when the whole log was read.
  bool read_until(Clock::time_point end);
  bool is_done() const { return is_done_; }
  double progress() const;  // 0 to 1

  double duration() const { return duration_; }  // of what was read so far [s]
  bool has(const std::string& channel) const { return channels_.contains(channel); }
  /// @brief The channel with the most events; empty before the first one.
  std::string commonest() const;

 private:
  messaging::LogReader reader_;
  LogTime time_;
  bool is_done_ = false;
  double duration_ = 0.0;
  std::map<std::string, std::int64_t> channels_;  // number of events
};

}  // namespace geomap::viewer
