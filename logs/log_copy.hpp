// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace geomap::logs {

/// @brief Which part of a log to keep.
struct LogCut {
  std::optional<double> from;  // since the log's first event [s]; included
  std::optional<double> to;    // likewise; excluded, so that successive cuts share nothing
  std::optional<std::int64_t> from_utime;  // log's time [us]; included
  std::optional<std::int64_t> to_utime;    // log's time [us]; excluded
  std::string channels;                    // regular expression for a whole name; empty: all
  std::string not_channels;                // likewise; empty: none
};

/// @brief What was copied.
struct CopySummary {
  std::size_t events = 0;       // copied
  std::size_t left_out = 0;     // readable, but not asked for
  std::size_t damages = 0;      // places without a readable event
  std::int64_t lost_bytes = 0;  // in these places
};

/// @brief Copies every readable event, byte for byte. `out` is replaced when the new log is whole,
/// and untouched otherwise.
/// @throws messaging::ConfigError when `out` is the same file; std::runtime_error, one line, when
/// `log` is no log, `out` cannot be written, or on Ctrl-C.
CopySummary repair_log(const std::string& log, const std::string& out);

/// @brief Copies the readable events of a time range and of some channels, likewise.
/// @throws messaging::ConfigError, too, for a bad regular expression, an end given both ways, or a
/// range that ends before it begins; std::runtime_error, too, when no event is left.
CopySummary cut_log(const std::string& log, const std::string& out, const LogCut& cut);

}  // namespace geomap::logs
