// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/truth_file.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <charconv>
#include <cmath>
#include <fstream>

#include "drivers/frame_source.hpp"
#include "drivers/input_file.hpp"

namespace geomap::drivers {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxCoordinate = 1e4;  // [m]; coordinates in a plane frame reach ten times as far
constexpr double kMaxOffPlane = 1e-3;   // [m]
constexpr double kUnitTolerance = 1e-12;  // a normal this close to length 1 is kept as it is

class TruthReader {
 public:
  explicit TruthReader(const fs::path& path) : path_(path) {}

  Truth read() const {
    const std::vector<std::uint8_t> bytes = read_bytes(path_);
    try {
      Truth truth;
      const YAML::Node root = YAML::Load(std::string(bytes.begin(), bytes.end()));
      for (const YAML::Node& node : list(child(root, "planes"), "planes")) {
        truth.planes.push_back(plane(node));
      }
      return truth;
    } catch (const YAML::Exception& error) {
      fail(error.mark, "not readable as YAML: " + error.msg);
    }
  }

 private:
  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& what) const {
    const std::string line = mark.is_null() ? "" : fmt::format(":{}", mark.line + 1);
    throw SourceError(fmt::format("{}{}: {}", path_.string(), line, what));
  }

  YAML::Node child(const YAML::Node& map, const std::string& key) const {
    if (!map.IsMap()) fail(map.Mark(), "'" + key + "' is missing");
    const YAML::Node node = map[key];
    if (!node) fail(map.Mark(), "'" + key + "' is missing");
    return node;
  }

  YAML::Node list(const YAML::Node& node, const std::string& name) const {
    if (!node.IsSequence()) fail(node.Mark(), "'" + name + "' must be a list");
    return node;
  }

  double number(const YAML::Node& node) const {
    double value = 0.0;
    const std::string text = node.IsScalar() ? node.Scalar() : "a list";
    const char* end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stopped != end || !std::isfinite(value)) {
      fail(node.Mark(), "'" + text + "' is not a finite number");
    }
    return value;
  }

  double number(const YAML::Node& map, const std::string& key) const {
    return number(child(map, key));
  }

  Eigen::Vector3d vector(const YAML::Node& node) const {
    if (!node.IsSequence() || node.size() != 3) fail(node.Mark(), "three numbers are wanted");
    return {number(node[0]), number(node[1]), number(node[2])};
  }

  Eigen::Vector3d point(const YAML::Node& node) const {
    const Eigen::Vector3d p = vector(node);
    if (p.cwiseAbs().maxCoeff() > kMaxCoordinate) {
      fail(node.Mark(), "a point lies beyond 10 km from the origin");
    }
    return p;
  }

  std::vector<Eigen::Vector3d> ring(const YAML::Node& node, const geometry::Plane& plane) const {
    std::vector<Eigen::Vector3d> points;
    for (const YAML::Node& vertex : list(node, "ring")) {
      points.push_back(point(vertex));
      if (std::abs(plane.signed_distance(points.back())) > kMaxOffPlane) {
        fail(vertex.Mark(), "a vertex lies more than 1 mm off its plane");
      }
    }
    if (points.size() < 3) fail(node.Mark(), "a ring has fewer than three vertices");
    return points;
  }

  TruthPolygon polygon(const YAML::Node& node, const geometry::Plane& plane) const {
    TruthPolygon polygon{ring(child(node, "outer"), plane), {}};
    for (const YAML::Node& hole : list(child(node, "holes"), "holes")) {
      polygon.holes.push_back(ring(hole, plane));
    }
    return polygon;
  }

  geometry::Plane unit_plane(const YAML::Node& node) const {
    const Eigen::Vector3d normal = vector(child(node, "normal"));
    const double d = number(node, "d");
    const double length = normal.norm();
    if (!(length > 0.0) || !std::isfinite(length)) {
      fail(node["normal"].Mark(), "the normal has no direction");
    }
    if (std::abs(length - 1.0) <= kUnitTolerance) return {normal, d};
    return {normal / length, d / length};
  }

  bool flag(const YAML::Node& node) const {
    bool value = false;
    if (!YAML::convert<bool>::decode(node, value)) fail(node.Mark(), "true or false is wanted");
    return value;
  }

  TruthPlane plane(const YAML::Node& node) const {
    TruthPlane plane;
    plane.name = child(node, "name").as<std::string>();
    plane.plane = unit_plane(node);
    if (!node["polygon"] && node["centroid"]) {
      plane.centroid = point(node["centroid"]);
      plane.seen = true;
      return plane;
    }
    plane.area = number(node, "area");
    plane.visible_area = number(node, "visible_area");
    plane.seen = flag(child(node, "seen"));
    plane.polygon = polygon(child(node, "polygon"), plane.plane);
    for (const YAML::Node& part : list(child(node, "visible"), "visible")) {
      plane.visible.push_back(polygon(part, plane.plane));
    }
    return plane;
  }

  fs::path path_;
};

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

Truth read_truth(const fs::path& path) { return TruthReader(path).read(); }

void write_truth(const Truth& truth, const fs::path& path) {
  std::string text = truth.planes.empty() ? "planes: []\n" : "planes:\n";
  for (const TruthPlane& plane : truth.planes) text += to_text(plane);

  fs::path part = path;
  part += ".part";
  std::ofstream file(part, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  std::error_code error;
  if (file) fs::rename(part, path, error);
  if (!file || error) {
    fs::remove(part, error);
    throw SourceError(path.string() + ": cannot be written");
  }
}

}  // namespace geomap::drivers
