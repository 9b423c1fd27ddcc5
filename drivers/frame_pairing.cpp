// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/frame_pairing.hpp"

#include <cstdlib>
#include <utility>

namespace geomap::drivers {
namespace {

constexpr std::size_t kMostWaiting = 8;  // images of one kind, should the other one stay away

}  // namespace

template <class Image>
void FramePairing::enqueue(std::deque<Timed<Image>>& queue, Timed<Image> image) {
  queue.push_back(std::move(image));
  if (queue.size() <= kMostWaiting) return;
  queue.pop_front();
  ++unpaired_;
}

std::optional<ImagePair> FramePairing::add(CameraImage image, std::int64_t arrival) {
  if (auto* depth = std::get_if<geometry::DepthImage>(&image.image)) {
    enqueue(depth_, {image.sensor_time, arrival, std::move(*depth)});
  } else {
    enqueue(color_,
            {image.sensor_time, arrival, std::get<geometry::ColorImage>(std::move(image.image))});
  }
  while (!depth_.empty() && !color_.empty()) {
    const std::int64_t ahead = depth_.front().sensor_time - color_.front().sensor_time;
    if (std::abs(ahead) <= tolerance_) {
      ImagePair pair{depth_.front().sensor_time, depth_.front().arrival,
                     std::move(depth_.front().image), std::move(color_.front().image)};
      depth_.pop_front();
      color_.pop_front();
      return pair;
    }
    ahead > 0 ? color_.pop_front() : depth_.pop_front();
    ++unpaired_;
  }
  return std::nullopt;
}

void FramePairing::clear() {
  unpaired_ += static_cast<std::int64_t>(depth_.size() + color_.size());
  depth_.clear();
  color_.clear();
}

}  // namespace geomap::drivers
