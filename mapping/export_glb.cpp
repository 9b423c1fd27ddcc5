// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/export_glb.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "mapping/export_bytes.hpp"
#include "mapping/export_mesh.hpp"

namespace geomap::mapping {
namespace {

using Json = nlohmann::ordered_json;

// Numbers of the glTF 2.0 and GLB specifications.
constexpr std::uint32_t kMagic = 0x46546C67;      // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kBinChunk = 0x004E4942;   // "BIN\0"
constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;

Json to_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Json to_json(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

// glTF's colour factors are linear, the cameras' bytes are sRGB (IEC 61966-2-1).
double linear_from_srgb(std::uint8_t byte) {
  const double value = byte / 255.0;
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

class GlbWriter {
 public:
  GlbWriter(const MapSnapshot& map, const Eigen::Vector3d& centre) : centre_(centre) {
    gltf_["asset"] = {{"version", "2.0"}, {"generator", "geomap"}};
    gltf_["asset"]["extras"] = {{"revision", map.revision}, {"hash", clean_text(map.hash)}};
    gltf_["scene"] = 0;
    gltf_["scenes"] = {{{"nodes", {0}}}};
    // -90° about x turns z up to y up: (x, y, z) becomes (x, z, -y). Applied before the
    // translation.
    const double half = std::sqrt(0.5);
    gltf_["nodes"] = {{{"name", "geomap"},
                       {"rotation", {-half, 0.0, 0.0, half}},
                       {"translation", {centre.x(), centre.z(), -centre.y()}}}};
  }

  void add(const FeatureMesh& mesh) {
    Json node = {{"name", mesh.label.empty() ? to_string(mesh.id) : mesh.label}};
    if (!mesh.triangles.empty()) node["mesh"] = add_mesh(mesh);
    node["extras"] = {{"id", to_string(mesh.id)},
                      {"label", mesh.label},
                      {"normal", to_json(mesh.plane.normal)},
                      {"d", mesh.plane.d},
                      {"area", mesh.area}};
    // A list of children must not be empty, so it appears with the first child.
    gltf_["nodes"][0]["children"].push_back(gltf_["nodes"].size());
    gltf_["nodes"].push_back(std::move(node));
  }

  std::string finish() {
    if (!bin_.empty()) gltf_["buffers"] = {{{"byteLength", bin_.size()}}};
    std::string json = gltf_.dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    bin_.resize((bin_.size() + 3) / 4 * 4, '\0');
    const std::size_t size = 12 + 8 + json.size() + (bin_.empty() ? 0 : 8 + bin_.size());
    if (size > std::numeric_limits<std::uint32_t>::max()) {
      throw std::invalid_argument("the map does not fit into a GLB file (4 GiB)");
    }
    std::string file;
    append_uint32(file, kMagic);
    append_uint32(file, 2);
    append_uint32(file, static_cast<std::uint32_t>(size));
    append_chunk(file, kJsonChunk, json);
    if (!bin_.empty()) append_chunk(file, kBinChunk, bin_);
    return file;
  }

 private:
  static void append_chunk(std::string& file, std::uint32_t type, const std::string& content) {
    append_uint32(file, static_cast<std::uint32_t>(content.size()));
    append_uint32(file, type);
    file += content;
  }

  std::size_t append(const std::string& section, Json object) {
    gltf_[section].push_back(std::move(object));
    return gltf_[section].size() - 1;
  }

  // Everything written since `start` as one accessor over a buffer view of its own.
  Json accessor(std::size_t start, std::size_t count, int component, const char* type, int target) {
    const std::size_t view = append("bufferViews", {{"buffer", 0},
                                                    {"byteOffset", start},
                                                    {"byteLength", bin_.size() - start},
                                                    {"target", target}});
    return {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}};
  }

  std::size_t add_positions(const FeatureMesh& mesh) {
    const std::size_t start = bin_.size();
    Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::max());
    Eigen::Vector3f high = -low;
    for (const Eigen::Vector3d& vertex : mesh.vertices) {
      const Eigen::Vector3f position = (vertex - centre_).cast<float>();
      low = low.cwiseMin(position);
      high = high.cwiseMax(position);
      append_floats(bin_, position);
    }
    Json positions = accessor(start, mesh.vertices.size(), kFloat, "VEC3", kArrayBuffer);
    positions["min"] = to_json(low);
    positions["max"] = to_json(high);
    return append("accessors", std::move(positions));
  }

  std::size_t add_normals(const FeatureMesh& mesh) {
    const std::size_t start = bin_.size();
    const Eigen::Vector3f normal = mesh.plane.normal.cast<float>().normalized();
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) append_floats(bin_, normal);
    return append("accessors", accessor(start, mesh.vertices.size(), kFloat, "VEC3", kArrayBuffer));
  }

  std::size_t add_indices(const FeatureMesh& mesh) {
    const std::size_t start = bin_.size();
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t vertex : triangle) append_uint32(bin_, vertex);
    }
    return append("accessors", accessor(start, 3 * mesh.triangles.size(), kUnsignedInt, "SCALAR",
                                        kElementArrayBuffer));
  }

  std::size_t add_material(const FeatureMesh& mesh) {
    const Json color = {linear_from_srgb(mesh.color[0]), linear_from_srgb(mesh.color[1]),
                        linear_from_srgb(mesh.color[2]), 1.0};
    return append(
        "materials",
        {{"name", to_string(mesh.id)},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", color}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.9}}},
         {"doubleSided", true}});
  }

  std::size_t add_mesh(const FeatureMesh& mesh) {
    Json primitive;
    primitive["attributes"]["POSITION"] = add_positions(mesh);
    primitive["attributes"]["NORMAL"] = add_normals(mesh);
    primitive["indices"] = add_indices(mesh);
    primitive["material"] = add_material(mesh);
    Json object = {{"name", to_string(mesh.id)}};
    object["primitives"].push_back(std::move(primitive));
    return append("meshes", std::move(object));
  }

  Eigen::Vector3d centre_;
  Json gltf_;
  std::string bin_;
};

}  // namespace

std::string to_glb(const MapSnapshot& map) {
  const std::vector<FeatureMesh> meshes = feature_meshes(map.features);
  GlbWriter writer(map, whole_metre_centre(meshes));
  for (const FeatureMesh& mesh : meshes) writer.add(mesh);
  return writer.finish();
}

}  // namespace geomap::mapping
