// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/scene.hpp"

#include <cmath>
#include <fstream>
#include <numbers>

#include "drivers/data_set_writer.hpp"
#include "drivers/frame_source.hpp"
#include "drivers/scene_file.hpp"

namespace geomap::drivers {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;

double area_of(const Scene& scene, const std::string& surface) {
  double area = 0.0;
  for (const Scene::Triangle& triangle : scene.triangles) {
    if (scene.surfaces[triangle.surface].name != surface) continue;
    const auto& [a, b, c] = triangle.vertices;
    area +=
        0.5 *
        (scene.vertices[b] - scene.vertices[a]).cross(scene.vertices[c] - scene.vertices[a]).norm();
  }
  return area;
}

class SceneFile : public ::testing::Test {
 protected:
  Scene read(const std::string& text) {
    std::ofstream(file()) << text;
    return read_scene(file());
  }
  std::string error_of(const std::string& text) {
    try {
      read(text);
    } catch (const SourceError& error) {
      return error.what();
    }
    return "no error";
  }
  std::filesystem::path file() const { return folder_.path() / "scene.yaml"; }

  testing::TemporaryFolder folder_;
};

TEST_F(SceneFile, ARectangleWithOpeningsHasTheAreaThatIsLeft) {
  const Scene scene = read(
      "name: s\nrectangles:\n"
      "  - {name: wall, corner: [1, 0, 0], u: [0, 4, 0], v: [0, 0, 3],\n"
      "     openings: [{u: [1, 2], v: [0, 2]}, {u: [2.5, 3.5], v: [1, 2]}]}\n");
  EXPECT_NEAR(area_of(scene, "wall"), 12.0 - 2.0 - 1.0, 1e-12);
  EXPECT_NEAR(geometry::area(outline_of(scene.faces.at(0))), 9.0, 1e-9);
  EXPECT_EQ(outline_of(scene.faces[0]).parts.at(0).holes.size(), 1U);
}

TEST_F(SceneFile, ABoxHasTheFacesAskedForWithNormalsOutwards) {
  const Scene scene = read(
      "name: s\nboxes:\n"
      "  - {name: b, position: [1, 2, 3], yaw_deg: 30, size: [0.6, 2.4, 0.9],\n"
      "     faces: front left right top}\n");
  std::vector<std::string> names;
  for (const SceneSurface& surface : scene.surfaces) names.push_back(surface.name);
  EXPECT_THAT(names, ElementsAre("b_front", "b_left", "b_right", "b_top"));
  EXPECT_NEAR(area_of(scene, "b_front"), 2.4 * 0.9, 1e-12);
  EXPECT_NEAR(area_of(scene, "b_left"), 0.6 * 0.9, 1e-12);
  EXPECT_NEAR(area_of(scene, "b_top"), 0.6 * 2.4, 1e-12);
  for (const SceneFace& face : scene.faces) {
    const Eigen::Vector3d middle = face.corner + 0.5 * face.u + 0.5 * face.v;
    const Eigen::Vector3d outwards = middle - Eigen::Vector3d(1.0, 2.0, 3.45);
    EXPECT_GT(face.u.cross(face.v).dot(outwards), 0.0);
  }
  const double c = std::cos(std::numbers::pi / 6.0);
  EXPECT_NEAR(scene.faces[0].u.cross(scene.faces[0].v).normalized().x(), -c, 1e-12);
}

TEST_F(SceneFile, RoundShapesHaveTheirAreas) {
  const Scene scene = read(
      "name: s\ncylinders:\n  - {name: can, position: [0, 0, 1], radius: 0.5, height: 2}\n"
      "  - {name: cone, position: [0, 0, 0], radius: 1, top_radius: 0.5, height: 1}\n"
      "spheres:\n  - {name: ball, position: [0, 0, 1], radius: 0.5}\n"
      "  - {name: bowl, position: [0, 0, 1], radius: 0.5, cut: 0}\n");
  const double pi = std::numbers::pi;
  EXPECT_NEAR(area_of(scene, "can"), 2.0 * pi * 0.5 * 2.0 + 2.0 * pi * 0.25, 0.005);
  EXPECT_NEAR(area_of(scene, "cone"), pi * 1.5 * std::hypot(1.0, 0.5) + pi * 1.25, 0.01);
  EXPECT_NEAR(area_of(scene, "ball"), 4.0 * pi * 0.25, 0.005);
  EXPECT_NEAR(area_of(scene, "bowl"), 2.0 * pi * 0.25, 0.005);
  EXPECT_TRUE(scene.faces.empty());
}

TEST_F(SceneFile, AMeshIsScaledTurnedAndMoved) {
  std::ofstream(folder_.path() / "m.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const Scene scene = read(
      "name: s\nmeshes:\n"
      "  - {name: m, file: m.obj, position: [1, 2, 3], yaw_deg: 90, scale: 2}\n");
  ASSERT_EQ(scene.triangles.size(), 1U);
  EXPECT_NEAR(area_of(scene, "m"), 2.0, 1e-6);
  EXPECT_LT((scene.vertices[1] - Eigen::Vector3d(1.0, 4.0, 3.0)).norm(), 1e-6);
}

TEST_F(SceneFile, WhatIsWrongIsNamedWithItsLine) {
  EXPECT_THAT(error_of("name: s\nboxs: []\n"), HasSubstr("scene.yaml:2: unknown key 'boxs'"));
  EXPECT_THAT(error_of("name: s\n"), HasSubstr("the scene is empty"));
  EXPECT_THAT(error_of("boxes: []\n"), HasSubstr("'name' is missing"));
  EXPECT_THAT(error_of("name: [\n"), HasSubstr("not YAML"));
  EXPECT_THAT(error_of("name: s\nboxes:\n  - {name: b, position: [0, 0], size: [1, 1, 1]}\n"),
              HasSubstr("scene.yaml:3: 'position' must be a list of 3 numbers"));
  EXPECT_THAT(error_of("name: s\nboxes:\n  - {name: b, position: [0, 0, 0], size: [1, 1, -1]}\n"),
              HasSubstr("'size' must be above 0"));
  EXPECT_THAT(error_of("name: s\nboxes:\n  - {name: b, position: [0, 0, 0], size: [1, 1, 1],\n"
                       "     faces: front side}\n"),
              HasSubstr("not 'side'"));
  EXPECT_THAT(error_of("name: s\nrectangles:\n  - {name: r, corner: [0, 0, 0], u: [1, 0, 0],\n"
                       "     v: [0.1, 1, 0]}\n"),
              HasSubstr("at right angles"));
  EXPECT_THAT(error_of("name: s\nrectangles:\n  - {name: r, corner: [0, 0, 0], u: [1, 0, 0],\n"
                       "     v: [0, 1, 0], openings: [{u: [0, 1], v: [0.4, 0.6]}]}\n"),
              HasSubstr("several pieces"));
  EXPECT_THAT(error_of("name: s\nspheres:\n  - {name: a, position: [0, 0, 0], radius: nan}\n"),
              HasSubstr("'radius' must be a number"));
  EXPECT_THAT(error_of("name: s\nspheres:\n  - {name: a, position: [0, 0, 0], radius: 1}\n"
                       "  - {name: a, position: [0, 0, 0], radius: 1}\n"),
              HasSubstr("'a' is given twice"));
  EXPECT_THAT(error_of("name: s\nmeshes:\n  - {name: m, file: none.obj, position: [0, 0, 0]}\n"),
              HasSubstr("none.obj"));
  std::filesystem::remove(file());
  EXPECT_THROW(read_scene(file()), SourceError);
}

TEST(Scenes, AllThatAreShippedCanBeRead) {
  int scenes = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(GEOMAP_SOURCE_DIR) + "/config/scenes")) {
    if (entry.path().extension() != ".yaml") continue;
    ++scenes;
    EXPECT_THAT(entry.path().stem().string(), ::testing::Eq(read_scene(entry.path()).name));
  }
  EXPECT_GE(scenes, 5);
}

TEST(Scenes, TheKitchenHasSevenPlanes) {
  const Scene scene = read_scene(std::string(GEOMAP_SOURCE_DIR) + "/config/scenes/kitchen.yaml");
  EXPECT_EQ(scene.faces.size(), 7U);
}

}  // namespace
}  // namespace geomap::drivers
