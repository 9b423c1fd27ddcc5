// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/export_glb.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <numbers>

#include "mapping/example_map.hpp"
#include "mapping/export.hpp"

namespace geomap::mapping {
namespace {

using geomap::testing::example_map;
using nlohmann::json;

std::uint32_t uint32_at(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) {
    value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
  }
  return value;
}

// A reader written from the specification, with its demands as expectations.
struct Glb {
  json gltf;
  std::string bin;

  explicit Glb(const std::string& file) {
    EXPECT_EQ(file.substr(0, 4), "glTF");
    EXPECT_EQ(uint32_at(file, 4), 2U);
    EXPECT_EQ(uint32_at(file, 8), file.size());
    const std::size_t json_size = uint32_at(file, 12);
    EXPECT_EQ(json_size % 4, 0U);
    EXPECT_EQ(file.substr(16, 4), "JSON");
    gltf = json::parse(file.substr(20, json_size));
    if (file.size() == 20 + json_size) return;
    const std::size_t bin_at = 20 + json_size;
    const std::size_t bin_size = uint32_at(file, bin_at);
    EXPECT_EQ(bin_size % 4, 0U);
    EXPECT_EQ(file.substr(bin_at + 4, 4), std::string("BIN\0", 4));
    EXPECT_EQ(file.size(), bin_at + 8 + bin_size);
    bin = file.substr(bin_at + 8);
    EXPECT_EQ(gltf["buffers"][0]["byteLength"], bin.size());
  }

  std::vector<std::uint32_t> words(std::size_t accessor, std::size_t components) const {
    const json& description = gltf["accessors"][accessor];
    const json& view = gltf["bufferViews"][description["bufferView"].get<std::size_t>()];
    const std::size_t count = description["count"].get<std::size_t>() * components;
    EXPECT_EQ(view["byteLength"], 4 * count);
    std::vector<std::uint32_t> values;
    for (std::size_t i = 0; i < count; ++i) {
      values.push_back(uint32_at(bin, view["byteOffset"].get<std::size_t>() + 4 * i));
    }
    return values;
  }

  std::vector<Eigen::Vector3f> vectors(std::size_t accessor) const {
    const std::vector<std::uint32_t> raw = words(accessor, 3);
    std::vector<Eigen::Vector3f> points;
    for (std::size_t i = 0; i < raw.size(); i += 3) {
      points.emplace_back(std::bit_cast<float>(raw[i]), std::bit_cast<float>(raw[i + 1]),
                          std::bit_cast<float>(raw[i + 2]));
    }
    return points;
  }

