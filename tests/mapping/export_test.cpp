// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/export.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "mapping/example_map.hpp"
#include "mapping/export_file.hpp"
#include "mapping/export_glb.hpp"
#include "mapping/export_json.hpp"
#include "mapping/export_mesh.hpp"
#include "mapping/export_obj.hpp"
#include "mapping/export_ply.hpp"

namespace geomap::mapping {
namespace {

using geomap::testing::example_map;
using geomap::testing::fresh_folder;
using geomap::testing::read_file;
using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::array<double, 4> kExampleAreas = {12.0, 0.84, 5.0, 0.3};

double face_area(const FeatureMesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d ab = mesh.vertices[b] - mesh.vertices[a];
    const Eigen::Vector3d ac = mesh.vertices[c] - mesh.vertices[a];
    sum += 0.5 * ab.cross(ac).dot(mesh.plane.normal);  // negative for a clockwise triangle
  }
  return sum;
}

TEST(ExportMesh, FacesHaveTheAreaOfThePolygonAndRunCounterClockwise) {
  const auto meshes = feature_meshes(example_map().features);
  ASSERT_EQ(meshes.size(), 4U);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    EXPECT_NEAR(face_area(meshes[i]), kExampleAreas[i], 1e-9);
    EXPECT_NEAR(meshes[i].area, kExampleAreas[i], 1e-9);
  }
}

TEST(ExportMesh, VerticesLieOnThePlaneEvenWhenTheFrameIsTurnedAgainstIt) {
  MapFeature feature = example_map().features[1];
  const Eigen::Vector3d tilted = Eigen::Vector3d(0.008, -0.003, 1.0).normalized();
  feature.surface.plane = geometry::Plane::through(feature.surface.frame.origin, tilted);
  for (const FeatureMesh& mesh : feature_meshes({&feature, 1})) {
    for (const Eigen::Vector3d& vertex : mesh.vertices) {
      EXPECT_NEAR(feature.surface.plane.signed_distance(vertex), 0.0, 1e-12);
    }
  }
}

TEST(ExportMesh, AFeatureSeenWithoutColourGetsOneOfThePalette) {
  const auto meshes = feature_meshes(example_map().features);
  EXPECT_THAT(meshes[1].color, ElementsAre(120, 61, 30));
  EXPECT_NE(meshes[3].color, (Rgb{0, 0, 0}));
}

TEST(ExportText, ControlCharactersAndBrokenUtf8AreReplaced) {
  EXPECT_EQ(clean_text("a\nb\tc\x7F"), "a b c ");
  EXPECT_EQ(clean_text("Tür ✓"), "Tür ✓");
  EXPECT_EQ(clean_text("\xFFx"), "\xEF\xBF\xBDx");
  EXPECT_EQ(clean_text("\xEF\xBF\xBFx"), "\xEF\xBF\xBDx");
}

TEST(Exports, DoNotDependOnTheOrderOfTheFeatures) {
  const MapSnapshot map = example_map();
  MapSnapshot shuffled = map;
  std::reverse(shuffled.features.begin(), shuffled.features.end());
  EXPECT_EQ(to_ply(map, PlyFormat::kAscii), to_ply(shuffled, PlyFormat::kAscii));
  EXPECT_EQ(to_obj(map, "m.mtl").obj, to_obj(shuffled, "m.mtl").obj);
  EXPECT_EQ(to_glb(map), to_glb(shuffled));
  EXPECT_EQ(to_map_json(map), to_map_json(shuffled));
  EXPECT_EQ(to_svg(map), to_svg(shuffled));
}

TEST(ExportJson, HasTheKeysOfTheSchemaInItsOrder) {
  const auto map = nlohmann::ordered_json::parse(to_map_json(example_map()));
  const auto keys = [](const nlohmann::ordered_json& object) {
    std::vector<std::string> names;
    for (const auto& [key, value] : object.items()) names.push_back(key);
    return names;
  };
  EXPECT_THAT(keys(map), ElementsAre("revision", "hash", "features", "vetoes"));
  ASSERT_EQ(map["features"].size(), 4U);
  EXPECT_THAT(
      keys(map["features"][1]),
      ElementsAre("id", "label", "normal", "d", "area", "observations", "first_utime", "last_utime",
                  "rms", "sigma_angle", "sigma_d", "color", "held", "polygons"));
  EXPECT_THAT(keys(map["features"][1]["polygons"][0]), ElementsAre("outer", "holes"));
}

