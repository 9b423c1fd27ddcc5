// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/point_layer_messages.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "messaging/convert_points.hpp"

namespace geomap::viewer {
namespace {

using namespace std::chrono_literals;

constexpr auto kLeastPatience = 1s, kMostPatience = 64s;  // between two requests
constexpr auto kOvertaking = 200ms;                       // an update may be late by as much
constexpr auto kPause = 300ms;           // after which a whole map is taken to have come
constexpr auto kLongestBurst = 60s;      // after which it is anyway
constexpr std::int64_t kReordering = 8;  // updates that one may overtake
constexpr std::size_t kMostAbsent = 1000, kMostBlocks = 2'000'000;  // numbers that are remembered
constexpr std::int64_t kLastNumber = std::int64_t{1} << 60;
constexpr std::int64_t kLongestLoss = 1'000'000;  // a longer one is another sender, not a loss
constexpr std::size_t kMostPoints = 50'000'000;   // of the layer

// Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014.
std::uint64_t mixed(std::uint64_t n) {
  n = (n + 0x9e3779b97f4a7c15U) * 0xbf58476d1ce4e5b9U;
  n = (n ^ (n >> 27U)) * 0x94d049bb133111ebU;
  return n ^ (n >> 31U);
}

// The points in an order of which any first ones are an even sample (Fisher and Yates); always the
// same for the same points.
std::shared_ptr<const std::vector<ScenePoint>> shuffled(
    const std::vector<messaging::ColoredPoint>& points) {
  std::vector<ScenePoint> shuffled;
  shuffled.reserve(points.size());
  for (const messaging::ColoredPoint& point : points) {
    shuffled.push_back({point.position.cast<float>(), point.color});
  }
  for (std::size_t i = shuffled.size(); i > 1; --i) {
    std::swap(shuffled[i - 1], shuffled[mixed(i) % i]);
  }
  return std::make_shared<const std::vector<ScenePoint>>(std::move(shuffled));
}

Eigen::AlignedBox3d box_of(const BlockKey& key, double edge) {
  const Eigen::Vector3d corner = edge * Eigen::Vector3d(key[0], key[1], key[2]);
  return {corner, corner + Eigen::Vector3d::Constant(edge)};
}

void remove(const BlockKey& key, PointLayer& layer) {
  const auto found = layer.blocks.find(key);
  if (found == layer.blocks.end()) return;
  layer.points -= found->second.points->size();
  layer.blocks.erase(found);
}

void put(const messaging::PointBlock& block, double edge, PointLayer& layer) {
  remove(block.index, layer);
  if (block.points.empty()) return;
  layer.points += block.points.size();
  layer.blocks.emplace(block.index,
                       PointBlock{shuffled(block.points), box_of(block.index, edge), layer.stamp});
}

}  // namespace

Taken PointUpdates::take(const geomap::point_map_update_t& message, Clock::time_point now,
                         PointLayer& layer) {
  const auto blocks = messaging::from_message(message);
  const bool is_number = message.sequence >= 0 && message.sequence <= kLastNumber;
  if (!blocks || !is_number || writers_.size() + blocks->size() > kMostBlocks) {
    return Taken::kRefused;
  }
  std::size_t points = layer.points;
  for (const messaging::PointBlock& block : *blocks) points += block.points.size();
  if (points > kMostPoints) return Taken::kRefused;
  if (!follow(message)) return Taken::kNothing;
  note_burst(message, now);
  ++layer.stamp;
  for (const messaging::PointBlock& block : *blocks) {
    const auto [writer, is_first] = writers_.try_emplace(block.index, message.sequence);
    if (!is_first && writer->second > message.sequence) continue;
    writer->second = message.sequence;
    put(block, message.block_edge, layer);
  }
  return Taken::kChange;
}

// Notes which updates are missing. False for one that has come before.
bool PointUpdates::follow(const geomap::point_map_update_t& message) {
  const std::int64_t ahead = sequence_ ? message.sequence - *sequence_ : 1;
  const bool was_absent = absent_.contains(message.sequence);
  const bool is_repeated = ahead <= 0 && !was_absent;
  // Before its first frame a sender has session 0, and one that was started anew has it again.
  const bool is_anew = is_repeated && message.session == 0 && message.complete != 0;
  const bool is_same_sender = sequence_ && !is_anew &&
                              (message.session == session_ || session_ == 0) &&
                              (was_absent || (ahead > -kReordering && ahead < kLongestLoss));
  if (!is_same_sender) {
    note_loss();
    writers_.clear();
    absent_.clear();
    sequence_ = message.sequence - 1;
  } else if (is_repeated) {
    return false;
  }
  session_ = message.session;
  if (absent_.erase(message.sequence) > 0) --missing_;
  note_gap(*sequence_ + 1, message.sequence);
  sequence_ = std::max(*sequence_, message.sequence);
  if (message.complete == 0 || (first_ && *first_ > message.sequence)) return true;
  first_ = message.sequence;
  absent_.erase(absent_.begin(), absent_.lower_bound(message.sequence));
  return true;
}

void PointUpdates::note_gap(std::int64_t first, std::int64_t end) {
  if (end <= first) return;
  missing_ += end - first;
  if (absent_.size() + static_cast<std::size_t>(end - first) > kMostAbsent) {
    absent_.clear();
    first_.reset();
    return;
  }
  for (std::int64_t number = first; number < end; ++number) absent_.insert(number);
}

// What follows upon a whole map in the same burst has the same time; later updates are of a newer
// frame, and do not prolong it.
void PointUpdates::note_burst(const geomap::point_map_update_t& message, Clock::time_point now) {
  if (message.complete != 0) {
    burst_ = {message.utime, now, now};
    must_drop_ = false;
  } else if (burst_ && burst_->utime == message.utime) {
    burst_->heard = now;
  }
}

bool PointUpdates::is_outdated(const BlockKey& block) const {
  const auto writer = writers_.find(block);
  return writer == writers_.end() || writer->second < *first_;
}

bool PointUpdates::drop_outdated(Clock::time_point now, PointLayer& layer) {
  if (burst_ && (now - burst_->heard >= kPause || now - burst_->began >= kLongestBurst)) {
    burst_.reset();
    must_drop_ = true;
  }
  if (!must_drop_ || !is_whole()) return false;
  must_drop_ = false;
  patience_ = kLeastPatience;
  std::vector<BlockKey> outdated;
  for (const auto& [key, block] : layer.blocks) {
    if (is_outdated(key)) outdated.push_back(key);
  }
  for (const BlockKey& key : outdated) remove(key, layer);
  std::erase_if(writers_, [&](const auto& writer) { return writer.second < *first_; });
  if (!outdated.empty()) ++layer.stamp;
  return !outdated.empty();
}

void PointUpdates::note_loss() {
  first_.reset();
  patience_ = kLeastPatience;
}

bool PointUpdates::should_ask(Clock::time_point now) {
  if (is_whole() || burst_) {
    incomplete_since_.reset();
    return false;
  }
  if (!incomplete_since_) incomplete_since_ = now;
  if (first_ && now - *incomplete_since_ < kOvertaking) return false;
  if (asked_ && now - *asked_ < patience_) return false;
  patience_ = asked_ ? std::min<Clock::duration>(2 * patience_, kMostPatience) : kLeastPatience;
  asked_ = now;
  return true;
}

}  // namespace geomap::viewer
