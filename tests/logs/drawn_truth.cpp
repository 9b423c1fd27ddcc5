// SPDX-License-Identifier: BSD-3-Clause
#include "logs/drawn_truth.hpp"

#include <utility>

#include "mapping/example_map.hpp"

namespace geomap::testing {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Points corners(const geometry::PlaneFrame& frame, const DrawnRectangle& r) {
  const auto at = [&](double u, double v) -> Eigen::Vector3d {
    return frame.origin + u * frame.x_axis + v * frame.y_axis();
  };
  return {at(r.left, r.bottom), at(r.right, r.bottom), at(r.right, r.top), at(r.left, r.top)};
}

double area_of(const DrawnRectangle& r) { return (r.right - r.left) * (r.top - r.bottom); }

}  // namespace

drivers::TruthPlane draw_truth(const std::string& name, const geometry::PlaneFrame& frame,
                               const DrawnRectangle& whole,
                               const std::vector<DrawnRectangle>& visible,
                               const std::vector<DrawnRectangle>& openings) {
  drivers::TruthPlane truth;
  truth.name = name;
  truth.plane = frame.plane();
  truth.area = area_of(whole);
  truth.polygon.outer = corners(frame, whole);
  for (const DrawnRectangle& opening : openings) {
    const Points outer = corners(frame, opening);
    truth.polygon.holes.emplace_back(outer.rbegin(), outer.rend());
    truth.area -= area_of(opening);
  }
  for (const DrawnRectangle& part : visible) {
    truth.visible.push_back({corners(frame, part), truth.polygon.holes});
    truth.visible_area += area_of(part);
  }
  for (const DrawnRectangle& opening : openings) truth.visible_area -= area_of(opening);
  truth.seen = !visible.empty();
  return truth;
}

mapping::MapFeature draw_feature(std::int64_t id, const geometry::PlaneFrame& frame,
                                 const std::vector<DrawnRectangle>& parts) {
  geometry::Polygon polygon;
  for (const DrawnRectangle& r : parts) {
    polygon.parts.push_back({rectangle_ring(r.left, r.bottom, r.right, r.top), {}});
  }
  return make_feature(
      {.id = {id, 0}, .origin = frame.origin, .normal = frame.normal, .x_axis = frame.x_axis},
      std::move(polygon));
}

geometry::PlaneFrame tilted(const geometry::PlaneFrame& frame, double angle) {
  const Eigen::AngleAxisd turn(angle, frame.y_axis());
  return {frame.origin, turn * frame.x_axis, turn * frame.normal};
}

geometry::PlaneFrame raised(const geometry::PlaneFrame& frame, double height) {
  return {frame.origin + height * frame.normal, frame.x_axis, frame.normal};
}

}  // namespace geomap::testing
