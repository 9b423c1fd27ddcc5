// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "geomap/map_request_t.hpp"
#include "messaging/bus.hpp"
#include "messaging/health.hpp"
#include "messaging/program.hpp"
#include "messaging/safe_decode.hpp"

namespace geomap::messaging {

/// @brief The options that all processes on the bus have beside the common ones.
struct LiveOptions {
  bool lossless = false;
  double spool_mb = 512.0;
};
void declare_live(OptionParser& parser, LiveOptions& options);

/// @brief What a process cannot go on after: a message is missing where every one counts, or the
/// process runs already.
class FatalFault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// @brief What all processes on the bus have in common: they take one message after the other,
/// trusting none, publish HEALTH once a second, refuse to be a second copy on the same channels,
/// and on Ctrl-C finish what has arrived and print a summary.
class LiveProcess {
 public:
  using Bytes = std::span<const std::uint8_t>;

  /// @param name of the program. @throws as Bus.
  LiveProcess(const std::string& name, const CommonOptions& common, const LiveOptions& live);

  /// @brief Called with each message of a channel. What it throws is counted and logged, unless it
  /// is FatalFault.
  void on_bytes(const std::string& channel, Keep keep,
                std::function<void(const std::string& channel, Bytes data)> handler);

  /// @brief The same, decoded; what cannot be decoded is counted by reason.
  template <class Message>
  void on(const std::string& channel, Keep keep, std::function<void(Message)> handler) {
    on_bytes(channel, keep, [this, handler](const std::string& from, Bytes data) {
      auto decoded = safe_decode<Message>(data.data(), data.size());
      if (decoded.message) {
        handler(std::move(*decoded.message));
      } else {
        reject(from, to_string(decoded.reason));
      }
    });
  }

  /// @brief Takes MAP_REQUEST. PAUSE and RESUME are seen to here; the rest goes to the handler.
  void on_request(std::function<void(const geomap::map_request_t&)> handler);
  bool is_paused() const { return is_paused_; }

  /// @brief Called again and again, between messages.
  void every(double seconds, std::function<void()> task);

  template <class Message>
  void publish(const std::string& channel, const Message& message) {
    health_.count("out." + channel);
    bus_.publish(channel, message);
  }

  /// @brief Counts a refused message.
  void reject(const std::string& channel, const std::string& reason);
  /// @brief Counts messages that are missing. @throws FatalFault when the process is lossless.
  void note_missing(const std::string& channel, std::int64_t messages);

  Health& health() { return health_; }
  const Bus& bus() const { return bus_; }

  /// @brief Runs until Ctrl-C or request_stop(); then `finish` is called after the last message.
  /// @param summary what to print at the end beside counts and latencies.
  /// @return 0. @throws FatalFault.
  int run(const std::function<void()>& finish, const std::function<std::string()>& summary);

 private:
  using Clock = Inbox::Clock;
  struct Task {
    Clock::duration period;
    Clock::time_point due;
    std::function<void()> run;
  };

  void refuse_second_copy();
  void take_health(const geomap::health_t& other);
  void dispatch(const Received& message);
  Clock::time_point next_due() const;
  void run_due_tasks();
  void publish_health();

  Bus bus_;
  Health health_;
  std::map<std::string, std::function<void(const std::string&, Bytes)>> handlers_;
  std::vector<Task> tasks_;
  bool is_paused_ = false;
};

}  // namespace geomap::messaging
