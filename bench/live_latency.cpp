// SPDX-License-Identifier: BSD-3-Clause
// live_latency: how long after a frame the map that it has changed is on the bus.
#include <chrono>
#include <cstdio>
#include <map>

#include "geomap/map_delta_t.hpp"
#include "messaging/big_endian.hpp"
#include "messaging/bus.hpp"
#include "messaging/channels.hpp"
#include "messaging/latency.hpp"
#include "messaging/program.hpp"
#include "messaging/safe_decode.hpp"

namespace {

using namespace geomap;
using Clock = messaging::Inbox::Clock;

// All messages begin with a fingerprint and utime, so a frame need not be decoded.
std::int64_t utime_of(const messaging::Received& message) {
  return message.data.size() < 16
             ? -1
             : static_cast<std::int64_t>(messaging::read_unsigned(message.data.data() + 8, 8));
}

int run(const messaging::CommonOptions& common, double seconds) {
  messaging::Bus bus({common.lcm_url, common.channel_prefix, true});
  bus.subscribe(messaging::channels::kRgbdFrame, messaging::Keep::kEvery);
  bus.subscribe(messaging::channels::kMapDelta, messaging::Keep::kEvery);
  bus.start();
  std::map<std::int64_t, Clock::time_point> frames;  // that no delta has spoken of yet
  messaging::Latency latency;
  messaging::Latency bytes;  // of deltas, for their quantiles
  const auto end = Clock::now() + messaging::Inbox::duration(seconds);
  std::int64_t received = 0;
  while (!messaging::stop_requested() && Clock::now() < end) {
    const auto message = bus.take(Clock::now() + std::chrono::milliseconds(50));
    if (!message) continue;
    const std::int64_t utime = utime_of(*message);
    if (message->channel == messaging::channels::kRgbdFrame) {
      ++received;
      frames[utime] = Clock::now();
      continue;
    }
    bytes.add(1e-6 * static_cast<double>(message->data.size()));
    const auto frame = frames.find(utime);
    if (frame == frames.end()) continue;  // a further part of a delta, or one for another cause
    latency.add(std::chrono::duration<double>(Clock::now() - frame->second).count());
    frames.erase(frames.begin(), std::next(frame));
  }
  std::printf("%lld frames, %lld of them in deltas\n", static_cast<long long>(received),
              static_cast<long long>(latency.count()));
  std::printf("frame to MAP_DELTA: p50 %.1f ms, p95 %.1f ms, max %.1f ms\n",
              1e3 * latency.quantile(0.5), 1e3 * latency.quantile(0.95), 1e3 * latency.max());
  std::printf("MAP_DELTA: median %.0f bytes, p95 %.0f, max %.0f\n", 1e6 * bytes.quantile(0.5),
              1e6 * bytes.quantile(0.95), 1e6 * bytes.max());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  double seconds = 60.0;
  return messaging::run_program(
      argc, argv,
      {.name = "live_latency",
       .description = "Measures on a running system how long after a frame the map that it has "
                      "changed is on the bus.",
       .uses_lcm = true,
       .uses_config = false},
      [&](messaging::OptionParser& parser) {
        parser.option("--seconds", seconds, "to listen for");
      },
      [&](const messaging::CommonOptions& common) { return run(common, seconds); });
}
