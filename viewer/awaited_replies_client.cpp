// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/awaited_replies_client.hpp"

#include <algorithm>
#include <utility>

namespace geomap::viewer {
namespace {

constexpr auto kPatience = std::chrono::seconds(10);

}  // namespace

void AwaitedReplies::add(const std::string& author, std::int64_t command, Clock::duration period,
                         Clock::time_point now, std::function<void()> send) {
  send();
  awaited_.push_back({author, command, period, now, now, std::move(send)});
}

void AwaitedReplies::take(const std::vector<EditReply>& replies) {
  for (const EditReply& reply : replies) {
    const auto found = std::find_if(awaited_.begin(), awaited_.end(), [&](const Awaited& awaited) {
      return awaited.author == reply.author && awaited.command == reply.outcome.command;
    });
    if (found == awaited_.end()) continue;
    outcomes_.push_back(reply.outcome);
    awaited_.erase(found);
  }
}

void AwaitedReplies::poll(Clock::time_point now) {
  for (auto awaited = awaited_.begin(); awaited != awaited_.end();) {
    if (now - awaited->asked >= kPatience) {
      outcomes_.push_back({.command = awaited->command,
                           .is_done = false,
                           .text = "no answer from geomap-mapper: is it running? "
                                   "(geomap-doctor looks at the network)"});
      awaited = awaited_.erase(awaited);
      continue;
    }
    if (now - awaited->sent >= awaited->period) {
      awaited->sent = now;
      awaited->send();
    }
    ++awaited;
  }
}

std::vector<Outcome> AwaitedReplies::take_outcomes() { return std::exchange(outcomes_, {}); }

}  // namespace geomap::viewer
