// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/logged_edits.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace geomap::mapping {
namespace {

constexpr std::size_t kMostWaiting = 10'000;  // commands without a reply; beyond, none is taken

}  // namespace

void LoggedEdits::add(EditCommand command, std::int64_t seen_utime) {
  const auto is_same = [&](const EditCommand& other) {
    return command.command != 0 && other.command == command.command &&
           other.author == command.author;
  };
  const bool is_repeated =
      std::any_of(waiting_.begin(), waiting_.end(),
                  [&](const Waiting& waiting) { return is_same(waiting.command); });
  if (!is_repeated && waiting_.size() < kMostWaiting)
    waiting_.push_back({std::move(command), seen_utime});
}

void LoggedEdits::take_reply(const std::string& author, std::int64_t command, bool is_done,
                             std::int64_t after) {
  const auto found = std::find_if(waiting_.begin(), waiting_.end(), [&](const Waiting& waiting) {
    return waiting.command.author == author && waiting.command.command == command;
  });
  if (found == waiting_.end()) return;
  if (is_done) placed_.push_back({std::move(found->command), after});
  waiting_.erase(found);
}

std::optional<LoggedEdits::Placed> LoggedEdits::next(std::int64_t newest) {
  if (placed_.empty() || placed_.front().after > newest) return std::nullopt;
  Placed placed = std::move(placed_.front());
  placed_.pop_front();
  return placed;
}

std::optional<LoggedEdits::Placed> LoggedEdits::next_at_end() {
  constexpr std::int64_t kEnd = std::numeric_limits<std::int64_t>::max();
  if (auto placed = next(kEnd)) return placed;
  if (waiting_.empty()) return std::nullopt;
  Waiting waiting = std::move(waiting_.front());
  waiting_.erase(waiting_.begin());
  return Placed{std::move(waiting.command), waiting.seen_utime > 0 ? waiting.seen_utime : kEnd};
}

}  // namespace geomap::mapping
