// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/log_survey_client.hpp"

#include <algorithm>
#include <cmath>

namespace geomap::viewer {
namespace {

constexpr double kLongestGap = 600.0;  // [s]
constexpr std::size_t kMostChannels = 10'000;

}  // namespace

double LogTime::note(std::int64_t utime) {
  if (!newest_) newest_ = utime;
  const double ahead = 1e-6 * (static_cast<double>(utime) - static_cast<double>(*newest_));
  const bool is_jump = std::abs(ahead) > kLongestGap;
  if (ahead > 0.0 && !is_jump) seconds_ += ahead;
  if (ahead > 0.0 || is_jump) newest_ = utime;
  return seconds_;
}

bool LogSurvey::read_until(Clock::time_point end) {
  while (!is_done_ && Clock::now() < end) {
    const auto event = reader_.next();
    is_done_ = !event.has_value();
    if (is_done_) break;
    duration_ = time_.note(event->log_utime);
    if (channels_.size() < kMostChannels || has(event->channel)) ++channels_[event->channel];
  }
  return is_done_;
}

std::string LogSurvey::commonest() const {
  const auto most =
      std::max_element(channels_.begin(), channels_.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == channels_.end() ? std::string() : most->first;
}

double LogSurvey::progress() const {
  if (is_done_) return 1.0;
  const auto size = static_cast<double>(std::max<std::int64_t>(1, reader_.size()));
  return std::min(0.999, static_cast<double>(reader_.position()) / size);
}

}  // namespace geomap::viewer