TEST(ExportJson, HoldsTheValuesToTheLastBit) {
  const Eigen::Vector3d origin(1000.1, -2000.3, 50.7);
  const MapSnapshot snapshot = example_map(origin);
  const json map = json::parse(to_map_json(snapshot));
  EXPECT_EQ(map["revision"], 17);
  EXPECT_EQ(map["hash"], "5eed");
  const json& table = map["features"][1];
  const MapFeature& feature = snapshot.features[1];
  EXPECT_EQ(table["id"], "1000-2");
  EXPECT_EQ(table["label"], "table <A & \"B\">");
  EXPECT_EQ(table["d"].get<double>(), feature.surface.plane.d);
  EXPECT_NEAR(table["area"].get<double>(), 0.84, 1e-12);
  EXPECT_EQ(table["observations"], 3);
  EXPECT_EQ(table["first_utime"], 1000);
  EXPECT_EQ(table["last_utime"], 4000);
  EXPECT_EQ(table["rms"].get<double>(), 0.004);
  EXPECT_EQ(table["sigma_angle"].get<double>(), 0.002);
  EXPECT_EQ(table["sigma_d"].get<double>(), 0.001);
  EXPECT_EQ(table["color"], json({120.0, 60.5, 30.0}));
  const json& corner = table["polygons"][0]["outer"][0];
  const Eigen::Vector3d expected = feature.surface.lift(feature.surface.polygon.parts[0].outer[0]);
  EXPECT_EQ(corner, json({expected.x(), expected.y(), expected.z()}));
  EXPECT_EQ(table["polygons"][0]["holes"].size(), 1U);
  EXPECT_EQ(map["features"][2]["polygons"].size(), 2U);
  EXPECT_TRUE(map["features"][0]["polygons"][0]["holes"].empty());
}

TEST(ExportJson, AnEmptyMapAndABrokenLabelGiveValidJson) {
  EXPECT_TRUE(json::parse(to_map_json({}))["features"].empty());
  MapSnapshot map = example_map();
  map.features[0].label = "\xC3(\n";
  EXPECT_NO_THROW(json::parse(to_map_json(map)));
}

TEST(ExportObj, FacesOfEachNamedObjectHaveTheFeaturesArea) {
  const ObjFiles files = to_obj(example_map({10.0, 20.0, 0.0}), "map.mtl");
  EXPECT_THAT(files.obj, HasSubstr("mtllib map.mtl\n"));
  std::istringstream lines(files.obj);
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::pair<std::string, double>> objects;
  for (std::string key, line; std::getline(lines, line);) {
    std::istringstream words(line);
    words >> key;
    if (key == "o") words >> objects.emplace_back().first;
    if (key == "v") {
      Eigen::Vector3d& v = vertices.emplace_back();
      words >> v.x() >> v.y() >> v.z();
    }
    if (key == "f") {
      std::array<std::size_t, 3> at{};
      for (std::size_t& vertex : at) {
        std::string corner;
        words >> corner;
        vertex = std::stoul(corner) - 1;
        ASSERT_LT(vertex, vertices.size());
      }
      objects.back().second +=
          0.5 * (vertices[at[1]] - vertices[at[0]]).cross(vertices[at[2]] - vertices[at[0]]).norm();
    }
  }
  ASSERT_EQ(objects.size(), 4U);
  EXPECT_EQ(objects[1].first, "1000-2_table_<A_&_\"B\">");
  for (std::size_t i = 0; i < objects.size(); ++i) {
    EXPECT_NEAR(objects[i].second, kExampleAreas[i], 1e-5);
    const std::string material =
        "newmtl " + to_string(feature_meshes(example_map().features)[i].id);
    EXPECT_THAT(files.mtl, HasSubstr(material + "\n"));
  }
}

TEST(ExportObj, IsReadByAssimp) {
  if (!geomap::testing::has_program("assimp")) GTEST_SKIP() << "assimp (assimp-utils) is missing";
  const auto folder = fresh_folder();
  export_map(example_map(), folder / "map.obj");
  EXPECT_EQ(geomap::testing::run_quietly("assimp info '" + (folder / "map.obj").string() + "'"), 0);
}

