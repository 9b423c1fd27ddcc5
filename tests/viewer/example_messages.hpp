// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "geomap/keyframe_t.hpp"
#include "geomap/map_edit_record_t.hpp"
#include "geomap/point_map_update_t.hpp"
#include "geomap/rgbd_frame_t.hpp"
#include "mapping/map_view.hpp"
#include "messaging/convert_frame.hpp"
#include "messaging/convert_geometry.hpp"
#include "messaging/depth_codec.hpp"
#include "support/plane_renderer.hpp"

namespace geomap::testing {

/// @brief A view of squares side by side on a wall, 0.5 m apart.
inline mapping::MapView wall_view(std::int64_t epoch, std::int64_t revision, int features) {
  mapping::MapView view{1000 * revision, epoch, revision, {}};
  for (int i = 0; i < features; ++i) {
    mapping::ViewFeature feature;
    feature.id = {i + 1, 0};
    feature.origin = {5000 * i, 20'000, 10'000};
    feature.normal = {0, -1'000'000, 0};
    feature.x_axis = {30'000, 0, 0};
    feature.polygon = {{{geometry::rectangle({-0.2, -0.2}, {0.2, 0.2}), {}}}};
    feature.observations = 1;
    view.features.emplace(feature.id, feature);
  }
  return view;
}

/// @brief Boards side by side on a wall, apart from each other, before a camera that looks along y.
inline std::vector<Rectangle> boards(int count) {
  std::vector<Rectangle> boards;
  for (int i = 0; i < count; ++i) {
    Rectangle& board = boards.emplace_back();
    board.center = {0.9 * i - 1.5, 3.0, 1.0};
    board.v = Eigen::Vector3d::UnitZ();
    board.half_u = board.half_v = 0.3;
  }
  return boards;
}
/// @brief T_world_camera of a camera that passes them.
inline Eigen::Isometry3d camera_at(int step) {
  return look_at({0.05 * step - 0.5, -1.5, 1.4}, {0.0, 1.0, 1.0});
}

/// @brief Blocks of half a metre, given as place along x and number of points.
inline geomap::point_map_update_t point_update(
    std::int64_t session, std::int64_t sequence, bool is_complete,
    const std::vector<std::pair<std::int32_t, std::uint32_t>>& blocks) {
  std::vector<std::uint8_t> blob;
  const auto append = [&](std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) blob.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  };
  for (const auto& [x, points] : blocks) {
    append(static_cast<std::uint32_t>(x), 4);
    append(0, 4);
    append(0, 4);
    append(points, 4);
    for (std::uint32_t i = 0; i < points; ++i) {
      append(i * 65536 / points, 2);  // from one end of the block to the other
      append(0, 2);
      append(0, 2);
      append(0x00402010, 3);
    }
  }
  geomap::point_map_update_t message{};
  message.session = session;
  message.sequence = sequence;
  message.complete = is_complete ? 1 : 0;
  message.block_edge = 0.5;
  message.n_blocks = static_cast<std::int32_t>(blocks.size());
  message.uncompressed_size = static_cast<std::int32_t>(blob.size());
  message.data = messaging::deflate_bytes(blob);
  message.size = static_cast<std::int32_t>(message.data.size());
  return message;
}

/// @brief A small image of a room.
inline geomap::rgbd_frame_t frame_message(std::int64_t utime, std::int64_t sequence = 0) {
  geometry::RgbdFrame frame =
      render(small_room(), kinect_camera(8), look_at({0, -1.5, 1.4}, {-0.4, 1.0, 0.6})).frame;
  frame.utime = utime;
  frame.sequence = sequence;
  return messaging::to_message(frame);
}

/// @brief A key frame that was aligned to the map in so many steps; 0: there was no map yet.
inline geomap::keyframe_t keyframe_message(std::int64_t utime, std::int8_t status, double x = 0.0,
                                           std::int32_t iterations = 5) {
  geomap::keyframe_t message{};
  message.iterations = iterations;
  message.utime = utime;
  message.status = status;
  message.T_world_camera = messaging::to_message(Eigen::Isometry3d(Eigen::Translation3d(x, 0, 0)));
  message.T_world_camera_prior = message.T_world_camera;
  message.overlap = 0.21;
  message.frame = frame_message(utime);
  return message;
}

/// @brief A deletion with the surface that it keeps out.
inline geomap::map_edit_record_t record_message(std::int64_t epoch, std::int64_t number,
                                                std::int32_t count, std::int8_t state = 0) {
  geomap::map_edit_record_t record{};
  record.epoch = epoch;
  record.count = count;
  record.number = number;
  record.state = state;
  record.author = "ann";
  record.text = "delete 1-0";
  if (number == 0) return record;
  geomap::veto_t veto{};
  veto.id.keyframe = number;
  veto.frame = messaging::to_message(geometry::PlaneFrame{});
  veto.polygon = messaging::to_message(
      geometry::Polygon{{{geometry::rectangle({-0.2, -0.2}, {0.2, 0.2}), {}}}});
  record.vetoes = {veto};
  record.n_vetoes = 1;
  return record;
}

}  // namespace geomap::testing
