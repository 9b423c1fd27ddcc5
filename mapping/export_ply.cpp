// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/export_ply.hpp"

#include <fmt/format.h>

#include <iterator>
#include <vector>

#include "mapping/export_bytes.hpp"
#include "mapping/export_mesh.hpp"

namespace geomap::mapping {
namespace {

constexpr double kLargestFloatCoordinate = 1024.0;  // [m]

Eigen::Vector3d offset_of(const std::vector<FeatureMesh>& meshes) {
  double largest = 0.0;
  for (const FeatureMesh& mesh : meshes) {
    for (const Eigen::Vector3d& vertex : mesh.vertices) {
      largest = std::max(largest, vertex.cwiseAbs().maxCoeff());
    }
  }
  if (largest <= kLargestFloatCoordinate) return Eigen::Vector3d::Zero();
  return whole_metre_centre(meshes);
}

std::string header(const MapSnapshot& map, const std::vector<FeatureMesh>& meshes,
                   const Eigen::Vector3d& offset, PlyFormat format) {
  std::size_t vertices = 0;
  std::size_t faces = 0;
  for (const FeatureMesh& mesh : meshes) {
    vertices += mesh.vertices.size();
    faces += mesh.triangles.size();
  }
  std::string text = fmt::format(
      "ply\nformat {} 1.0\ncomment geometric map, world frame, z up, metres\n"
      "comment revision {} hash {}\n",
      format == PlyFormat::kAscii ? "ascii" : "binary_little_endian", map.revision,
      clean_text(map.hash));
  if (!offset.isZero(0.0)) {
    text +=
        fmt::format("comment offset {:.0f} {:.0f} {:.0f}\n", offset.x(), offset.y(), offset.z());
  }
  text += fmt::format(
      "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      vertices, faces);
  return text;
}

void append_vertex(std::string& out, const Eigen::Vector3f& point, const Rgb& color,
                   PlyFormat format) {
  if (format == PlyFormat::kAscii) {
    // Nine digits give back every float.
    fmt::format_to(std::back_inserter(out), "{:.9g} {:.9g} {:.9g} {} {} {}\n", point.x(), point.y(),
                   point.z(), color[0], color[1], color[2]);
    return;
  }
  append_floats(out, point);
  for (const std::uint8_t channel : color) out += static_cast<char>(channel);
}

void append_face(std::string& out, const std::array<std::uint32_t, 3>& triangle,
                 std::uint32_t first, PlyFormat format) {
  if (format == PlyFormat::kAscii) {
    fmt::format_to(std::back_inserter(out), "3 {} {} {}\n", first + triangle[0],
                   first + triangle[1], first + triangle[2]);
    return;
  }
  out += '\3';
  for (const std::uint32_t vertex : triangle) append_uint32(out, first + vertex);
}

}  // namespace

std::string to_ply(const MapSnapshot& map, PlyFormat format) {
  const std::vector<FeatureMesh> meshes = feature_meshes(map.features);
  const Eigen::Vector3d offset = offset_of(meshes);
  std::string out = header(map, meshes, offset, format);
  for (const FeatureMesh& mesh : meshes) {
    for (const Eigen::Vector3d& vertex : mesh.vertices) {
      append_vertex(out, (vertex - offset).cast<float>(), mesh.color, format);
    }
  }
  std::uint32_t first = 0;
  for (const FeatureMesh& mesh : meshes) {
    for (const auto& triangle : mesh.triangles) append_face(out, triangle, first, format);
    first += static_cast<std::uint32_t>(mesh.vertices.size());
  }
  return out;
}

}  // namespace geomap::mapping
