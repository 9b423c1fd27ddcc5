// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/workbench.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/axes.hpp"
#include "viewer/draw_tool.hpp"
#include "viewer/fake_source.hpp"
#include "viewer/move_tool.hpp"
#include "viewer/select_tool.hpp"
#include "viewer/status_text.hpp"

namespace geomap::viewer {
namespace {

using mapping::EditKind;
using mapping::FeatureId;
using ::testing::ElementsAre;
using testing::FakeSource;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::rectangle_feature;
using namespace std::chrono_literals;

const FeatureId kFloor{1'000'001, 0}, kWall{1'000'002, 0};
using geomap::testing::kX, geomap::testing::kY, geomap::testing::kZ;

class Bench : public ::testing::Test {
 protected:
  Bench() : source_(new FakeSource), bench_(std::unique_ptr<MapSource>(source_)) {
    source_->put(rectangle_feature(1, {0, 0, 0}, kZ, kX, 6.0, 4.0));
    source_->put(rectangle_feature(2, {3.0, 0, 1.0}, -kX, kY, 4.0, 2.0));
    bench_.update(now_);
    camera_.resize(800, 600);
    camera_.set({{0, 0, 0}, 8.0, -2.5, 0.7, Projection::kPerspective});
  }
  void answer(bool is_done, const std::string& text, std::int64_t revision = 2) {
    source_->outcomes = {{source_->commands.back().command, is_done, text, 1, revision}};
    bench_.update(now_);
  }
  PointerEvent at(const Eigen::Vector3d& point) const {
    PointerEvent event;
    event.pixel = *camera_.project(point);
    return event;
  }

  Clock::time_point now_ = Clock::now();
  FakeSource* source_;
  Workbench bench_;
  ViewCamera camera_;
};

TEST_F(Bench, AnEditSpeaksOfWhatIsSelectedAndIsNumbered) {
  bench_.select({kFloor, kWall});
  bench_.label("room");
  bench_.undo();
  ASSERT_EQ(source_->commands.size(), 2U);
  EXPECT_EQ(source_->commands[0].kind, EditKind::kLabel);
  EXPECT_EQ(source_->commands[0].label, "room");
  EXPECT_THAT(source_->commands[0].targets, ElementsAre(kFloor, kWall));
  EXPECT_EQ(source_->commands[1].kind, EditKind::kUndo);
  EXPECT_THAT(source_->commands[1].targets, IsEmpty());
  EXPECT_GT(source_->commands[1].command, source_->commands[0].command);
  EXPECT_FALSE(source_->commands[0].author.empty());
}

TEST_F(Bench, AGhostStaysUntilTheMapShowsTheMotion) {
  bench_.select({kFloor});
  bench_.move(Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0.5)));
  ASSERT_EQ(bench_.selection().motions.size(), 1U);
  EXPECT_TRUE(bench_.is_waiting());
  answer(true, "edit 1: move 1 feature", 5);
  EXPECT_EQ(bench_.selection().motions.size(), 1U) << "the map has not come yet";
  EXPECT_FALSE(bench_.is_waiting());
  source_->revision = 5;
  source_->is_changed = true;
  bench_.update(now_);
  EXPECT_THAT(bench_.selection().motions, IsEmpty());
}

TEST_F(Bench, ARefusalIsToldInItsWordsAndTheGhostGoes) {
  bench_.select({kWall});
  bench_.remove();
  EXPECT_THAT(bench_.selection().pending, ElementsAre(kWall));
  answer(false, "there is no such feature");
  EXPECT_THAT(bench_.selection().pending, IsEmpty());
  EXPECT_EQ(bench_.notices().back().text, "there is no such feature");
  EXPECT_EQ(bench_.notices().back().level, Level::kFailing);
}

TEST_F(Bench, AnswersSpeakOfNumbersNotOfIds) {
  bench_.select({kWall});
  bench_.remove();
  answer(false, "1000001-0 and 1000002-0 face 89 degrees apart");
  EXPECT_EQ(bench_.notices().back().text, "#1 and #2 face 89 degrees apart");
}

TEST_F(Bench, WhatIsNoEditIsRefusedBeforeItIsSent) {
  bench_.select({kWall});
  bench_.merge();
  EXPECT_THAT(source_->commands, IsEmpty());
  ASSERT_FALSE(bench_.notices().empty());
  EXPECT_EQ(bench_.notices().back().level, Level::kFailing);
}

TEST_F(Bench, WhatIsGoneIsNoLongerSelectedAndTheRestStays) {
  bench_.select({kFloor, kWall});
  bench_.hover(kWall);
  source_->features.erase(kWall);
  source_->is_changed = true;
  bench_.update(now_);
  EXPECT_THAT(bench_.selected(), ElementsAre(kFloor));
  EXPECT_FALSE(bench_.selection().hovered);
}

