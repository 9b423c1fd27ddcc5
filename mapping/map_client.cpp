// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map_client.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "mapping/map_view_messages.hpp"

namespace geomap::mapping {
namespace {

using namespace std::chrono_literals;

constexpr auto kPatience = 200ms;    // for messages that overtook each other
constexpr auto kRequestPeriod = 1s;  // between requests
constexpr auto kSilence = 10s;       // of a mapper, after which an older epoch is believed
constexpr std::int64_t kFarthestAhead = 10'000;  // revisions of a delta before the view
constexpr std::int32_t kMostParts = 4096;
constexpr std::size_t kMostPending = 4096;  // messages
constexpr int kLargestPart = 16'384;        // of a message; a sound one has a tenth of it [byte]

template <class Message>
std::vector<Message> in_order(const std::map<std::int32_t, Message>& parts) {
  std::vector<Message> messages;
  for (const auto& [part, message] : parts) messages.push_back(message);
  return messages;
}

template <class Message>
bool is_complete(const std::map<std::int32_t, Message>& parts) {
  return static_cast<std::int32_t>(parts.size()) == parts.begin()->second.parts;
}

}  // namespace

MapClient::MapClient(std::function<void()> request_snapshot)
    : request_snapshot_(std::move(request_snapshot)) {}

std::int64_t MapClient::revision() const { return view_.epoch == epoch_ ? view_.revision : 0; }

bool MapClient::is_current() const {
  return epoch_ && view_.epoch == *epoch_ && !lost_ && deltas_.empty() && snapshots_.empty();
}

void MapClient::take(const geomap::map_delta_t& message, Clock::time_point now) {
  if (is_plausible(message, now) && message.revision > revision()) {
    if (message.revision - kFarthestAhead > revision()) {
      lost_ = true;
    } else if (collect(message, deltas_)) {
      apply_pending();
    }
  }
  poll(now);
}

void MapClient::take(const geomap::map_t& message, Clock::time_point now) {
  if (is_plausible(message, now) && message.revision >= revision()) {
    if (view_.epoch == epoch_ && message.revision == view_.revision && !hash_) {
      hash_ = view_hash(view_);
    }
    const bool is_known =
        view_.epoch == epoch_ && message.revision == view_.revision && message.view_hash == hash_;
    if (is_known) {
      lost_ = false;
    } else if (collect(message, snapshots_)) {
      take_snapshot(message.revision);
    }
  }
  poll(now);
}

void MapClient::poll(Clock::time_point now) {
  if (is_current()) {
    incomplete_since_.reset();
    return;
  }
  if (!incomplete_since_) incomplete_since_ = now;
  const bool waited = !epoch_ || now - *incomplete_since_ >= kPatience;
  if (!waited || (requested_ && now - *requested_ < kRequestPeriod)) return;
  requested_ = now;
  request_snapshot_();
}

template <class Message>
bool MapClient::is_plausible(const Message& message, Clock::time_point now) {
  const bool plausible = message.parts > 0 && message.parts <= kMostParts && message.part >= 0 &&
                         message.part < message.parts && message.revision >= 0 &&
                         message.getEncodedSize() <= kLargestPart && follow(message.epoch, now);
  if (!plausible) ++refused_;
  return plausible;
}

// Epochs rise with the mapper's clock, unless that was set back.
bool MapClient::follow(std::int64_t epoch, Clock::time_point now) {
  if (epoch_ && epoch < *epoch_ && now - heard_ < kSilence) return false;
  if (epoch != epoch_) {
    epoch_ = epoch;
    forget_pending();
    lost_ = false;
  }
  heard_ = now;
  return true;
}

// True when all parts of the message's revision are there.
template <class Message>
bool MapClient::collect(const Message& message, Pending<Message>& pending) {
  if (pending_messages_ >= kMostPending) {
    forget_pending();
    lost_ = true;
  }
  Parts<Message>& parts = pending[message.revision];
  if (!parts.empty() && parts.begin()->second.parts != message.parts) {
    ++refused_;
    return false;
  }
  if (parts.emplace(message.part, message).second) ++pending_messages_;
  return is_complete(parts);
}

void MapClient::take_snapshot(std::int64_t revision) {
  const auto found = snapshots_.find(revision);
  std::optional<MapView> snapshot = from_messages(in_order(found->second));
  pending_messages_ -= found->second.size();
  snapshots_.erase(found);
  if (!snapshot) {
    ++refused_;
    lost_ = true;
    return;
  }
  view_ = std::move(*snapshot);
  ++changes_;
  hash_.reset();
  lost_ = false;
  apply_pending();
}

// Takes over the deltas that follow upon the view, and drops what is behind it.
void MapClient::apply_pending() {
  const auto drop_through = [this](auto& pending, std::int64_t revision) {
    while (!pending.empty() && pending.begin()->first <= revision) {
      pending_messages_ -= pending.begin()->second.size();
      pending.erase(pending.begin());
    }
  };
  drop_through(deltas_, revision());
  while (!deltas_.empty() && deltas_.begin()->first == revision() + 1 &&
         is_complete(deltas_.begin()->second)) {
    if (view_.epoch != epoch_) {
      view_ = MapView{0, *epoch_, 0, {}};  // every epoch begins empty
      ++changes_;
    }
    const auto delta = from_messages(in_order(deltas_.begin()->second), view_);
    drop_through(deltas_, revision() + 1);
    if (!delta) {
      ++refused_;
      lost_ = true;
      break;
    }
    apply(*delta, view_);
    ++changes_;
    hash_.reset();
  }
  drop_through(snapshots_, revision());
}

void MapClient::forget_pending() {
  deltas_.clear();
  snapshots_.clear();
  pending_messages_ = 0;
}

}  // namespace geomap::mapping
