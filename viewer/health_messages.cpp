// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/health_messages.hpp"

#include <algorithm>
#include <utility>

#include "mapping/clean_text.hpp"

namespace geomap::viewer {
namespace {

using mapping::clean_text;

constexpr std::size_t kMostStages = 200;

Level level_of(std::int8_t level) {
  if (level == geomap::health_t::GOOD) return Level::kGood;
  return level == geomap::health_t::DEGRADED ? Level::kDegraded : Level::kFailing;
}

}  // namespace

void take_health(const geomap::health_t& message, Clock::time_point now, ProcessState& state) {
  state.level = level_of(message.level);
  state.message = clean_text(message.message);
  state.heard = now;
  state.counters.clear();
  for (const geomap::counter_t& counter : message.counters) {
    state.counters[clean_text(counter.name)] = counter.value;
  }
  for (const geomap::stage_latency_t& latency : message.stages) {
    if (latency.count <= 0) continue;
    ProcessState::Stage stage{clean_text(latency.name), latency.p50, latency.p95, latency.max,
                              latency.count};
    const auto known =
        std::find_if(state.stages.begin(), state.stages.end(),
                     [&](const ProcessState::Stage& other) { return other.name == stage.name; });
    if (known != state.stages.end()) {
      *known = std::move(stage);
    } else if (state.stages.size() < kMostStages) {
      state.stages.push_back(std::move(stage));
    }
  }
}

}  // namespace geomap::viewer
