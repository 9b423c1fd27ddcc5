// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/viewer_core.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <memory>
#include <numbers>

#include "viewer/fake_source.hpp"
#include "viewer/offscreen_viewer.hpp"

namespace geomap::viewer {
namespace {

using mapping::EditKind;
using mapping::FeatureId;
using ::testing::ElementsAre;
using testing::FakeSource;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::rectangle_feature;
using ::testing::SizeIs;

constexpr int kWidth = 1280, kHeight = 800;
const FeatureId kFloor{1'000'001, 0}, kTable{1'000'002, 0};

/// The whole window over two polygons, seen from above, with mouse and keys of the test's own.
class WholeWindow : public ::testing::Test {
 protected:
  void SetUp() override {
    source_ = new FakeSource;
    source_->put(rectangle_feature(1, {0, 0, 0}, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(),
                                   6.0, 4.0));
    source_->put(rectangle_feature(2, {1, 0, 0.8}, Eigen::Vector3d::UnitZ(),
                                   Eigen::Vector3d::UnitX(), 1.0, 1.0));
    std::unique_ptr<MapSource> source(source_);
    try {
      window_ =
          std::make_unique<OffscreenViewer>(std::move(source), Preferences(), kWidth, kHeight, 1.0);
    } catch (const std::runtime_error& error) {
      GTEST_SKIP() << error.what();
    }
    ImGuiIO& io = ImGui::GetIO();
    io.KeyMap[ImGuiKey_Escape] = GLFW_KEY_ESCAPE;
    io.KeyMap[ImGuiKey_Enter] = GLFW_KEY_ENTER;
    io.KeyMap[ImGuiKey_Backspace] = GLFW_KEY_BACKSPACE;
    window_->wait_for_scene(0.0, 1.0);
    frames(2);
    app().view.camera().set({{0, 0, 0},
                             6.0,
                             -std::numbers::pi / 2.0,
                             std::numbers::pi / 2.0,
                             Projection::kOrthographic});
    frames(2);
  }

  App& app() { return window_->app(); }
  void frames(int count) {
    for (int i = 0; i < count; ++i) {
      window_->core().update(Clock::now());
      window_->draw();
    }
  }
  void point_at(const Eigen::Vector3d& point) {
    const Eigen::Vector2d pixel = *app().view.camera().project(point);
    ImGui::GetIO().MousePos = {250.0F + static_cast<float>(pixel.x()),
                               40.0F + static_cast<float>(pixel.y())};
    frames(2);
  }
  void click(const Eigen::Vector3d& point, bool control = false) {
    point_at(point);
    ImGui::GetIO().KeyCtrl = control;
    ImGui::GetIO().MouseDown[0] = true;
    frames(1);
    ImGui::GetIO().MouseDown[0] = false;
    frames(1);
    ImGui::GetIO().KeyCtrl = false;
    for (int i = 0; i < 20; ++i) frames(1);  // so that the next one is no double click
  }
  void press(int key, bool control = false) {
    ImGuiIO& io = ImGui::GetIO();
    io.KeyCtrl = control;
    window_->core().press({key, control, false});
    io.KeysDown[key] = true;
    frames(1);
    io.KeysDown[key] = false;
    io.KeyCtrl = false;
    frames(1);
  }
  std::vector<EditKind> asked() const {
    std::vector<EditKind> kinds;
    for (const auto& command : source_->commands) kinds.push_back(command.kind);
    return kinds;
  }

