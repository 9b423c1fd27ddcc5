// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "viewer/map_source.hpp"
#include "viewer/scene_messages.hpp"

namespace geomap::viewer {

/// @brief The operator's commands that no mapper has answered yet.
class AwaitedReplies {
 public:
  /// @param send publishes the command. Called at once, and again every `period` until the reply.
  void add(const std::string& author, std::int64_t command, Clock::duration period,
           Clock::time_point now, std::function<void()> send);

  /// @brief Takes the replies to own commands; those to others' are nobody's business here.
  void take(const std::vector<EditReply>& replies);
  /// @brief Sends again what is due, and gives up what has waited for ten seconds.
  void poll(Clock::time_point now);

  std::vector<Outcome> take_outcomes();

 private:
  struct Awaited {
    std::string author;
    std::int64_t command = 0;
    Clock::duration period;
    Clock::time_point asked, sent;
    std::function<void()> send;
  };

  std::vector<Awaited> awaited_;
  std::vector<Outcome> outcomes_;
};

}  // namespace geomap::viewer
