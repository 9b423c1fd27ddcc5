// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/inbox.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace geomap::messaging {

Inbox::Inbox(std::size_t most_bytes, WhenFull when_full)
    : most_bytes_(most_bytes), when_full_(when_full) {}

void Inbox::put(Received message, Keep keep) {
  std::unique_lock lock(mutex_);
  const std::size_t bytes = message.data.size();
  if (const auto waiting = newest_.find(message.channel);
      keep == Keep::kNewest && waiting != newest_.end()) {
    ++replaced_[message.channel];
    remove(waiting->second);
  }
  if (when_full_ == WhenFull::kWait) {
    taken_.wait(lock, [&] { return closed_ || has_room(bytes); });
  }
  if (closed_) return;
  if (!has_room(bytes)) {
    ++overflowed_;
    return;
  }
  bytes_ += bytes;
  queue_.push_back(std::move(message));
  if (keep == Keep::kNewest) newest_[queue_.back().channel] = std::prev(queue_.end());
  arrived_.notify_one();
}

std::optional<Received> Inbox::take(Clock::time_point deadline) {
  std::unique_lock lock(mutex_);
  if (!arrived_.wait_until(lock, deadline, [&] { return !queue_.empty(); })) return std::nullopt;
  return remove(queue_.begin());
}

std::optional<Received> Inbox::take(const std::string& channel, Clock::time_point deadline) {
  std::unique_lock lock(mutex_);
  const auto find = [&] {
    return std::find_if(queue_.begin(), queue_.end(),
                        [&](const Received& message) { return message.channel == channel; });
  };
  if (!arrived_.wait_until(lock, deadline, [&] { return find() != queue_.end(); })) {
    return std::nullopt;
  }
  return remove(find());
}

void Inbox::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  taken_.notify_all();
}

void Inbox::note_overflow() {
  const std::lock_guard lock(mutex_);
  ++overflowed_;
}

std::map<std::string, std::int64_t> Inbox::replaced() const {
  const std::lock_guard lock(mutex_);
  return replaced_;
}

std::int64_t Inbox::overflowed() const {
  const std::lock_guard lock(mutex_);
  return overflowed_;
}

bool Inbox::has_room(std::size_t bytes) const {
  return queue_.empty() || bytes_ + bytes <= most_bytes_;
}

Received Inbox::remove(Queue::iterator message) {
  Received removed = std::move(*message);
  bytes_ -= removed.data.size();
  if (const auto waiting = newest_.find(removed.channel);
      waiting != newest_.end() && waiting->second == message) {
    newest_.erase(waiting);
  }
  queue_.erase(message);
  taken_.notify_one();
  return removed;
}

}  // namespace geomap::messaging
