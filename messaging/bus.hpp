// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "messaging/encode.hpp"
#include "messaging/inbox.hpp"

namespace lcm {
class LCM;
struct ReceiveBuffer;
}  // namespace lcm

namespace geomap::messaging {

/// @brief How a process is connected.
struct BusConfig {
  std::string url;
  std::string channel_prefix;  // of every channel, in and out
  bool lossless = false;       // every message counts, as in a replay; else live
  double spool_mb = 512.0;     // messages that may wait for their turn
};

/// @brief True when what is sent at one URL is received at the other.
bool is_same_bus(const std::string& url, const std::string& other);

/// @brief A process's connection to the others over LCM. A thread of its own receives, so that
/// nothing is lost while the process works; what arrives waits in an inbox.
///
/// Lossless over TCP, a full inbox slows the senders down. Over multicast it cannot, and overflows.
class Bus {
 public:
  /// @throws ConfigError for a prefix that no channel can have; std::runtime_error, one line that
  /// says what to do, when LCM cannot be opened.
  explicit Bus(const BusConfig& config);
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  /// @brief Receives a channel from start() on. @param keep when not lossless; then it is kEvery.
  void subscribe(const std::string& channel, Keep keep);
  /// @brief Every message of every channel with the prefix.
  void subscribe_all();
  void start();
  /// @brief Nothing is received any more; what waits can still be taken.
  void stop_receiving();

  /// @brief The next message, its channel without the prefix; nothing until `deadline`.
  std::optional<Received> take(Inbox::Clock::time_point deadline) { return inbox_.take(deadline); }
  std::optional<Received> take(const std::string& channel, Inbox::Clock::time_point deadline) {
    return inbox_.take(channel, deadline);
  }

  template <class Message>
  void publish(const std::string& channel, const Message& message) {
    publish_bytes(channel, encode(message));
  }
  void publish_bytes(const std::string& channel, const std::vector<std::uint8_t>& data);

  const Inbox& inbox() const { return inbox_; }
  /// @brief Messages that could not be sent, as without a broker.
  std::int64_t unsent() const { return unsent_; }
  const BusConfig& config() const { return config_; }

 private:
  void receive();
  void wait_for_broker();
  void handle(const lcm::ReceiveBuffer* buffer, const std::string& channel);

  BusConfig config_;
  std::unique_ptr<lcm::LCM> lcm_;
  Inbox inbox_;
  std::map<std::string, Keep> keep_;  // by full channel name
  std::atomic<bool> is_receiving_{false};
  std::atomic<bool> is_connected_{true};  // to the broker, where there is one
  std::thread receiver_;
  std::int64_t unsent_ = 0;
};

}  // namespace geomap::messaging
