// SPDX-License-Identifier: BSD-3-Clause
#include "logs/log_pass.hpp"

#include <stdexcept>

#include "messaging/program.hpp"
#include "messaging/progress_bar.hpp"

namespace geomap::logs {

void read_events(messaging::LogReader& reader,
                 const std::function<void(const messaging::LogEvent&)>& handle) {
  constexpr std::int64_t kMegabyte = 1'000'000;
  constexpr std::int64_t kLong = 200 * kMegabyte;  // shorter logs are read in a moment
  messaging::ProgressBar progress("MB", reader.size() / kMegabyte);
  while (const auto event = reader.next()) {
    handle(*event);
    if (reader.size() >= kLong) progress.update(reader.position() / kMegabyte);
    if (messaging::stop_requested()) throw std::runtime_error("stopped before the log's end");
  }
}

}  // namespace geomap::logs
