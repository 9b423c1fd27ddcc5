// SPDX-License-Identifier: BSD-3-Clause
#include "perception/point_map_ply.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace geomap::perception {
namespace {

static_assert(std::endian::native == std::endian::little, "floats are written as they lie");

constexpr double kFloatsSuffice = 4096.0;  // [m]

Eigen::Vector3d offset_for(const std::vector<MapPoint>& points) {
  Eigen::AlignedBox3d box;
  for (const MapPoint& point : points) box.extend(point.position);
  if (box.isEmpty()) return Eigen::Vector3d::Zero();
  const double farthest = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
  if (farthest <= kFloatsSuffice) return Eigen::Vector3d::Zero();
  return box.center().array().round().matrix();
}

void write_header(std::ostream& out, std::size_t points, const Eigen::Vector3d& offset) {
  out << "ply\nformat binary_little_endian 1.0\n";
  if (!offset.isZero()) {
    out << "comment offset " << static_cast<long long>(offset.x()) << ' '
        << static_cast<long long>(offset.y()) << ' ' << static_cast<long long>(offset.z()) << '\n';
  }
  out << "element vertex " << points << '\n'
      << "property float x\nproperty float y\nproperty float z\n"
      << "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
}

void write_point(std::ostream& out, const MapPoint& point, const Eigen::Vector3d& offset) {
  const Eigen::Vector3f p = (point.position - offset).cast<float>();
  std::array<char, 15> bytes{};
  std::memcpy(bytes.data(), p.data(), 12);
  std::memcpy(bytes.data() + 12, point.color.data(), 3);
  out.write(bytes.data(), bytes.size());
}

}  // namespace

void write_ply(const std::filesystem::path& path, const std::vector<MapPoint>& points) {
  std::ofstream out(path, std::ios::binary);
  const Eigen::Vector3d offset = offset_for(points);
  write_header(out, points.size(), offset);
  for (const MapPoint& point : points) write_point(out, point, offset);
  out.flush();
  if (!out) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace geomap::perception
