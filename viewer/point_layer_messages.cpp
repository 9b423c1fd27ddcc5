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
constexpr auto kPause = 300ms;           // after which a whole map is taken to have come
constexpr std::int64_t kReordering = 8;  // updates that one may overtake
constexpr std::int64_t kLastNumber = std::int64_t{1} << 60;
constexpr std::int64_t kLongestGap = 1'000'000;  // a longer one is another sender, not a loss
constexpr std::size_t kMostPoints = 50'000'000;  // of the layer

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
  if (!blocks || !is_number) return Taken::kRefused;
  std::size_t points = layer.points;
  for (const messaging::PointBlock& block : *blocks) points += block.points.size();
  if (points > kMostPoints) return Taken::kRefused;
  heard_ = now;
  patience_ = kLeastPatience;
  if (!follow(message)) return Taken::kNothing;
  ++layer.stamp;
  if (message.complete != 0) {
    for (const auto& [key, block] : layer.blocks) outdated_.insert(key);
  }
  for (const messaging::PointBlock& block : *blocks) {
    put(block, message.block_edge, layer);
    outdated_.erase(block.index);
  }
  return Taken::kChange;
}

// Notes what is missing before an update. False for one that comes too late: what it holds may have
// been replaced.
bool PointUpdates::follow(const geomap::point_map_update_t& message) {
  // Before its first frame a sender has session 0.
  const bool is_same_sender = sequence_ && (message.session == session_ || session_ == 0);
  const std::int64_t ahead = sequence_ ? message.sequence - *sequence_ : 1;
  const bool is_late = is_same_sender && message.complete == 0 && ahead <= 0 &&
                       ahead > -kReordering && message.sequence > 1;
  if (is_late) return false;
  const bool is_next = is_same_sender && ahead == 1;
  if (message.complete != 0) {
    is_whole_ = true;
  } else if (!is_next) {
    is_whole_ = false;
    if (is_same_sender && ahead > 1 && ahead < kLongestGap) missing_ += ahead - 1;
  }
  sequence_ = message.sequence;
  session_ = message.session;
  return true;
}

bool PointUpdates::drop_outdated(Clock::time_point now, PointLayer& layer) {
  if (outdated_.empty() || now - heard_ < kPause) return false;
  ++layer.stamp;
  for (const BlockKey& key : outdated_) remove(key, layer);
  outdated_.clear();
  return true;
}

bool PointUpdates::should_ask(Clock::time_point now) {
  if (is_whole_ || (asked_ && now - *asked_ < patience_)) return false;
  patience_ = asked_ ? std::min<Clock::duration>(2 * patience_, kMostPatience) : kLeastPatience;
  asked_ = now;
  return true;
}

}  // namespace geomap::viewer
