// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "geomap/health_t.hpp"
#include "messaging/latency.hpp"

namespace geomap::messaging {

/// @brief How a process fares: what it counts, and how long its stages take.
class Health {
 public:
  /// @param process for example "geomap-register". @param started host's clock [us].
  Health(std::string process, std::string config_hash, std::int64_t started);

  const std::string& process() const { return process_; }
  std::int64_t started() const { return started_; }

  void count(const std::string& name, std::int64_t more = 1) { counters_[name] += more; }
  /// @brief For what is counted elsewhere. Nothing appears before it is above zero.
  void set(const std::string& name, std::int64_t value);
  std::int64_t value(const std::string& name) const;
  void time(const std::string& stage, double seconds);
  void note_utime(std::int64_t utime) { utime_ = utime; }  // of the newest input [us]
  void set_session(std::int64_t session) { session_ = session; }
  /// @brief Something that keeps the process from doing its job well, until it is called again;
  /// empty when all is well.
  void set_trouble(std::int8_t level, std::string message);

  /// @brief The state now; latencies are of the time since the last call.
  geomap::health_t take_message();

  /// @brief All counts and the latencies since the start, a line for each, for people.
  std::string summary() const;

 private:
  struct Stage {
    Latency all, recent;
  };
  std::string process_, config_hash_;
  std::int64_t started_;
  std::int64_t utime_ = 0, session_ = 0;
  std::int8_t level_ = geomap::health_t::GOOD;
  std::string message_;
  std::map<std::string, std::int64_t> counters_;
  std::map<std::string, Stage> stages_;
};

}  // namespace geomap::messaging
