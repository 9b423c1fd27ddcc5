// SPDX-License-Identifier: BSD-3-Clause
// operator_view: an operator without a screen. Follows the map and prints each state of it.
#include <cstdio>
#include <utility>

#include "geomap/map_request_t.hpp"
#include "mapping/map_client.hpp"
#include "messaging/bus.hpp"
#include "messaging/channels.hpp"
#include "messaging/program.hpp"
#include "messaging/safe_decode.hpp"

namespace {

using namespace geomap;
namespace channels = messaging::channels;
using Clock = mapping::MapClient::Clock;

// A line for each state: seconds of the host's steady clock, revision, view_hash.
void print(const mapping::MapView& view) {
  std::printf("%.3f %lld %s\n",
              std::chrono::duration<double>(Clock::now().time_since_epoch()).count(),
              static_cast<long long>(view.revision), mapping::view_hash(view).c_str());
  std::fflush(stdout);
}

template <class Message>
void give(const messaging::Received& received, mapping::MapClient& client) {
  auto decoded = messaging::safe_decode<Message>(received.data.data(), received.data.size());
  if (decoded.message) client.take(*decoded.message, Clock::now());
}

int run(const messaging::CommonOptions& common) {
  messaging::Bus bus({.url = common.lcm_url, .channel_prefix = common.channel_prefix});
  for (const char* channel : {channels::kMapDelta, channels::kMapSnapshot}) {
    bus.subscribe(channel, messaging::Keep::kEvery);
  }
  bus.start();
  mapping::MapClient client([&bus] {
    geomap::map_request_t request{};
    request.kind = geomap::map_request_t::SNAPSHOT;
    request.author = "operator_view";
    request.name = channels::kMapSnapshot;
    bus.publish(channels::kMapRequest, request);
  });
  std::pair<std::int64_t, std::int64_t> printed{0, 0};
  while (!messaging::stop_requested()) {
    if (const auto message = bus.take(Clock::now() + std::chrono::milliseconds(50))) {
      if (message->channel == channels::kMapDelta) give<geomap::map_delta_t>(*message, client);
      if (message->channel == channels::kMapSnapshot) give<geomap::map_t>(*message, client);
    }
    client.poll(Clock::now());
    const mapping::MapView& view = client.view();
    if (std::pair(view.epoch, view.revision) == printed) continue;
    printed = {view.epoch, view.revision};
    print(view);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return messaging::run_program(
      argc, argv,
      {.name = "operator_view",
       .description = "Follows the map as the operator's end of the link does; prints time, "
                      "revision and view_hash of each state.",
       .uses_lcm = true,
       .uses_config = false},
      [](messaging::OptionParser&) {}, run);
}