  Eigen::Isometry3d root() const {
    const json& node = gltf["nodes"][gltf["scenes"][0]["nodes"][0].get<std::size_t>()];
    const auto q = node["rotation"].get<std::vector<double>>();  // x, y, z, w
    const auto t = node["translation"].get<std::vector<double>>();
    return Eigen::Translation3d(t[0], t[1], t[2]) * Eigen::Quaterniond(q[3], q[0], q[1], q[2]);
  }
};

json primitive_of(const Glb& glb, std::size_t child) {
  const std::size_t node = glb.gltf["nodes"][0]["children"][child].get<std::size_t>();
  const std::size_t mesh = glb.gltf["nodes"][node]["mesh"].get<std::size_t>();
  return glb.gltf["meshes"][mesh]["primitives"][0];
}

TEST(ExportGlb, EveryFeatureIsANodeWithItsNameAndExtras) {
  const Glb glb(to_glb(example_map()));
  const json& nodes = glb.gltf["nodes"];
  ASSERT_EQ(nodes.size(), 5U);
  EXPECT_EQ(nodes[0]["children"], json({1, 2, 3, 4}));
  EXPECT_EQ(nodes[1]["name"], "1000-0");
  EXPECT_EQ(nodes[2]["name"], "table <A & \"B\">");
  EXPECT_EQ(nodes[2]["extras"]["id"], "1000-2");
  EXPECT_EQ(nodes[2]["extras"]["label"], "table <A & \"B\">");
  EXPECT_EQ(nodes[2]["extras"]["normal"], json({0.0, 0.0, 1.0}));
  EXPECT_NEAR(nodes[2]["extras"]["d"].get<double>(), -0.74, 1e-12);
  EXPECT_NEAR(nodes[2]["extras"]["area"].get<double>(), 0.84, 1e-12);
  EXPECT_EQ(glb.gltf["asset"]["extras"]["revision"], 17);
}

TEST(ExportGlb, AHundredKilometresAwayTheVerticesAreStillGoodToMicrometres) {
  const MapSnapshot map = example_map({60000.25, -80000.5, 120.125});
  const Glb glb(to_glb(map));
  // glTF's y is up: undo that after the root node's own transformation.
  const Eigen::AngleAxisd z_up(std::numbers::pi / 2.0, Eigen::Vector3d::UnitX());
  const geometry::PlanarPolygon& floor = map.features[3].surface;
  std::vector<Eigen::Vector3d> corners;
  const std::size_t positions = primitive_of(glb, 0)["attributes"]["POSITION"].get<std::size_t>();
  for (const Eigen::Vector3f& position : glb.vectors(positions)) {
    corners.push_back(z_up * (glb.root() * position.cast<double>()));
  }
  ASSERT_EQ(corners.size(), 4U);
  for (const geometry::GridPoint vertex : floor.polygon.parts[0].outer) {
    const Eigen::Vector3d expected = floor.lift(vertex);
    EXPECT_TRUE(std::any_of(corners.begin(), corners.end(), [&](const Eigen::Vector3d& corner) {
      return (corner - expected).norm() < 2e-6;
    }));
  }
}

TEST(ExportGlb, TheFloorLooksUpInGltfsAxes) {
  const Glb glb(to_glb(example_map()));
  const std::size_t normals = primitive_of(glb, 0)["attributes"]["NORMAL"].get<std::size_t>();
  const Eigen::Vector3d up = glb.root().linear() * glb.vectors(normals).front().cast<double>();
  EXPECT_LT((up - Eigen::Vector3d::UnitY()).norm(), 1e-12);
}

TEST(ExportGlb, TrianglesAddUpToTheAreaAndPositionsKeepToTheirBounds) {
  const Glb glb(to_glb(example_map({5.0, 6.0, 7.0})));
  const std::vector<double> areas = {12.0, 0.84, 5.0, 0.3};
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const json primitive = primitive_of(glb, i);
    const std::size_t accessor = primitive["attributes"]["POSITION"].get<std::size_t>();
    const std::vector<Eigen::Vector3f> points = glb.vectors(accessor);
    const std::vector<std::uint32_t> indices =
        glb.words(primitive["indices"].get<std::size_t>(), 1);
    double area = 0.0;
    for (std::size_t k = 0; k < indices.size(); k += 3) {
      const Eigen::Vector3f& a = points.at(indices[k]);
      area +=
          0.5 * static_cast<double>(
                    (points.at(indices[k + 1]) - a).cross(points.at(indices[k + 2]) - a).norm());
    }
    EXPECT_NEAR(area, areas[i], 1e-5);
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& point : points) box.extend(point);
    const json& bounds = glb.gltf["accessors"][accessor];
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(bounds["min"][static_cast<std::size_t>(axis)].get<float>(), box.min()[axis]);
      EXPECT_EQ(bounds["max"][static_cast<std::size_t>(axis)].get<float>(), box.max()[axis]);
    }
  }
}

TEST(ExportGlb, MaterialsAreDoubleSidedAndLinear) {
  const Glb glb(to_glb(example_map()));
  const json& material = glb.gltf["materials"][1];
  EXPECT_EQ(material["doubleSided"], true);
  const auto color = material["pbrMetallicRoughness"]["baseColorFactor"].get<std::vector<double>>();
  // 120 of 255 in sRGB is 18.8 % of the light.
  EXPECT_NEAR(color[0], 0.1878, 1e-4);
  EXPECT_EQ(color[3], 1.0);
}

TEST(ExportGlb, LeavesOutWhatGltfForbidsToBeEmpty) {
  const Glb empty(to_glb({}));
  for (const char* key : {"meshes", "accessors", "bufferViews", "buffers", "materials"}) {
    EXPECT_FALSE(empty.gltf.contains(key)) << key;
  }
  EXPECT_FALSE(empty.gltf["nodes"][0].contains("children"));

  MapSnapshot map = example_map();
  map.features[3].surface.polygon = {};  // the floor
  const Glb glb(to_glb(map));
  EXPECT_FALSE(glb.gltf["nodes"][1].contains("mesh"));
  EXPECT_EQ(glb.gltf["nodes"][1]["extras"]["id"], "1000-0");
  EXPECT_EQ(glb.gltf["meshes"].size(), 3U);
}

TEST(ExportGlb, IsReadByAssimp) {
  if (!geomap::testing::has_program("assimp")) GTEST_SKIP() << "assimp (assimp-utils) is missing";
  const auto folder = geomap::testing::fresh_folder();
  const std::string glb = (folder / "map.glb").string();
  const std::string report = (folder / "report.txt").string();
  export_map(example_map({1000.0, 0.0, 0.0}), glb);
  ASSERT_EQ(std::system(("assimp info '" + glb + "' >'" + report + "' 2>&1").c_str()), 0);
  const std::string text = geomap::testing::read_file(report);
  EXPECT_THAT(text, ::testing::ContainsRegex("Meshes: +4"));
  EXPECT_THAT(text, ::testing::ContainsRegex("Nodes: +5"));
  EXPECT_THAT(text, ::testing::ContainsRegex("Primitive Types: +triangles"));
}

}  // namespace
}  // namespace geomap::mapping
