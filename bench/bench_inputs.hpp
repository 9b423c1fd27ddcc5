// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "geomap/rgbd_frame_t.hpp"
#include "geometry/polygon.hpp"
#include "mapping/map_event.hpp"
#include "posed_frames.hpp"

namespace geomap::bench {

/// @brief Two polygons in one frame: a plane, and what the next key frame sees of the same.
struct Overlap {
  geometry::Polygon a, b;
};

/// @brief The key frames of a sequence, and what is made of them on the way to the map.
/// The first four have one entry a key frame.
struct BenchInputs {
  std::vector<PosedFrame> frames;
  std::vector<geomap::rgbd_frame_t> messages;  // as a log has them, with colour
  std::vector<std::shared_ptr<const mapping::Observation>> observations;
  // Of each plane, in its frame [m]: pixels of every fourth column and row, dropped onto it.
  std::vector<std::vector<std::vector<Eigen::Vector2d>>> plane_points;
  std::vector<Overlap> overlaps;
};

/// @param visit hands out all frames of the sequence, with true poses.
BenchInputs load_bench_inputs(const std::function<void(const FrameVisitor&)>& visit);

}  // namespace geomap::bench
