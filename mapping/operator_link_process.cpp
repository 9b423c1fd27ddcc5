// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/operator_link_process.hpp"

#include "messaging/channels.hpp"

namespace geomap::mapping {
namespace {

namespace channels = messaging::channels;
using messaging::Keep;

constexpr double kPosePeriod = 0.2;  // between two CAMERA_POSE: smooth to the eye [s]

messaging::BusConfig bus_at(const std::string& url, const messaging::LiveProcess& live) {
  return {.url = url, .channel_prefix = live.bus().config().channel_prefix};
}

}  // namespace

OperatorLink::OperatorLink(const std::string& url, double kbit_per_s, messaging::LiveProcess& live)
    : out_({.from = bus_at(live.bus().config().url, live),
            .to = bus_at(url, live),
            .channels = {{.name = channels::kMapDelta},
                         {.name = channels::kMapSnapshot},
                         {.name = channels::kMapEditReply},
                         {.name = channels::kMapEditRecord},
                         {.name = channels::kHealth},
                         {.name = channels::kCameraPose,
                          .keep = Keep::kNewest,
                          .period = kPosePeriod}},
            .kbit_per_s = kbit_per_s}),
      in_({.from = bus_at(url, live),
           .to = bus_at(live.bus().config().url, live),
           .channels = {{.name = channels::kMapRequest}, {.name = channels::kMapEdit}},
           .kbit_per_s = kbit_per_s}) {
  live.every(1.0, [this, &live] {
    live.health().set("operator.sent", out_.sent());
    live.health().set("operator.sent_bytes", out_.sent_bytes());
    live.health().set("operator.dropped", out_.dropped());
    live.health().set("operator.received", in_.sent());
  });
}

}  // namespace geomap::mapping
