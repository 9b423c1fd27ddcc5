// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/truth_file.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <fstream>

#include "drivers/frame_source.hpp"
#include "drivers/text_file.hpp"
#include "drivers/yaml_map.hpp"

namespace geomap::drivers {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxCoordinate = 1e4;  // [m]; coordinates in a plane frame reach ten times as far
constexpr double kMaxOffPlane = 1e-3;   // [m]
constexpr double kUnitTolerance = 1e-12;  // a normal this close to length 1 is kept as it is

std::vector<Eigen::Vector3d> checked_ring(const YamlMap& map, std::string_view key,
                                          const std::vector<Eigen::Vector3d>& ring,
                                          const geometry::Plane& plane) {
  if (ring.size() < 3) map.fail(key, "has a ring of fewer than three vertices");
  for (const Eigen::Vector3d& point : ring) {
    if (point.cwiseAbs().maxCoeff() > kMaxCoordinate) {
      map.fail(key, "has a vertex beyond 10 km from the origin");
    }
    if (std::abs(plane.signed_distance(point)) > kMaxOffPlane) {
      map.fail(key, "has a vertex more than 1 mm off its plane");
    }
  }
  return ring;
}

TruthPolygon polygon_of(const YamlMap& map, const geometry::Plane& plane) {
  map.allow_only({"outer", "holes"});
  TruthPolygon polygon;
  polygon.outer = checked_ring(map, "outer", map.points("outer"), plane);
  for (const auto& hole : map.point_lists("holes")) {
    polygon.holes.push_back(checked_ring(map, "holes", hole, plane));
  }
  return polygon;
}

geometry::Plane unit_plane(const YamlMap& map) {
  const Eigen::Vector3d normal = map.vector("normal");
  const double d = map.number("d");
  const double length = normal.norm();
  if (!(length > 0.0) || !std::isfinite(length)) map.fail("normal", "has no direction");
  if (std::abs(length - 1.0) <= kUnitTolerance) return {normal, d};
  return {normal / length, d / length};
}

TruthPlane plane_of(const YamlMap& map) {
  TruthPlane plane;
  plane.name = map.text("name");
  plane.plane = unit_plane(map);
  if (!map.has("polygon") && map.has("centroid")) {
    plane.centroid = map.vector("centroid");
    if (plane.centroid->cwiseAbs().maxCoeff() > kMaxCoordinate) {
      map.fail("centroid", "lies beyond 10 km from the origin");
    }
    plane.seen = true;
    return plane;
  }
  plane.area = map.number("area");
  plane.visible_area = map.number("visible_area");
  plane.seen = map.boolean("seen");
  plane.polygon = polygon_of(map.map("polygon"), plane.plane);
  for (const YamlMap& part : map.maps("visible")) {
    plane.visible.push_back(polygon_of(part, plane.plane));
  }
  return plane;
}

// To a millionth, short; adding zero turns -0 into 0.
double rounded(double value) { return std::round(value * 1e6) / 1e6 + 0.0; }

std::string to_text(const Eigen::Vector3d& point) {
  return fmt::format("[{}, {}, {}]", rounded(point.x()), rounded(point.y()), rounded(point.z()));
}

template <typename Item>
std::string to_text(const std::vector<Item>& items) {
  std::string text;
  for (const Item& item : items) text += (text.empty() ? "" : ", ") + to_text(item);
  return fmt::format("[{}]", text);
}

std::string to_text(const TruthPolygon& polygon) {
  return fmt::format("{{outer: {}, holes: {}}}", to_text(polygon.outer), to_text(polygon.holes));
}

std::string to_text(const TruthPlane& plane) {
  YAML::Emitter name;
  name << plane.name;
  const Eigen::Vector3d& n = plane.plane.normal;
  std::string text = fmt::format("  - name: {}\n    normal: [{}, {}, {}]\n    d: {}\n",
                                 name.c_str(), n.x(), n.y(), n.z(), plane.plane.d);
  if (plane.centroid) return text + fmt::format("    centroid: {}\n", to_text(*plane.centroid));
  text += fmt::format("    area: {}\n    visible_area: {}\n    seen: {}\n    polygon: {}\n",
                      rounded(plane.area), rounded(plane.visible_area), plane.seen,
                      to_text(plane.polygon));
  text += plane.visible.empty() ? "    visible: []\n" : "    visible:\n";
  for (const TruthPolygon& part : plane.visible) {
    text += fmt::format("      - {}\n", to_text(part));
  }
  return text;
}

}  // namespace

Truth read_truth(const fs::path& path) {
  Truth truth;
  const YamlMap root = YamlMap::load(path);
  if (!root.has("planes")) root.fail("'planes' is missing");
  for (const YamlMap& map : root.maps("planes")) truth.planes.push_back(plane_of(map));
  return truth;
}

void write_truth(const Truth& truth, const fs::path& path) {
  std::string text = truth.planes.empty() ? "planes: []\n" : "planes:\n";
  for (const TruthPlane& plane : truth.planes) text += to_text(plane);
  write_text_file(path, text);
}

}  // namespace geomap::drivers
