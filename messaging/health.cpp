// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/health.hpp"

#include <fmt/format.h>

#include <utility>

#include "messaging/program.hpp"

namespace geomap::messaging {
namespace {

constexpr double kMost = 0.95;  // of the runs take no longer than what is reported

}  // namespace

Health::Health(std::string process, std::string config_hash, std::int64_t started)
    : process_(std::move(process)), config_hash_(std::move(config_hash)), started_(started) {}

void Health::set(const std::string& name, std::int64_t value) {
  if (value > 0 || counters_.contains(name)) counters_[name] = value;
}

std::int64_t Health::value(const std::string& name) const {
  const auto found = counters_.find(name);
  return found == counters_.end() ? 0 : found->second;
}

void Health::time(const std::string& stage, double seconds) {
  Stage& latencies = stages_[stage];
  latencies.all.add(seconds);
  latencies.recent.add(seconds);
}

void Health::set_trouble(std::int8_t level, std::string message) {
  level_ = level;
  message_ = std::move(message);
}

geomap::health_t Health::take_message() {
  geomap::health_t message{};
  message.utime = utime_;
  message.session = session_;
  message.started = started_;
  message.process = process_;
  message.version = version();
  message.config_hash = config_hash_;
  message.level = level_;
  message.message = message_;
  for (const auto& [name, value] : counters_) message.counters.push_back({name, value});
  message.n_counters = static_cast<std::int32_t>(message.counters.size());
  for (auto& [name, stage] : stages_) {
    const Latency& recent = stage.recent;
    message.stages.push_back({name, static_cast<std::int32_t>(recent.count()), recent.quantile(0.5),
                              recent.quantile(kMost), recent.max()});
    stage.recent = {};
  }
  message.n_stages = static_cast<std::int32_t>(message.stages.size());
  return message;
}

std::string Health::summary() const {
  std::string text;
  for (const auto& [name, value] : counters_) text += fmt::format("{:<32} {:>10}\n", name, value);
  for (const auto& [name, stage] : stages_) {
    text += fmt::format("{:<32} {:>10} runs, p50 {:.2f} ms, p95 {:.2f} ms, max {:.2f} ms\n", name,
                        stage.all.count(), 1e3 * stage.all.quantile(0.5),
                        1e3 * stage.all.quantile(kMost), 1e3 * stage.all.max());
  }
  return text;
}

}  // namespace geomap::messaging
