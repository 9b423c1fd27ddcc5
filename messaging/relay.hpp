// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "messaging/bus.hpp"

namespace geomap::messaging {

/// @brief A channel that goes from one bus to another.
struct RelayedChannel {
  std::string name;
  Keep keep = Keep::kEvery;  // of the messages that wait
  double period = 0.0;       // at least, between two messages; what comes sooner is left out [s]
};

struct RelayConfig {
  BusConfig from, to;
  std::vector<RelayedChannel> channels;
  double kbit_per_s = 200.0;  // no faster, headers of UDP and IP included
};

/// @brief Carries messages from one bus to another, evenly, so that a thin link loses none to its
/// own queue. A thread of its own does it: a slow or missing link slows nobody down. What finds no
/// room is dropped; a bus that cannot be opened is tried again and again.
class Relay {
 public:
  /// @throws ConfigError when both buses are one, which would carry messages in circles.
  explicit Relay(const RelayConfig& config);
  ~Relay();
  Relay(const Relay&) = delete;
  Relay& operator=(const Relay&) = delete;

  std::int64_t sent() const { return sent_; }
  std::int64_t sent_bytes() const { return sent_bytes_; }
  /// @brief Messages that found no room, could not be sent, or are too large.
  std::int64_t dropped() const { return dropped_; }

 private:
  void run();
  void carry(Bus& from, Bus& to);

  RelayConfig config_;
  std::atomic<std::int64_t> sent_{0}, sent_bytes_{0}, dropped_{0};
  std::atomic<bool> is_stopping_{false};
  std::thread thread_;
};

}  // namespace geomap::messaging
