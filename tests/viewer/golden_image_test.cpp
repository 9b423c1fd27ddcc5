// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "viewer/drawing_scene.hpp"
#include "viewer/render_points.hpp"
#include "viewer/render_polygons.hpp"
#include "viewer/studio.hpp"

namespace geomap::testing {
namespace {

using viewer::Image;

class GoldenImage : public Studio {
 protected:
  // Everything but what the robot sees at the moment, with the table selected. Without the grid,
  // whose many shades would double the size of the files.
  Image map_picture(const viewer::ViewCamera& camera,
                    const viewer::SceneModel& scene = drawing_scene()) {
    for (const char* name : {"Key frame planes", "Point map", "Grid"})
      renderer(name).enabled = false;
    viewer::Selection selection;
    selection.selected = {drawn_id(kTable)};
    return draw(scene, camera, selection);
  }
  // Of the map from above, whose picture it should not be.
  bool looks_like_the_map(const Image& image) {
    return looks_alike(difference_from_golden("map_oblique", image, theme_.background));
  }
};

TEST_F(GoldenImage, TheMapFromAbove) {
  EXPECT_TRUE(is_golden("map_oblique", map_picture(oblique_view()), theme_.background));
}

TEST_F(GoldenImage, TheMapStraightDown) {
  EXPECT_TRUE(is_golden("map_top", map_picture(top_view()), theme_.background));
}

TEST_F(GoldenImage, TheMapFromNear) {
  EXPECT_TRUE(is_golden("map_near", map_picture(near_view()), theme_.background));
}

TEST_F(GoldenImage, TheMapOnLightGround) {
  theme_ = viewer::light_theme();
  EXPECT_TRUE(is_golden("map_light", map_picture(oblique_view()), theme_.background));
}

TEST_F(GoldenImage, EverythingAtOnce) {
  for (const auto& renderer : renderers_) renderer->enabled = true;
  renderer("Grid").enabled = false;
  viewer::Preferences preferences;
  preferences.set("Point map.hides_above", true);
  preferences.set("Point map.size", 1.0);
  renderer("Point map").load(preferences);
  const Image image = draw(drawing_scene(), oblique_view());
  EXPECT_TRUE(is_golden("everything", image, theme_.background));
}

TEST_F(GoldenImage, EachRendererAlone) {
  const std::vector<std::pair<std::string, std::string>> all = {
      {"Map polygons", "polygons"},
      {"Kept-out surfaces", "kept_out"},
      {"Point map", "points"},
      {"Live cloud", "cloud"},
      {"Key frame planes", "planes"},
      {"Key frame against map", "deviation"},
      {"Camera", "camera"},
      {"Trajectory", "trajectory"},
      {"Robot", "robot"},
      {"Grid", "grid"},
      {"Axes", "axes"}};
  ASSERT_EQ(all.size(), renderers_.size());
  for (const auto& [name, file] : all) {
    only(name);
    const Image image = draw(drawing_scene(), oblique_view());
    EXPECT_TRUE(is_golden("alone_" + file, image, theme_.background));
  }
}

TEST_F(GoldenImage, EveryColourOfPolygons) {
  auto& polygons = dynamic_cast<viewer::RenderPolygons&>(only("Map polygons"));
  for (const auto& [color, file] : {std::pair(viewer::PolygonColor::kAsSeen, "as_seen"),
                                    {viewer::PolygonColor::kId, "id"},
                                    {viewer::PolygonColor::kLabel, "label"},
                                    {viewer::PolygonColor::kAge, "age"},
                                    {viewer::PolygonColor::kWeight, "weight"}}) {
    polygons.color = color;
    const Image image = draw(drawing_scene(), oblique_view());
    EXPECT_TRUE(is_golden(std::string("color_") + file, image, theme_.background));
  }
}

TEST_F(GoldenImage, AMovedTableWithItsGhostAndACupboardThatGoes) {
  only("Map polygons");
  viewer::Selection selection;
  selection.selected = {drawn_id(kTable)};
  selection.pending = {drawn_id(kCupboard)};
  selection.motions = {
      {{drawn_id(kTable)}, Eigen::Isometry3d(Eigen::Translation3d(0.9, -0.7, 0.4))}};
  const Image image = draw(drawing_scene(), oblique_view(), selection);
  EXPECT_TRUE(is_golden("ghosts", image, theme_.background));
}

TEST_F(GoldenImage, AShiftedCameraIsAnotherPicture) {
  viewer::Viewpoint shifted = oblique_view().viewpoint();
  shifted.target.x() += 0.06;
  viewer::ViewCamera camera = oblique_view();
  camera.set(shifted);
  EXPECT_FALSE(looks_like_the_map(map_picture(camera)));
}

TEST_F(GoldenImage, AMissingPolygonIsAnotherPicture) {
  viewer::SceneModel scene = drawing_scene();
  scene.map.features.erase(drawn_id(kRamp));
  EXPECT_FALSE(looks_like_the_map(map_picture(oblique_view(), scene)));
}

TEST_F(GoldenImage, SwappedColoursAreAnotherPicture) {
  Image image = map_picture(oblique_view());
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) std::swap(image.rgb[i], image.rgb[i + 2]);
  EXPECT_FALSE(looks_like_the_map(image));
}

TEST_F(GoldenImage, APictureOfAnotherSizeIsAnotherPicture) {
  EXPECT_FALSE(looks_like_the_map({.width = 2, .height = 1, .rgb = {0, 0, 0, 0, 0, 0}}));
}

}  // namespace
}  // namespace geomap::testing