  FakeSource* source_ = nullptr;
  std::unique_ptr<OffscreenViewer> window_;
};

TEST_F(WholeWindow, AClickSelectsAndDelDeletes) {
  click({1, 0, 0.8});
  EXPECT_THAT(app().workbench.selected(), ElementsAre(kTable));
  press(GLFW_KEY_DELETE);
  ASSERT_THAT(asked(), ElementsAre(EditKind::kDelete));
  EXPECT_THAT(source_->commands[0].targets, ElementsAre(kTable));
  press(GLFW_KEY_Z, true);
  press(GLFW_KEY_Y, true);
  EXPECT_THAT(asked(), ElementsAre(EditKind::kDelete, EditKind::kUndo, EditKind::kRedo));
}

TEST_F(WholeWindow, DeletingMoreThanOneIsAskedForOnce) {
  click({-2, 0, 0});
  click({1, 0, 0.8}, true);
  EXPECT_THAT(app().workbench.selected(), SizeIs(2));
  press(GLFW_KEY_DELETE);
  EXPECT_THAT(asked(), IsEmpty());
  frames(3);
  press(GLFW_KEY_ESCAPE);
  frames(2);
  EXPECT_THAT(asked(), IsEmpty()) << "left";
  press(GLFW_KEY_DELETE);
  frames(3);
  press(GLFW_KEY_ENTER);
  EXPECT_THAT(asked(), ElementsAre(EditKind::kDelete));
}

TEST_F(WholeWindow, AMotionIsTriedThenAskedForByEnter) {
  click({-2, 0, 0});
  press(GLFW_KEY_M);
  ASSERT_EQ(app().tool, &app().move);
  app().move.set({{0.2, 0, 0}, {}});
  frames(2);
  press(GLFW_KEY_ENTER);
  ASSERT_THAT(asked(), ElementsAre(EditKind::kMove));
  EXPECT_NEAR(source_->commands[0].T_world_moved.translation().z(), 0.2, 1e-9);
  EXPECT_EQ(app().tool, nullptr);
}

TEST_F(WholeWindow, AnotherSelectionEndsAMotionThatWasTried) {
  click({-2, 0, 0});
  press(GLFW_KEY_M);
  app().move.set({{0.2, 0, 0}, {}});
  app().workbench.select({kTable});
  frames(2);
  EXPECT_EQ(app().tool, nullptr);
  EXPECT_THAT(app().workbench.selection().motions, IsEmpty());
}

TEST_F(WholeWindow, ADoubleClickFliesThere) {
  const Eigen::Vector3d before = app().view.camera().viewpoint().target;
  click({-2, 1, 0});
  ImGui::GetIO().MouseDoubleClickTime = 1e3F;  // however long a frame takes
  click({-2, 1, 0});
  app().view.land();
  EXPECT_LT((app().view.camera().viewpoint().target - Eigen::Vector3d(-2, 1, 0)).norm(), 0.1);
  EXPECT_GT((app().view.camera().viewpoint().target - before).norm(), 1.0);
}

TEST_F(WholeWindow, KeysThatComeWithinOneFrameAllCount) {
  for (int i = 0; i < 5; ++i) window_->core().press({GLFW_KEY_Z, true, false});
  frames(1);
  EXPECT_THAT(asked(), SizeIs(5));
}

TEST_F(WholeWindow, WhatIsHeldIsNotDeletedWithoutAQuestion) {
  mapping::ViewFeature feature = source_->features.at(kTable);
  feature.locked = true;
  source_->put(feature);
  frames(1);
  app().workbench.select({kTable});
  press(GLFW_KEY_DELETE);
  EXPECT_THAT(asked(), IsEmpty());
  EXPECT_EQ(app().dialog, Dialog::kConfirmDelete);
}

TEST_F(WholeWindow, EditsOfASavedMapAreNotLostWithoutAQuestion) {
  click({-2, 0, 0});
  press(GLFW_KEY_K);
  source_->outcomes = {{source_->commands.back().command, true, "edit 1", 1, 1}};
  frames(1);
  press(GLFW_KEY_Q, true);
  EXPECT_FALSE(app().wants_quit);
  EXPECT_EQ(app().dialog, Dialog::kQuit);
  press(GLFW_KEY_ESCAPE);
  frames(2);
  app().ask(Dialog::kSave, "map");
  app().save();
  source_->outcomes = {{77, true, "saved", 0, 0}};
  frames(1);
  press(GLFW_KEY_Q, true);
  EXPECT_TRUE(app().wants_quit);
}

TEST_F(WholeWindow, FromTheRobotsEyeIsRefusedWhileItIsNotKnownWhereThatIs) {
  press(GLFW_KEY_V);
  EXPECT_FALSE(app().view.is_first_person());
  EXPECT_THAT(app().workbench.notices().back().text, HasSubstr("has not told"));
}

TEST_F(WholeWindow, EscapeLeavesTheToolThenTheSelection) {
  click({-2, 0, 0});
  press(GLFW_KEY_S);
  EXPECT_EQ(app().tool, &app().split);
  press(GLFW_KEY_ESCAPE);
  EXPECT_EQ(app().tool, nullptr);
  EXPECT_THAT(app().workbench.selected(), SizeIs(1));
  press(GLFW_KEY_ESCAPE);
  EXPECT_THAT(app().workbench.selected(), IsEmpty());
  EXPECT_THAT(asked(), IsEmpty());
}

TEST_F(WholeWindow, AToolWithoutItsPolygonSaysWhatIsMissing) {
  app().start(app().split);
  EXPECT_EQ(app().tool, nullptr);
  EXPECT_THAT(app().workbench.notices().back().text, HasSubstr("select one polygon"));
}

TEST_F(WholeWindow, WhatIsDrawnChangesWithTheHelpThePanelsAndTheTheme) {
  const Image before = window_->image();
  press(GLFW_KEY_F1);
  frames(2);
  const Image with_help = window_->image();
  EXPECT_NE(before, with_help);
  press(GLFW_KEY_ESCAPE);
  press(GLFW_KEY_TAB);
  frames(2);
  EXPECT_NE(before, window_->image());
  press(GLFW_KEY_TAB);
  press(GLFW_KEY_F10);
  frames(2);
  EXPECT_NE(before, window_->image());
}

TEST_F(WholeWindow, TheNewestPictureIsShownThoughNobodyKnowsWhereItWasTaken) {
  const auto count = [](const Image& image) {
    int pixels = 0;
    for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3) {
      pixels += image.rgb[i] == 255 && image.rgb[i + 1] == 0 && image.rgb[i + 2] == 255;
    }
    return pixels;
  };
  EXPECT_EQ(count(window_->image()), 0);
  auto frame = std::make_shared<geometry::RgbdFrame>();
  frame->depth_camera = frame->color_camera = {40, 30, 35, 35, 20, 15};
  frame->depth = {40, 30, std::vector<std::uint16_t>(1200, 1000)};
  frame->color = {40, 30, {}};
  for (int i = 0; i < 1200; ++i) {
    frame->color.rgb.insert(frame->color.rgb.end(),
                            {std::uint8_t{255}, std::uint8_t{0}, std::uint8_t{255}});
  }
  source_->newest = frame;
  source_->is_changed = true;
  frames(2);
  EXPECT_GT(count(window_->image()), 5000);
}

TEST_F(WholeWindow, TextsOfTheMapAreShownAsTheyAreWhateverIsInThem) {
  for (const char* label : {"%s%s%n", "##", "", "###x", "{}", "äöü"}) {
    mapping::ViewFeature feature = source_->features.at(kTable);
    feature.label = label;
    source_->put(feature);
    source_->entries = {
        {1, 1, label, label, EditKind::kLabel, HistoryEntry::State::kIdle, label, true}};
    source_->outcomes = {{5, false, label, 0, 0}};
    app().workbench.select({kTable});
    frames(3);
  }
  EXPECT_THAT(app().workbench.selected(), ElementsAre(kTable));
}

TEST_F(WholeWindow, ThousandsOfPolygonsAreListedAndDrawn) {
  for (int i = 10; i < 3000; ++i) {
    source_->put(rectangle_feature(i, {0.01 * i, 0.5, 0.1}, Eigen::Vector3d::UnitZ(),
                                   Eigen::Vector3d::UnitX(), 0.3, 0.3));
  }
  frames(2);
  EXPECT_THAT(app().workbench.surfaces().surfaces(), SizeIs(2992));
}

TEST_F(WholeWindow, TheEyeStaysWhereTheOperatorPutIt) {
  press(GLFW_KEY_HOME);
  for (int i = 0; i < 200 && app().view.is_flying(); ++i) frames(1);
  app().view.land();
  const Viewpoint chosen = app().view.camera().viewpoint();
  source_->put(rectangle_feature(3, {30, 0, 0}, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(),
                                 9.0, 9.0));
  frames(3);
  EXPECT_EQ(app().view.camera().viewpoint(), chosen);
}

}  // namespace
}  // namespace geomap::viewer
