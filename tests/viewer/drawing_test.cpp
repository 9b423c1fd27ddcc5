// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <imgui.h>

#include <limits>

#include "viewer/drawing_scene.hpp"
#include "viewer/render_points.hpp"
#include "viewer/render_polygons.hpp"
#include "viewer/studio.hpp"

namespace geomap::testing {
namespace {

using viewer::Image;
using viewer::SceneModel;

class Drawing : public Studio {};

std::int64_t uploads_after(const viewer::Painter& painter, std::int64_t before) {
  return painter.uploads() - before;
}

// Pixels of nearly this colour.
int count_of(const Image& image, const viewer::Rgba& color) {
  int count = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    bool is_near = true;
    for (std::size_t c = 0; c < 3; ++c) {
      is_near &= std::abs(image.rgb[i + c] - 255.0 * static_cast<double>(color[c])) < 12.0;
    }
    count += is_near ? 1 : 0;
  }
  return count;
}

TEST_F(Drawing, AnEmptySceneIsOnlyGridAndAxes) {
  const Image all = draw(SceneModel{}, oblique_view());
  only("Grid");
  renderer("Axes").enabled = true;
  EXPECT_EQ(all, draw(SceneModel{}, oblique_view()));
  renderer("Grid").enabled = renderer("Axes").enabled = false;
  EXPECT_NE(all, draw(SceneModel{}, oblique_view()));
}

TEST_F(Drawing, UnchangedLayersAreUploadedOnce) {
  for (const auto& renderer : renderers_) renderer->enabled = true;
  const SceneModel scene = drawing_scene();
  const Image first = draw(scene, oblique_view());
  const std::int64_t before = painter_->uploads();
  EXPECT_GT(before, 0);
  EXPECT_EQ(draw(scene, oblique_view()), first);
  draw(scene, near_view());
  EXPECT_EQ(uploads_after(*painter_, before), 0);
}

TEST_F(Drawing, AChangedPolygonAloneIsUploadedAgain) {
  only("Map polygons");
  SceneModel scene = drawing_scene();
  draw(scene, oblique_view());
  const std::int64_t before = painter_->uploads();
  scene.map.features.at(drawn_id(kTable)).origin[2] += 1000;
  scene.map.stamp = 2;
  draw(scene, oblique_view());
  EXPECT_EQ(uploads_after(*painter_, before), 2);  // its triangles and its outline
}

TEST_F(Drawing, AChangedBlockAloneIsUploadedAgainAndOneThatIsGoneIsDropped) {
  auto& points = dynamic_cast<viewer::RenderPoints&>(only("Point map"));
  SceneModel scene = drawing_scene();
  draw(scene, oblique_view());
  EXPECT_EQ(points.blocks(), scene.points.blocks.size());
  const std::int64_t before = painter_->uploads();
  scene.points.blocks.rbegin()->second.stamp = 2;
  scene.points.blocks.erase(scene.points.blocks.begin());
  scene.points.stamp = 2;
  draw(scene, oblique_view());
  EXPECT_EQ(uploads_after(*painter_, before), 1);
  EXPECT_EQ(points.blocks(), scene.points.blocks.size());
}

TEST_F(Drawing, PointsKeepToTheBudget) {
  only("Point map");
  renderer("Live cloud").enabled = true;
  const SceneModel scene = drawing_scene();
  for (const std::size_t budget : {0U, 100U, 3'000U}) {
    point_budget_ = budget;
    for (const viewer::ViewCamera& camera : {oblique_view(), top_view()}) {
      const std::size_t before = painter_->points_drawn();
      draw(scene, camera);
      const std::size_t drawn = painter_->points_drawn() - before;
      EXPECT_LE(drawn, budget);
      EXPECT_GT(2 * drawn + 100, budget);
    }
  }
}

TEST_F(Drawing, WithEnoughBudgetEveryPointIsDrawn) {
  only("Point map");
  const SceneModel scene = drawing_scene();
  draw(scene, top_view());
  EXPECT_EQ(painter_->points_drawn(), scene.points.points);
}

TEST_F(Drawing, ARoomOneKilometreAwayLooksTheSame) {
  for (const char* name : {"Grid", "Axes"}) renderer(name).enabled = false;
  for (const char* name : {"Live cloud", "Key frame against map"}) renderer(name).enabled = true;
  const Image here = draw(drawing_scene(), oblique_view());
  const Eigen::Vector3d far(1000.0, -800.0, 60.0);
  renderers_ = viewer::make_renderers(painter_);
  for (const char* name : {"Grid", "Axes"}) renderer(name).enabled = false;
  for (const char* name : {"Live cloud", "Key frame against map"}) renderer(name).enabled = true;
  const Image there = draw(drawing_scene(far), oblique_view(far));
  EXPECT_TRUE(looks_alike(difference(here, there, theme_.background)));
}

TEST_F(Drawing, WhatIsAboveAHeightCanBeHidden) {
  only("Point map");
  const SceneModel scene = drawing_scene();
  const Image all = draw(scene, top_view());
  viewer::Preferences preferences;
  preferences.set("Point map.hides_above", true);
  preferences.set("Point map.hide_height", 2.4);
  renderer("Point map").load(preferences);
  const viewer::Rgba white = {0.95F, 0.95F, 0.94F, 1.0F};  // of the ceiling
  EXPECT_GT(count_of(all, white), 1000);
  EXPECT_LT(count_of(draw(scene, top_view()), white), 50);
}

TEST_F(Drawing, AnOutlineIsNotEatenByTheOpaqueFaceItGoesRound) {
  auto& polygons = dynamic_cast<viewer::RenderPolygons&>(only("Map polygons"));
  polygons.opacity = 1.0;
  viewer::Selection selection;
  selection.selected = {drawn_id(kFloor)};
  for (const viewer::ViewCamera& camera : {top_view(), near_view()}) {
    SceneModel scene = drawing_scene();
    std::erase_if(scene.map.features,
                  [](const auto& each) { return each.first != drawn_id(kFloor); });
    ++scene.map.stamp;
    viewer::Viewpoint viewpoint = camera.viewpoint();
    viewpoint.distance = 6.0;
    viewer::ViewCamera whole = camera;
    whole.set(viewpoint);
    EXPECT_GT(count_of(draw(scene, whole, selection), theme_.selected), 1000);
  }
}

TEST_F(Drawing, APointThatIsNoPlaceIsNotDrawn) {
  only("Point map");
  SceneModel scene = drawing_scene();
  const Image without = draw(scene, oblique_view());
  viewer::PointBlock& block = scene.points.blocks.begin()->second;
  auto points = std::make_shared<std::vector<viewer::ScenePoint>>(*block.points);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  points->push_back({.position = {nan, nan, nan}, .color = {255, 0, 255}});
  block.points = points;
  block.stamp = scene.points.stamp = 2;
  EXPECT_EQ(draw(scene, oblique_view()), without);
}

TEST_F(Drawing, AMovedFeatureLeavesAGhostUntilTheMapFollows) {
  auto& polygons = dynamic_cast<viewer::RenderPolygons&>(only("Map polygons"));
  polygons.opacity = 0.1;
  viewer::Selection selection;
  const Image before = draw(drawing_scene(), oblique_view(), selection);
  selection.motions = {{{drawn_id(kTable)}, Eigen::Isometry3d(Eigen::Translation3d(0.5, 0, 0.3))}};
  const Image moving = draw(drawing_scene(), oblique_view(), selection);
  EXPECT_GT(count_of(moving, theme_.ghost), count_of(before, theme_.ghost) + 40);
  selection.motions.front().targets = {drawn_id(kTable), {1, 1}};  // one that there is not
  EXPECT_EQ(draw(drawing_scene(), oblique_view(), selection), moving);
}

TEST_F(Drawing, WhatIsAboutToGoIsAGhost) {
  only("Map polygons");
  viewer::Selection selection;
  const Image before = draw(drawing_scene(), oblique_view(), selection);
  selection.pending = {drawn_id(kTable)};
  const Image going = draw(drawing_scene(), oblique_view(), selection);
  EXPECT_GT(count_of(going, theme_.ghost), count_of(before, theme_.ghost) + 40);
}

TEST_F(Drawing, SelectedAndHoveredFeaturesAreOutlined) {
  only("Map polygons");
  viewer::Selection selection;
  selection.selected = {drawn_id(kTable)};
  selection.hovered = drawn_id(kRamp);
  const Image image = draw(drawing_scene(), oblique_view(), selection);
  EXPECT_GT(count_of(image, theme_.selected), 100);
  EXPECT_GT(count_of(image, theme_.hovered), 60);
}

TEST_F(Drawing, LabelsAreThoseThatAreAskedFor) {
  auto& polygons = dynamic_cast<viewer::RenderPolygons&>(only("Map polygons"));
  const SceneModel scene = drawing_scene();
  const viewer::ViewCamera camera = top_view();
  const viewer::Selection selection;
  const viewer::DrawContext context{scene, camera, selection, theme_, 1.0F, 0};
  const auto texts = [&](viewer::RenderPolygons::Label label) {
    polygons.label = label;
    std::vector<viewer::SceneLabel> labels;
    polygons.add_labels(context, labels);
    std::vector<std::string> words;
    for (const auto& each : labels) words.push_back(each.text);
    return words;
  };
  using Label = viewer::RenderPolygons::Label;
  EXPECT_TRUE(texts(Label::kNone).empty());
  EXPECT_EQ(texts(Label::kLabel), (std::vector<std::string>{"floor", "wall", "ceiling", "table"}));
  EXPECT_EQ(texts(Label::kNumber).back(), "9");
  EXPECT_EQ(texts(Label::kId).front(), to_string(drawn_id(kFloor)));
}

TEST_F(Drawing, SettingsSurviveARestart) {
  auto& polygons = dynamic_cast<viewer::RenderPolygons&>(renderer("Map polygons"));
  polygons.color = viewer::PolygonColor::kAge;
  polygons.label = viewer::RenderPolygons::Label::kNumber;
  polygons.opacity = 0.25;
  viewer::Preferences preferences;
  for (const auto& each : renderers_) each->store(preferences);
  renderers_ = viewer::make_renderers(painter_);
  for (const auto& each : renderers_) each->load(preferences);
  const auto& again = dynamic_cast<viewer::RenderPolygons&>(renderer("Map polygons"));
  EXPECT_EQ(again.color, viewer::PolygonColor::kAge);
  EXPECT_EQ(again.label, viewer::RenderPolygons::Label::kNumber);
  EXPECT_EQ(again.opacity, 0.25);
  viewer::Preferences stored_again;
  for (const auto& each : renderers_) each->store(stored_again);
  EXPECT_EQ(stored_again, preferences);
}

TEST_F(Drawing, SettingsThatAreOutOfRangeOrUnknownDoNotHarm) {
  viewer::Preferences preferences;
  preferences.set("Map polygons.color", std::string("tartan"));
  preferences.set("Map polygons.opacity", 17.0);
  auto& polygons = dynamic_cast<viewer::RenderPolygons&>(renderer("Map polygons"));
  polygons.load(preferences);
  EXPECT_EQ(polygons.color, viewer::PolygonColor::kNormal);
  EXPECT_EQ(polygons.opacity, 1.0);
}

TEST_F(Drawing, EveryPanelCanBeShownAndChangesNothingByItself) {
  ImGui::CreateContext();
  ImGui::GetIO().DisplaySize = {400.0F, 600.0F};
  ImGui::GetIO().IniFilename = nullptr;
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
  ImGui::NewFrame();
  for (const auto& each : renderers_) {
    ImGui::PushID(each->name().c_str());
    EXPECT_FALSE(each->panel()) << each->name();
    ImGui::PopID();
  }
  ImGui::EndFrame();
  ImGui::DestroyContext();
}

}  // namespace
}  // namespace geomap::testing
