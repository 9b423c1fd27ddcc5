// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "drivers/rgbd_camera.hpp"

namespace geomap::drivers {

/// @brief Depth and colour of one moment.
struct ImagePair {
  std::int64_t sensor_time = 0;  // of the depth [us]
  std::int64_t arrival = 0;      // of the depth, host's clock [us]
  geometry::DepthImage depth;
  geometry::ColorImage color;
};

/// @brief Brings depth and colour together by their time stamps, in whatever order they arrive.
class FramePairing {
 public:
  /// @param tolerance between the time stamps of a pair [us]; half the time between two frames.
  explicit FramePairing(std::int64_t tolerance) : tolerance_(tolerance) {}

  /// @brief The pair that the image completes, if it does. @param arrival host's clock [us].
  std::optional<ImagePair> add(CameraImage image, std::int64_t arrival);

  /// @brief Gives up what waits: another camera's images do not belong to it.
  void clear();

  /// @brief Images that were given up because nothing belongs to them.
  std::int64_t unpaired() const { return unpaired_; }

 private:
  template <class Image>
  struct Timed {
    std::int64_t sensor_time, arrival;
    Image image;
  };

  template <class Image>
  void enqueue(std::deque<Timed<Image>>& queue, Timed<Image> image);

  std::int64_t tolerance_;
  std::deque<Timed<geometry::DepthImage>> depth_;
  std::deque<Timed<geometry::ColorImage>> color_;
  std::int64_t unpaired_ = 0;
};

}  // namespace geomap::drivers
