// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "messaging/live_process.hpp"
#include "messaging/relay.hpp"

namespace geomap::mapping {

/// @brief Joins the robot's bus, where the frames are, and a bus that reaches the operator: the
/// map, the camera's pose and HEALTH go out, requests come in. What the operator sends is trusted
/// no more than anything else on the robot's bus.
class OperatorLink {
 public:
  /// @param url of the operator's bus. @param kbit_per_s that it carries, in either direction.
  /// @throws messaging::ConfigError when it is the robot's own bus.
  OperatorLink(const std::string& url, double kbit_per_s, messaging::LiveProcess& live);

 private:
  messaging::Relay out_, in_;
};

}  // namespace geomap::mapping