TEST_F(Bench, WhatWasDoneToAFeatureIsRemembered) {
  bench_.select({kWall});
  bench_.lock(true);
  answer(true, "edit 1: lock 1 feature");
  EXPECT_THAT(bench_.done_to(kWall), ElementsAre("edit 1: lock 1 feature"));
  EXPECT_THAT(bench_.done_to(kFloor), IsEmpty());
}

TEST_F(Bench, AClickSelectsWithControlOneMoreAndBesideNothing) {
  SelectTool select(bench_);
  select.click(camera_, at({-1, -1, 0}));
  EXPECT_THAT(bench_.selected(), ElementsAre(kFloor));
  PointerEvent more = at({3.0, 0, 1.5});
  more.control = true;
  select.click(camera_, more);
  EXPECT_THAT(bench_.selected(), ElementsAre(kFloor, kWall));
  select.click(camera_, more);
  EXPECT_THAT(bench_.selected(), ElementsAre(kFloor));
  select.click(camera_, at({-9, 9, 0}));
  EXPECT_THAT(bench_.selected(), IsEmpty());
}

TEST_F(Bench, AShiftDragSelectsWhatIsInsideTheRectangle) {
  SelectTool select(bench_);
  PointerEvent event;
  event.shift = true;
  ASSERT_TRUE(select.press(camera_, event));
  event.pixel = {800.0, 600.0};
  select.drag(camera_, event);
  select.release(camera_, event);
  EXPECT_EQ(bench_.selected().size(), 2U);
}

TEST_F(Bench, AnArrowMovesAlongTheNormalAsFarAsTheMouse) {
  bench_.select({kWall});
  MoveTool move(bench_);
  ASSERT_EQ(move.begin(), "");
  const Eigen::Vector3d center(3.0, 0, 1.0), normal = -kX;
  const double pixel = camera_.metres_per_pixel(center);
  const Eigen::Vector3d grip = center + 60.0 * pixel * normal;
  ASSERT_TRUE(move.press(camera_, at(grip)));
  move.drag(camera_, at(grip + 0.4 * normal));
  move.release(camera_, at(grip + 0.4 * normal));
  EXPECT_NEAR(move.numbers().shift[0], 0.4, 1e-3);
  EXPECT_NEAR(move.numbers().shift[1], 0.0, 1e-9);
  ASSERT_EQ(bench_.selection().motions.size(), 1U) << "what is tried is shown";
  EXPECT_THAT(source_->commands, IsEmpty());
  EXPECT_TRUE(move.accept());
  ASSERT_EQ(source_->commands.size(), 1U);
  const Eigen::Vector3d moved = source_->commands[0].T_world_moved * center;
  EXPECT_LT((moved - Eigen::Vector3d(2.6, 0, 1.0)).norm(), 1e-3);
  EXPECT_TRUE(move.is_done());
}

TEST_F(Bench, ARingTurnsByTheAngleThatTheMouseTurns) {
  camera_.set({{0, 0, 0}, 6.0, -2.5, 1.2, Projection::kPerspective});
  bench_.select({kFloor});
  MoveTool move(bench_);
  ASSERT_EQ(move.begin(), "");
  const double radius = 64.0 * camera_.metres_per_pixel(Eigen::Vector3d::Zero());
  const auto on_ring = [&](double angle) {
    return Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), 0.0);
  };
  ASSERT_TRUE(move.press(camera_, at(on_ring(0.7))));
  move.drag(camera_, at(on_ring(1.0)));
  EXPECT_NEAR(move.numbers().turn[0], 0.3, 1e-6);
  const Eigen::Isometry3d T_world_moved = bench_.selection().motions.front().T_world_moved;
  EXPECT_LT((T_world_moved * on_ring(0.7) - on_ring(1.0)).norm(), 1e-6);
}

TEST_F(Bench, LeavingAMotionLeavesTheMap) {
  bench_.select({kFloor});
  MoveTool move(bench_);
  ASSERT_EQ(move.begin(), "");
  move.set({{0.1, 0, 0}, {}});
  move.end();
  EXPECT_THAT(bench_.selection().motions, IsEmpty());
  EXPECT_THAT(source_->commands, IsEmpty());
}

