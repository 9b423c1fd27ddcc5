// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <imgui.h>

#include <limits>
#include <stdexcept>

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

TEST_F(Drawing, AChangedPolygonAloneIsCutIntoTrianglesAgain) {
  const auto& polygons = dynamic_cast<viewer::RenderPolygons&>(only("Map polygons"));
  SceneModel scene = drawing_scene();
  draw(scene, oblique_view());
  const std::int64_t before = painter_->uploads(), made = polygons.shapes_made();
  EXPECT_EQ(made, static_cast<std::int64_t>(scene.map.features.size()));
  scene.map.stamp = 2;
  draw(scene, oblique_view());
  EXPECT_EQ(uploads_after(*painter_, before), 0);
  scene.map.features.at(drawn_id(kTable)).origin[2] += 1000;
  scene.map.stamp = 3;
  draw(scene, oblique_view());
  EXPECT_EQ(uploads_after(*painter_, before), 1);  // all share a buffer
  EXPECT_EQ(polygons.shapes_made(), made + 1);
}

TEST_F(Drawing, APolygonThatIsGoneIsNotDrawnAndTheOthersKeepTheirColours) {
  only("Map polygons");
  SceneModel scene = drawing_scene();
  draw(scene, oblique_view());
  scene.map.features.erase(drawn_id(kWestWall));
  scene.map.stamp = 2;
  const Image after = draw(scene, oblique_view());
  renderers_ = viewer::make_renderers(painter_);
  only("Map polygons");
  EXPECT_EQ(draw(scene, oblique_view()), after);
}

TEST_F(Drawing, VetoesAreUploadedOnceAndNotAgainWithTheMap) {
  only("Kept-out surfaces");
  SceneModel scene = drawing_scene();
  scene.map.vetoes.resize(50, scene.map.vetoes.front());
  draw(scene, oblique_view());
  EXPECT_EQ(painter_->uploads(), 1);
  scene.map.stamp = 2;
  draw(scene, oblique_view());
  EXPECT_EQ(painter_->uploads(), 1);
  scene.map.vetoes.clear();
  scene.map.veto_stamp = 2;
  EXPECT_EQ(count_of(draw(scene, oblique_view()), theme_.background), 320 * 200);
}

TEST_F(Drawing, APathThatGrowsLooksLikeOneThatCameAtOnce) {
  only("Trajectory");
  const SceneModel whole = drawing_scene();
  SceneModel scene = whole;
  scene.track.poses.clear();
  for (const auto& pose : whole.track.poses) {
    scene.track.poses.push_back(pose);
    ++scene.track.stamp;
    draw(scene, oblique_view());
  }
  const Image grown = draw(scene, oblique_view());
  renderers_ = viewer::make_renderers(painter_);
  only("Trajectory");
  EXPECT_EQ(draw(whole, oblique_view()), grown);
}

// Draws nothing, and fails.
class RenderFailing : public viewer::Renderer {
 public:
  RenderFailing() : Renderer("Failing", true) {}
  int order() const override { return -100; }
  void draw(const viewer::DrawContext&) override { throw std::runtime_error("odd data"); }
};

TEST_F(Drawing, ARendererThatFailsIsNamedAndKeepsNoOtherFromBeingDrawn) {
  const Image before = draw(drawing_scene(), oblique_view());
  EXPECT_TRUE(failures_.empty());
  renderers_.insert(renderers_.begin(), std::make_unique<RenderFailing>());
  EXPECT_EQ(draw(drawing_scene(), oblique_view()), before);
  EXPECT_EQ(failures_, std::vector<std::string>{"Failing: odd data"});
  EXPECT_TRUE(renderers_.front()->enabled);
}

