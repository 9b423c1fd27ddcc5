// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/export_obj.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "mapping/export_mesh.hpp"

namespace geomap::mapping {
namespace {

std::string object_name(const FeatureMesh& mesh) {
  std::string name = to_string(mesh.id);
  if (!mesh.label.empty()) name += "_" + mesh.label;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

void append_material(std::string& mtl, const FeatureMesh& mesh) {
  fmt::format_to(std::back_inserter(mtl), "newmtl {}\nKa 0 0 0\nKd {:.4f} {:.4f} {:.4f}\n",
                 to_string(mesh.id), mesh.color[0] / 255.0, mesh.color[1] / 255.0,
                 mesh.color[2] / 255.0);
  mtl += "Ks 0 0 0\nd 1\nillum 1\n\n";
}

void append_object(std::string& obj, const FeatureMesh& mesh, std::size_t index,
                   std::size_t first_vertex) {
  auto out = std::back_inserter(obj);
  fmt::format_to(out, "o {}\nusemtl {}\n", object_name(mesh), to_string(mesh.id));
  for (const Eigen::Vector3d& v : mesh.vertices) {
    fmt::format_to(out, "v {:.6f} {:.6f} {:.6f}\n", v.x(), v.y(), v.z());
  }
  const Eigen::Vector3d& n = mesh.plane.normal;
  fmt::format_to(out, "vn {:.6f} {:.6f} {:.6f}\n", n.x(), n.y(), n.z());
  for (const auto& triangle : mesh.triangles) {
    // Indices of vertices and normals count from one through the whole file.
    fmt::format_to(out, "f {0}//{3} {1}//{3} {2}//{3}\n", first_vertex + triangle[0],
                   first_vertex + triangle[1], first_vertex + triangle[2], index + 1);
  }
}

}  // namespace

ObjFiles to_obj(const MapSnapshot& map, const std::string& mtl_name) {
  ObjFiles files;
  files.obj =
      fmt::format("# geometric map, world frame, z up, metres\n# revision {} hash {}\nmtllib {}\n",
                  map.revision, clean_text(map.hash), clean_text(mtl_name));
  std::size_t index = 0;
  std::size_t first_vertex = 1;
  for (const FeatureMesh& mesh : feature_meshes(map.features)) {
    append_material(files.mtl, mesh);
    append_object(files.obj, mesh, index, first_vertex);
    ++index;
    first_vertex += mesh.vertices.size();
  }
  return files;
}

}  // namespace geomap::mapping
