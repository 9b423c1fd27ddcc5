// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <iosfwd>
#include <string>

namespace geomap::messaging {

/// @brief How far a program is, on stderr, with rate and remaining time. A terminal gets one line
/// that is rewritten a few times a second, a pipe or file gets a line every 10 %.
class ProgressBar {
 public:
  /// @param what is counted, for example "frames". @param total of it; 0 when not known.
  ProgressBar(std::string what, std::int64_t total);
  /// @brief The same onto any stream; `is_terminal` chooses the form.
  ProgressBar(std::string what, std::int64_t total, std::ostream& out, bool is_terminal);
  /// @brief Ends the line of a terminal.
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// @param done so far, of total.
  void update(std::int64_t done);
  /// @brief The same where the total is only an estimate that changes on the way.
  void update(std::int64_t done, std::int64_t estimated_total);

 private:
  bool is_due(std::int64_t done);
  void draw(std::int64_t done);

  std::string what_;
  std::int64_t total_;
  std::ostream& out_;
  bool is_terminal_;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point last_drawn_;
  std::int64_t last_step_ = 0;  // tenths already reported to a pipe
  std::int64_t last_drawn_done_ = -1;
};

}  // namespace geomap::messaging