TEST(ExportMap, WritesWhatTheExtensionSaysInEitherCase) {
  const auto folder = fresh_folder();
  const MapSnapshot map = example_map();
  export_map(map, folder / "map.PLY");
  EXPECT_EQ(read_file(folder / "map.PLY"), to_ply(map, PlyFormat::kBinaryLittleEndian));
  export_map(map, folder / "text.ply", {.ascii = true, .svg = {}});
  EXPECT_EQ(read_file(folder / "text.ply"), to_ply(map, PlyFormat::kAscii));
  export_map(map, folder / "map.glb");
  EXPECT_EQ(read_file(folder / "map.glb"), to_glb(map));
  export_map(map, folder / "map.svg");
  EXPECT_EQ(read_file(folder / "map.svg"), to_svg(map));
  export_map(map, folder / "map.json");
  EXPECT_EQ(read_file(folder / "map.json"), to_map_json(map));
  export_map(map, folder / "map.obj");
  EXPECT_EQ(read_file(folder / "map.obj"), to_obj(map, "map.mtl").obj);
  EXPECT_EQ(read_file(folder / "map.mtl"), to_obj(map, "map.mtl").mtl);
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    EXPECT_NE(entry.path().extension(), ".part");
  }
}

template <typename Action>
std::string message_of(Action&& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(ExportMap, AnUnknownExtensionIsRefusedWithTheKnownOnes) {
  const auto folder = fresh_folder();
  EXPECT_THROW(export_map(example_map(), folder / "map.stl"), std::invalid_argument);
  EXPECT_THROW(export_map(example_map(), folder / "map"), std::invalid_argument);
  EXPECT_THAT(message_of([&] { export_map(example_map(), folder / "map.stl"); }),
              HasSubstr("'.stl'; known extensions: .ply, .obj, .glb, .svg, .json"));
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  EXPECT_THROW(check_extension("map.stl"), std::invalid_argument);
  EXPECT_NO_THROW(check_extension("map.Glb"));
}

TEST(ExportMap, APathThatCannotBeWrittenIsNamedWithTheReason) {
  const auto path = fresh_folder() / "missing" / "map.ply";
  EXPECT_THAT(message_of([&] { export_map(example_map(), path); }),
              ::testing::AllOf(HasSubstr(path.string()), HasSubstr("No such file or directory")));
}

TEST(ExportMap, AFailedWriteLeavesWhatWasThereAndNoTemporaryFile) {
  const auto folder = fresh_folder();
  std::filesystem::create_directories(folder / "map.ply" / "inside");
  EXPECT_THROW(export_map(example_map(), folder / "map.ply"), std::runtime_error);
  EXPECT_TRUE(std::filesystem::exists(folder / "map.ply" / "inside"));
  EXPECT_FALSE(std::filesystem::exists(folder / "map.ply.part"));
}

TEST(Exports, WhatTheOperatorHoldsAndHasDeletedIsTold) {
  MapSnapshot map = example_map();
  map.features[0].held_by = {3};
  map.vetoes.push_back(
      {.edit = 4, .cause = VetoCause::kDeleted, .feature = map.features[1], .region = {}});
  const json exported = json::parse(to_map_json(map));
  int held = 0;
  for (const json& feature : exported["features"]) held += feature["held"] ? 1 : 0;
  EXPECT_EQ(held, 1);
  ASSERT_EQ(exported["vetoes"].size(), 1U);
  EXPECT_EQ(exported["vetoes"][0]["edit"], 4);
  EXPECT_EQ(exported["vetoes"][0]["feature"], to_string(map.features[1].id));
  EXPECT_FALSE(exported["vetoes"][0]["polygons"].empty());

  const std::string svg = to_svg(map), plain = to_svg(example_map());
  EXPECT_THAT(svg, HasSubstr("stroke-dasharray"));
  EXPECT_THAT(svg, HasSubstr("dashed: deleted"));
  EXPECT_THAT(svg, HasSubstr("bold: held"));
  EXPECT_THAT(plain, ::testing::Not(HasSubstr("stroke-dasharray")));
  EXPECT_THAT(plain, ::testing::Not(HasSubstr("bold: held")));
}

TEST(Exports, MapsWithoutFeaturesOrWithoutAreaAreWritten) {
  MapSnapshot hollow = example_map();
  for (MapFeature& feature : hollow.features) feature.surface.polygon = {};
  for (const MapSnapshot& map : {MapSnapshot{}, hollow}) {
    EXPECT_THAT(to_ply(map, PlyFormat::kAscii), HasSubstr("element face 0\n"));
    EXPECT_THAT(to_obj(map, "m.mtl").obj, ::testing::Not(HasSubstr("\nf ")));
    EXPECT_EQ(json::parse(to_map_json(map))["features"].size(), map.features.size());
    EXPECT_THAT(to_svg(map), HasSubstr("empty map"));
  }
}

}  // namespace
}  // namespace geomap::mapping
