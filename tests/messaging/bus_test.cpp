// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/bus.hpp"

#include <gtest/gtest.h>

#include "messaging/config.hpp"
#include "messaging/relay.hpp"

namespace geomap::messaging {
namespace {

TEST(SameBus, OverMulticastThePortDecides) {
  EXPECT_TRUE(is_same_bus("udpm://239.255.76.67:7667?ttl=0", "udpm://239.255.76.67:7667?ttl=1"));
  EXPECT_TRUE(is_same_bus("udpm://239.255.76.67:7667", "udpm://239.255.76.68:7667"));
  EXPECT_TRUE(is_same_bus("udpm://?ttl=0", "udpm://239.255.76.67:7667?ttl=1"));
  EXPECT_TRUE(is_same_bus("udpm://", "udpm://239.255.76.68"));
  EXPECT_FALSE(is_same_bus("udpm://239.255.76.67:7667", "udpm://239.255.76.67:7668"));
  EXPECT_FALSE(is_same_bus("udpm://?ttl=0", "udpm://:7668"));
}

TEST(SameBus, OverTcpHostAndPortDo) {
  EXPECT_TRUE(is_same_bus("tcpq://", "tcpq://127.0.0.1:7700"));
  EXPECT_FALSE(is_same_bus("tcpq://10.0.0.1:7700", "tcpq://10.0.0.2:7700"));
  EXPECT_FALSE(is_same_bus("tcpq://127.0.0.1:7700", "tcpq://127.0.0.1:7701"));
  EXPECT_FALSE(is_same_bus("tcpq://127.0.0.1:7667", "udpm://239.255.76.67:7667"));
}

TEST(Relay, DoesNotCarryInCircles) {
  const RelayConfig config{.from = {"udpm://239.255.76.67:7667?ttl=0", ""},
                           .to = {"udpm://239.255.76.68:7667?ttl=1", ""},
                           .channels = {}};
  EXPECT_THROW(Relay{config}, ConfigError);
}

}  // namespace
}  // namespace geomap::messaging
