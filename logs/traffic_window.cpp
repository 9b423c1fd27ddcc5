// SPDX-License-Identifier: BSD-3-Clause
#include "logs/traffic_window.hpp"

#include <algorithm>

#include "logs/message_head.hpp"

namespace geomap::logs {

TrafficWindow::TrafficWindow(double seconds)
    : step_length_(std::max<std::int64_t>(1, static_cast<std::int64_t>(1e6 * seconds / kSteps))) {}

void TrafficWindow::add(std::int64_t utime, std::size_t bytes, std::optional<double> latency) {
  if (!first_utime_) first_utime_ = utime;
  const std::int64_t number = utime / step_length_;
  Step& step = steps_[static_cast<std::size_t>(number) % steps_.size()];
  if (step.number != number) step = {.number = number};
  ++step.messages;
  step.bytes += static_cast<double>(bytes);
  if (!latency) return;
  ++step.with_latency;
  step.latency_sum += *latency;
  step.latency_max = std::max(step.latency_max, *latency);
}

TrafficRates TrafficWindow::rates(std::int64_t utime) const {
  const std::int64_t newest = utime / step_length_;
  const std::int64_t oldest = newest - kSteps;
  Step sum;
  for (const Step& step : steps_) {
    if (step.messages == 0 || step.number < oldest || step.number > newest) continue;
    sum.messages += step.messages;
    sum.bytes += step.bytes;
    sum.with_latency += step.with_latency;
    sum.latency_sum += step.latency_sum;
    sum.latency_max = std::max(sum.latency_max, step.latency_max);
  }
  TrafficRates rates;
  if (sum.with_latency > 0) {
    rates.mean_latency = sum.latency_sum / static_cast<double>(sum.with_latency);
    rates.longest_latency = sum.latency_max;
  }
  const bool holds_first = first_utime_ && *first_utime_ >= oldest * step_length_;
  if (sum.messages < (holds_first ? 2 : 1)) return rates;
  // Where time counts from the first message on, that one only begins it; on average half an
  // interval has passed since the newest.
  const double intervals = static_cast<double>(sum.messages) - (holds_first ? 0.5 : 0.0);
  const double seconds =
      seconds_between(holds_first ? *first_utime_ : oldest * step_length_, utime);
  rates.hertz = seconds > 0.0 ? intervals / seconds : 0.0;
  rates.bandwidth = rates.hertz * sum.bytes / static_cast<double>(sum.messages);
  return rates;
}

}  // namespace geomap::logs
