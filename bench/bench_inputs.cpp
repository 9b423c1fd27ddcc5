// SPDX-License-Identifier: BSD-3-Clause
#include "bench_inputs.hpp"

#include <cmath>
#include <utility>

#include "drivers/frame_messages.hpp"
#include "geometry/angles.hpp"
#include "perception/organized_extractor.hpp"
#include "staged_mapping.hpp"

namespace geomap::bench {
namespace {

using geometry::PlaneObservation;
using geometry::RgbdFrame;

constexpr int kPointStep = 4;  // [pixel]
// Of planes that are taken for the same.
constexpr double kMostAngle = geometry::radians(10.0);
constexpr double kMostDistance = 0.05;  // [m]

std::vector<std::vector<Eigen::Vector2d>> points_of(const RgbdFrame& frame,
                                                    const perception::ExtractedPlanes& extracted) {
  std::vector<std::vector<Eigen::Vector2d>> points(extracted.planes.size());
  for (int v = 0; v < frame.depth.height; v += kPointStep) {
    for (int u = 0; u < frame.depth.width; u += kPointStep) {
      const std::uint16_t reading = frame.depth.at(u, v);
      const auto pixel = static_cast<std::size_t>(v * frame.depth.width + u);
      const std::int16_t label = extracted.label[pixel];
      if (label == perception::kNoPlane || !geometry::DepthImage::is_reading(reading)) continue;
      const auto plane = static_cast<std::size_t>(label);
      const Eigen::Vector3d p = extracted.planes[plane].surface.frame.T_plane_parent() *
                                frame.depth_camera.point(u, v, 0.001 * reading);
      points[plane].push_back(p.head<2>());
    }
  }
  return points;
}

bool are_alike(const geometry::PlanarPolygon& a, const geometry::PlanarPolygon& b) {
  return geometry::angle_between(a.plane, b.plane) < kMostAngle &&
         std::abs(a.plane.signed_distance(b.frame.origin)) < kMostDistance;
}

void add_overlaps(const mapping::Observation& before, const mapping::Observation& after,
                  std::vector<Overlap>& overlaps) {
  const Eigen::Isometry3d T_before_after = before.T_world_camera.inverse() * after.T_world_camera;
  for (const PlaneObservation& seen : before.planes) {
    for (const PlaneObservation& again : after.planes) {
      const geometry::PlanarPolygon other = again.surface.transformed(T_before_after);
      if (!are_alike(seen.surface, other)) continue;
      const geometry::Polygon& a = seen.surface.polygon;
      geometry::Polygon b = other.in_frame(seen.surface.frame);
      if (!bounding_box(a).intersects(bounding_box(b))) continue;
      overlaps.push_back({a, std::move(b)});
    }
  }
}

void add_planes(const PosedFrame& posed, BenchInputs& inputs) {
  const RgbdFrame& frame = posed.frame;
  const auto seed = static_cast<std::uint64_t>(frame.utime);
  perception::ExtractedPlanes extracted = perception::OrganizedExtractor().extract(frame, seed, {});
  inputs.plane_points.push_back(points_of(frame, extracted));
  auto seen = std::make_shared<mapping::Observation>();
  seen->keyframe = frame.utime;
  seen->T_world_camera = posed.T_world_camera;
  seen->planes = std::move(extracted.planes);
  if (!inputs.observations.empty()) {
    add_overlaps(*inputs.observations.back(), *seen, inputs.overlaps);
  }
  inputs.observations.push_back(std::move(seen));
}

}  // namespace

BenchInputs load_bench_inputs(const std::function<void(const FrameVisitor&)>& visit) {
  BenchInputs inputs;
  StagedMapping mapping;  // tells what is a key frame
  const auto unmetered = [](std::size_t, const auto& work) { work(); };
  visit([&](drivers::SourceFrame read) {
    const Eigen::Isometry3d T_world_camera = *read.truth_T_world_camera;
    if (!mapping.add(read.frame, T_world_camera, unmetered)) return;
    inputs.messages.push_back(drivers::to_messages(read, {}).frame);
    read.frame.color = {};
    inputs.frames.push_back({std::move(read.frame), T_world_camera});
    add_planes(inputs.frames.back(), inputs);
  });
  return inputs;
}

}  // namespace geomap::bench