TEST_F(Bench, ASplitIsALineOnTheSelectedPlane) {
  DrawTool split(DrawKind::kSplit, bench_);
  EXPECT_THAT(split.begin(), HasSubstr("select one polygon"));
  bench_.select({kFloor});
  ASSERT_EQ(split.begin(), "");
  split.click(camera_, at({-1, -2, 0}));
  split.click(camera_, at({-1, 2, 0}));
  ASSERT_EQ(source_->commands.size(), 1U);
  EXPECT_EQ(source_->commands[0].kind, EditKind::kSplit);
  EXPECT_LT((source_->commands[0].points[1] - Eigen::Vector3d(-1, 2, 0)).norm(), 1e-6);
  EXPECT_TRUE(split.is_done());
}

TEST_F(Bench, ACutClosesAtItsFirstCorner) {
  bench_.select({kFloor});
  DrawTool cut(DrawKind::kCut, bench_);
  ASSERT_EQ(cut.begin(), "");
  for (const Eigen::Vector3d& corner :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(5, 5, 0)}) {
    cut.click(camera_, at(corner));
  }
  EXPECT_TRUE(cut.step_back());
  cut.click(camera_, at({1, 1, 0}));
  cut.click(camera_, at({0, 0, 0}));
  ASSERT_EQ(source_->commands.size(), 1U);
  EXPECT_EQ(source_->commands[0].kind, EditKind::kCut);
  ASSERT_EQ(source_->commands[0].points.size(), 3U);
  EXPECT_LT((source_->commands[0].points[2] - Eigen::Vector3d(1, 1, 0)).norm(), 1e-6);
}

TEST_F(Bench, ANewRectangleOnAWallIsUprightAndFacesTheEye) {
  DrawTool add(DrawKind::kAdd, bench_);
  ASSERT_EQ(add.begin(), "");
  add.click(camera_, at({3.0, -0.5, 0.5}));
  add.click(camera_, at({3.0, 0.5, 1.5}));
  ASSERT_EQ(source_->commands.size(), 1U);
  const auto& corners = source_->commands[0].points;
  ASSERT_EQ(corners.size(), 4U);
  const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[1]);
  EXPECT_LT((normal.normalized() + kX).norm(), 1e-6) << "1 m² that looks at the eye";
  EXPECT_NEAR(normal.norm(), 1.0, 1e-6);
}

TEST_F(Bench, ADistanceIsMeasuredOnWhatIsUnderTheMouse) {
  DrawTool measure(DrawKind::kMeasure, bench_);
  ASSERT_EQ(measure.begin(), "");
  measure.click(camera_, at({-1, 0, 0}));
  measure.click(camera_, at({3.0, 0, 1.5}));
  Overlay overlay;
  measure.add_overlay(camera_, {}, overlay);
  ASSERT_EQ(overlay.texts.size(), 1U);
  EXPECT_THAT(overlay.texts[0].text, HasSubstr("4.272 m"));
  EXPECT_THAT(source_->commands, IsEmpty());
}

TEST_F(Bench, SilenceOfARunningSystemIsAWarningAndOfAFileNot) {
  SceneModel scene;
  EXPECT_FALSE(stale_warning(scene, *source_, now_));
  source_->live = true;
  EXPECT_THAT(stale_warning(scene, *source_, now_).value_or(""), HasSubstr("Nothing heard"));
  scene.heard = now_ - 1s;
  EXPECT_THAT(stale_warning(scene, *source_, now_).value_or(""), HasSubstr("No geomap-mapper"));
  scene.processes["geomap-mapper"].heard = now_ - 1s;
  EXPECT_THAT(stale_warning(scene, *source_, now_).value_or(""), HasSubstr("No robot"));
  scene.channels["CAMERA_POSE"].last = now_ - 1s;
  EXPECT_FALSE(stale_warning(scene, *source_, now_));
  scene.processes["geomap-mapper"].heard = now_ - 9s;
  EXPECT_THAT(stale_warning(scene, *source_, now_).value_or(""),
              HasSubstr("mapper has been silent"));
  scene.heard = now_ - 12s;
  EXPECT_THAT(stale_warning(scene, *source_, now_).value_or(""), HasSubstr("NO DATA for 12 s"));
}

TEST_F(Bench, TheStatusTellsASilentProcessAndARejectedKeyframe) {
  source_->live = true;
  SceneModel scene;
  scene.heard = now_;
  scene.registration = {Level::kDegraded, "rejected: too little overlap", 1};
  scene.processes["geomap-mapper"].heard = now_ - 9s;
  std::string all;
  Level worst = Level::kGood;
  for (const StatusItem& item : status_items(scene, *source_, now_)) {
    all += item.text + "\n";
    worst = std::max(worst, item.level);
  }
  EXPECT_THAT(all, HasSubstr("rejected: too little overlap"));
  EXPECT_THAT(all, HasSubstr("mapper: silent for 9.0 s"));
  EXPECT_EQ(worst, Level::kFailing);
}

}  // namespace
}  // namespace geomap::viewer
