// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "logs/synthetic_log.hpp"
#include "messaging/log_reader.hpp"
#include "messaging/temporary_folder.hpp"
#include "support/program_run.hpp"

namespace geomap::logs {

/// @brief geomap-log, and a log to use it on.
class LogTool : public testing::TemporaryFolder {
 protected:
  static testing::ProgramRun run(const std::string& arguments) {
    return testing::run_program(GEOMAP_LOG_PROGRAM " " + arguments);
  }
  testing::ProgramRun run_on(const std::string& command, const std::string& name) const {
    return run(command + " " + path(name));
  }

  std::string write_log(const std::string& name,
                        const std::vector<messaging::LogEvent>& events) const {
    testing::write_log(path(name), events);
    return path(name);
  }

  static std::vector<messaging::LogEvent> read_log(const std::string& file) {
    std::vector<messaging::LogEvent> events;
    messaging::LogReader reader(file);
    while (auto event = reader.next()) events.push_back(*std::move(event));
    return events;
  }

  /// Frames, poses and mounts of a camera, and what LCM sends to itself.
  static std::vector<messaging::LogEvent> some_events() {
    static const std::vector<messaging::LogEvent> kEvents = [] {
      std::vector<messaging::LogEvent> events = testing::synthetic_log(60);
      events.insert(events.begin(),
                    {0, events[0].log_utime, "LCM_SELF_TEST", {'t', 'e', 's', 't'}});
      return events;
    }();
    return kEvents;
  }

  static std::string bytes_of(const messaging::LogEvent& event) {
    const auto header = messaging::log_header(event);
    std::string bytes(header.begin(), header.end());
    bytes += event.channel;
    bytes.append(event.data.begin(), event.data.end());
    return bytes;
  }

  /// Where each event of the file begins.
  static std::vector<std::size_t> offsets_in(const std::vector<messaging::LogEvent>& events) {
    std::vector<std::size_t> offsets;
    std::size_t offset = 0;
    for (const messaging::LogEvent& event : events) {
      offsets.push_back(offset);
      offset += static_cast<std::size_t>(messaging::size_in_log(event));
    }
    return offsets;
  }
};

}  // namespace geomap::logs
