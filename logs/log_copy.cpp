// SPDX-License-Identifier: BSD-3-Clause
#include "logs/log_copy.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <stdexcept>

#include "logs/channel_regex.hpp"
#include "logs/log_pass.hpp"
#include "logs/other_file.hpp"
#include "messaging/config.hpp"
#include "messaging/log_writer.hpp"
#include "messaging/part_file.hpp"

namespace geomap::logs {
namespace {

using messaging::ConfigError;
using messaging::LogEvent;

CopySummary copy_log(messaging::LogReader& reader, const std::string& log, const std::string& out,
                     const std::function<bool(const LogEvent&)>& wanted) {
  require_other_file(log, out);
  require_other_file(log, messaging::PartFile::part_of(out));
  messaging::PartFile part(out);
  messaging::LogWriter writer(part.name());
  CopySummary summary;
  read_events(reader, [&](const LogEvent& event) {
    if (!wanted(event)) {
      ++summary.left_out;
      return;
    }
    writer.copy(event);
    ++summary.events;
  });
  if (summary.events == 0) throw std::runtime_error("no event is left: nothing was written");
  for (const messaging::LogDamage& damage : reader.damages()) summary.lost_bytes += damage.size;
  summary.damages = reader.damages().size();
  writer.close();
  part.keep();
  return summary;
}

std::int64_t first_utime(const std::string& log) {
  const std::optional<LogEvent> event = messaging::LogReader(log).next();
  return event ? event->log_utime : 0;
}

/// One end of the range; `otherwise` when it is not given.
std::int64_t limit(const std::string& option, std::optional<double> seconds,
                   std::optional<std::int64_t> utime, std::int64_t start, std::int64_t otherwise) {
  if (seconds && utime) throw ConfigError(option + " and " + option + "-utime exclude each other");
  if (utime) return *utime;
  if (!seconds) return otherwise;
  // In floating point, exact until the year 2255: a damaged first time cannot overflow it.
  const double moment = static_cast<double>(start) + 1e6 * *seconds;
  if (!std::isfinite(moment)) throw ConfigError(option + " is no time");
  return std::llround(std::clamp(moment, -9e18, 9e18));
}

}  // namespace

CopySummary repair_log(const std::string& log, const std::string& out) {
  messaging::LogReader reader(log);
  return copy_log(reader, log, out, [](const LogEvent&) { return true; });
}

CopySummary cut_log(const std::string& log, const std::string& out, const LogCut& cut) {
  const std::regex channels = channel_regex("--channels", cut.channels);
  const std::regex not_channels = channel_regex("--not-channels", cut.not_channels);
  const std::int64_t start = first_utime(log);
  using Limits = std::numeric_limits<std::int64_t>;
  const std::int64_t from = limit("--from", cut.from, cut.from_utime, start, Limits::min());
  const std::int64_t to = limit("--to", cut.to, cut.to_utime, start, Limits::max());
  if (from >= to) throw ConfigError("the range ends before it begins");

  messaging::LogReader reader(log);
  return copy_log(reader, log, out, [&](const LogEvent& event) {
    return event.log_utime >= from && event.log_utime < to &&
           (cut.channels.empty() || std::regex_match(event.channel, channels)) &&
           (cut.not_channels.empty() || !std::regex_match(event.channel, not_channels));
  });
}

}  // namespace geomap::logs
