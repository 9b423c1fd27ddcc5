// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/progress_bar.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <utility>

namespace geomap::messaging {
namespace {

constexpr int kBarWidth = 30;
constexpr std::chrono::milliseconds kRedrawInterval{200};
/// Without a total a pipe gets a line every so often.
constexpr std::chrono::seconds kLineInterval{10};

/// "1:02:03" or "02:03".
std::string to_clock(double seconds) {
  const auto whole = static_cast<long long>(std::llround(seconds));
  char text[32];
  if (whole >= 3600) {
    std::snprintf(text, sizeof text, "%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60,
                  whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%02lld:%02lld", whole / 60, whole % 60);
  }
  return text;
}

}  // namespace

ProgressBar::ProgressBar(std::string what, std::int64_t total)
    : ProgressBar(std::move(what), total, std::cerr, isatty(STDERR_FILENO) == 1) {}

ProgressBar::ProgressBar(std::string what, std::int64_t total, std::ostream& out, bool is_terminal)
    : what_(std::move(what)),
      total_(std::max<std::int64_t>(total, 0)),
      out_(out),
      is_terminal_(is_terminal),
      start_(std::chrono::steady_clock::now()),
      last_drawn_(start_) {}

ProgressBar::~ProgressBar() {
  if (is_terminal_ && last_drawn_done_ >= 0) out_ << std::endl;
}

void ProgressBar::update(std::int64_t done) {
  if (is_due(done)) draw(done);
}

void ProgressBar::update(std::int64_t done, std::int64_t estimated_total) {
  total_ = std::max<std::int64_t>(estimated_total, 0);
  update(done);
}

bool ProgressBar::is_due(std::int64_t done) {
  const auto waited = std::chrono::steady_clock::now() - last_drawn_;
  const bool finished = total_ > 0 && done >= total_ && last_drawn_done_ < total_;
  if (is_terminal_) return finished || last_drawn_done_ < 0 || waited >= kRedrawInterval;
  if (total_ == 0) return waited >= kLineInterval;
  const auto step =
      static_cast<std::int64_t>(10.0 * static_cast<double>(done) / static_cast<double>(total_));
  if (step <= last_step_) return false;
  last_step_ = step;
  return true;
}

void ProgressBar::draw(std::int64_t done) {
  const auto now = std::chrono::steady_clock::now();
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double rate = seconds > 0.0 ? static_cast<double>(done) / seconds : 0.0;
  char text[160];
  if (total_ > 0) {
    const double part =
        std::clamp(static_cast<double>(done) / static_cast<double>(total_), 0.0, 1.0);
    const double left =
        rate > 0.0 ? static_cast<double>(std::max<std::int64_t>(total_ - done, 0)) / rate : 0.0;
    const auto filled = static_cast<std::size_t>(part * kBarWidth);
    const std::string bar = std::string(filled, '=') + std::string(kBarWidth - filled, ' ');
    std::snprintf(text, sizeof text, "%3.0f %% [%s] %lld/%lld, %.1f/s, %s left", 100.0 * part,
                  bar.c_str(), static_cast<long long>(done), static_cast<long long>(total_), rate,
                  to_clock(left).c_str());
  } else {
    std::snprintf(text, sizeof text, "%lld, %.1f/s, %s", static_cast<long long>(done), rate,
                  to_clock(seconds).c_str());
  }
  // Escape sequence: clear to the end of the line, where a longer text may still stand.
  out_ << (is_terminal_ ? "\r" : "") << what_ << ": " << text << (is_terminal_ ? "\x1b[K" : "\n")
       << std::flush;
  last_drawn_ = now;
  last_drawn_done_ = done;
}

}  // namespace geomap::messaging