TEST_F(Drawing, WhatIsNowhereOrVeryFarAwayMakesNoRendererFail) {
  for (const auto& each : renderers_) each->enabled = true;
  const SceneModel sound = drawing_scene();
  for (const double value : {std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(), 1.5e5, -1e300}) {
    SceneModel scene = sound;
    geometry::PlanarPolygon odd = scene.planes.planes[1];
    odd.frame.origin.x() = value;
    scene.planes.planes.push_back(odd);
    odd = scene.planes.planes[1];
    odd.frame.x_axis.y() = odd.plane.normal.x() = value;
    scene.planes.planes.push_back(odd);
    scene.planes.planes.push_back({});
    mapping::Veto veto = scene.map.vetoes.front();
    veto.feature.surface.frame.origin.z() = value;
    scene.map.vetoes.push_back(veto);
    scene.map.vetoes.push_back({});
    scene.track.poses[7].T_world_camera.translation().x() = value;
    scene.track.newest->T_world_camera.translation().z() = value;
    scene.frame.T_world_camera->translation().z() = value;
    scene.points.blocks.begin()->second.box.extend(Eigen::Vector3d::Constant(value));
    for (auto& [id, feature] : scene.map.features) {
      if (id == drawn_id(kRamp)) feature.polygon = {};
      if (id == drawn_id(kTable)) feature.origin = {2'000'000'000, -2'000'000'000, 0};
      if (id == drawn_id(kCupboard)) feature.normal = {};
    }
    renderers_ = viewer::make_renderers(painter_);
    for (const auto& each : renderers_) each->enabled = true;
    draw(scene, oblique_view());
    EXPECT_EQ(failures_, std::vector<std::string>{}) << value;
  }
}

TEST_F(Drawing, ManyPolygonsLookAsIfDrawnOneByOne) {
  only("Map polygons");
  SceneModel scene = drawing_scene();
  const mapping::ViewFeature tile = scene.map.features.at(drawn_id(kTable));
  // Where outlines coincide, chance decides which one is in front: there must be no such place.
  std::erase_if(scene.map.features, [](const auto& each) {
    return each.first.plane >= kWestWall && each.first.plane <= kCeiling;
  });
  ++scene.map.stamp;
  // A thousand copies of the table that no one sees, far above the eye, fill the runs.
  const Image alone = draw(scene, oblique_view());
  for (int i = 0; i < 1000; ++i) {
    mapping::ViewFeature copy = tile;
    copy.id = {1, i};
    copy.origin[2] = 1'000'000 + 100 * i;
    scene.map.features.emplace(copy.id, copy);
  }
  ++scene.map.stamp;
  EXPECT_TRUE(looks_alike(difference(draw(scene, oblique_view()), alone, theme_.background)));
}

TEST_F(Drawing, APolygonIsSeenThroughThePointsThatLieOnIt) {
  only("Point map");
  const SceneModel scene = drawing_scene();
  const Image points = draw(scene, oblique_view());
  auto& polygons = dynamic_cast<viewer::RenderPolygons&>(renderer("Map polygons"));
  polygons.enabled = true;
  polygons.opacity = 1.0;
  viewer::Selection selection;
  selection.selected = {drawn_id(kFloor), drawn_id(kTable)};
  const Image both = draw(scene, oblique_view(), selection);
  only("Map polygons");
  const Image alone = draw(scene, oblique_view(), selection);
  EXPECT_FALSE(looks_alike(difference(both, points, theme_.background)));
  // The points scatter by 5 mm, and those of faces that are seen from behind do not count.
  EXPECT_GT(count_of(both, theme_.selected), 6 * count_of(alone, theme_.selected) / 10);
}

TEST_F(Drawing, TheGridLiesAtTheLowestLevelOfAMapThatIsNotAtZero) {
  only("Grid");
  const Eigen::Vector3d below(0.0, 0.0, -1.55);
  const Image at_zero = draw(SceneModel{}, oblique_view());
  EXPECT_EQ(draw(drawing_scene(), oblique_view()), at_zero);
  const Image lowered = draw(drawing_scene(below), oblique_view(below));
  EXPECT_NE(lowered, at_zero);
  viewer::Preferences preferences;
  preferences.set("Grid.at_map", false);
  renderer("Grid").load(preferences);
  EXPECT_EQ(draw(drawing_scene(below), oblique_view()), at_zero);
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
  viewer::Preferences preferences;
  preferences.set("Point map.paleness", 0.0);
  renderer("Point map").load(preferences);
  const Image all = draw(scene, top_view());
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
