// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/picker.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "support/axes.hpp"
#include "viewer/event_handler.hpp"
#include "viewer/fake_source.hpp"

namespace geomap::viewer {
namespace {

using ::testing::ElementsAre;
using testing::rectangle_feature;

using geomap::testing::kX, geomap::testing::kY, geomap::testing::kZ;

class Picking : public ::testing::Test {
 protected:
  Picking() {
    put(rectangle_feature(1, {0, 0, 0}, kZ, kX, 6.0, 4.0));       // floor
    put(rectangle_feature(2, {0, 0, 0.8}, kZ, kX, 1.0, 1.0));     // table
    put(rectangle_feature(3, {2.9, 0, 1.0}, -kX, kY, 4.0, 2.0));  // wall
    cache_.update(map_);
    camera_.resize(800, 600);
  }
  void put(const mapping::ViewFeature& feature) {
    map_.features[feature.id] = feature;
    ++map_.stamp;
  }
  std::optional<std::int64_t> at(const Eigen::Vector3d& point) const {
    const auto hit = pick_feature(cache_, camera_, *camera_.project(point));
    if (!hit) return std::nullopt;
    return hit->id.keyframe - 1'000'000;
  }
  void look_from_above() {
    camera_.set({{0, 0, 0},
                 8.0,
                 -std::numbers::pi / 2.0,
                 std::numbers::pi / 2.0,
                 Projection::kOrthographic});
  }

  MapLayer map_;
  SurfaceCache cache_;
  ViewCamera camera_;
};

TEST_F(Picking, TheNearestPolygonUnderTheMouseIsMeant) {
  camera_.set({{0, 0, 0}, 8.0, -2.5, 0.7, Projection::kPerspective});
  EXPECT_EQ(at({0, 0, 0.8}), 2);
  EXPECT_EQ(at({-2.0, -1.5, 0}), 1);
  EXPECT_EQ(at({2.9, 0.5, 1.4}), 3);
  EXPECT_EQ(at({-6.0, 6.0, 0}), std::nullopt);
}

TEST_F(Picking, AWallSeenFromAboveIsPickedByItsLine) {
  look_from_above();
  EXPECT_EQ(at({2.9, 0.5, 0}), 3);
  EXPECT_EQ(at({2.5, 0.5, 0}), 1) << "beside the line it is the floor";
}

TEST_F(Picking, AHoleIsLookedThrough) {
  mapping::ViewFeature floor = map_.features.begin()->second;
  geometry::Ring hole = geometry::rectangle({-2.0, -1.5}, {-1.0, -0.5});
  std::reverse(hole.begin(), hole.end());
  floor.polygon.parts[0].holes = {hole};
  put(floor);
  cache_.update(map_);
  look_from_above();
  EXPECT_EQ(at({-1.5, -1.0, 0}), std::nullopt);
  EXPECT_EQ(at({-2.5, -1.0, 0}), 1);
}

TEST_F(Picking, ARectangleTakesWhatLiesWholeInside) {
  look_from_above();
  Eigen::AlignedBox2d box(*camera_.project({-1, -1, 0}));
  box.extend(*camera_.project({1, 1, 0}));
  EXPECT_THAT(features_inside(cache_, camera_, box), ElementsAre(mapping::FeatureId{1'000'002, 0}));
}

TEST_F(Picking, FeaturesKeepTheirNumbersByTheOrderOfIds) {
  EXPECT_EQ(cache_.find({1'000'003, 0})->number, 3);
  map_.features.erase({1'000'001, 0});
  ++map_.stamp;
  cache_.update(map_);
  EXPECT_EQ(cache_.find({1'000'003, 0})->number, 2);
  EXPECT_EQ(cache_.find({1'000'001, 0}), nullptr);
}

/// Says at which distance it has something, and whether it consumes.
class Recording : public EventHandler {
 public:
  Recording(std::optional<double> distance, bool consumes)
      : distance_(distance), consumes_(consumes) {}
  std::optional<double> pick(const ViewCamera&, const PointerEvent&) override { return distance_; }
  void hover(const ViewCamera&, const PointerEvent&, bool is_nearest) override {
    heard.push_back(is_nearest ? "nearest" : "hover");
  }
  bool press(const ViewCamera&, const PointerEvent&) override { return note("press"); }
  void drag(const ViewCamera&, const PointerEvent&) override { heard.push_back("drag"); }
  void release(const ViewCamera&, const PointerEvent&) override { heard.push_back("release"); }
  bool click(const ViewCamera&, const PointerEvent&) override { return note("click"); }
  std::vector<std::string> heard;

 private:
  bool note(const char* what) {
    heard.push_back(what);
    return consumes_;
  }
  std::optional<double> distance_;
  bool consumes_;
};

PointerEvent moved(double dx) {
  PointerEvent event;
  event.moved = {dx, 0.0};
  return event;
}

TEST(EventDispatcher, WhoHasTheNearestThingComesFirstAndConsumes) {
  Recording far(5.0, true), near(1.0, true), none(std::nullopt, true);
  EventDispatcher events;
  events.set_handlers({&none, &far, &near});
  const ViewCamera camera;
  events.press(camera, {});
  events.drag(camera, moved(20.0));
  events.release(camera, {});
  EXPECT_THAT(near.heard, ElementsAre("press", "drag", "release"));
  EXPECT_TRUE(far.heard.empty());
  EXPECT_TRUE(none.heard.empty());
}

TEST(EventDispatcher, WithoutConsumingTheNextOnesHearOfItInOrder) {
  Recording near(1.0, false), first(std::nullopt, false), second(std::nullopt, true);
  EventDispatcher events;
  events.set_handlers({&first, &second, &near});
  events.press({}, {});
  EXPECT_THAT(near.heard, ElementsAre("press"));
  EXPECT_THAT(first.heard, ElementsAre("press"));
  EXPECT_THAT(second.heard, ElementsAre("press"));
}

TEST(EventDispatcher, APressThatTravelsIsNoClick) {
  Recording handler(1.0, true);
  EventDispatcher events;
  events.set_handlers({&handler});
  events.press({}, {});
  events.drag({}, moved(2.0));
  events.release({}, {});
  EXPECT_THAT(handler.heard, ElementsAre("press", "release", "click"));
  handler.heard.clear();
  events.press({}, {});
  events.drag({}, moved(9.0));
  events.release({}, {});
  EXPECT_THAT(handler.heard, ElementsAre("press", "drag", "release"));
}

TEST(EventDispatcher, EverybodyIsToldWhereTheMouseIsAndWhoseIsTheNearest) {
  Recording near(1.0, false), far(2.0, false), none(std::nullopt, false);
  EventDispatcher events;
  events.set_handlers({&none, &far, &near});
  events.hover({}, {});
  EXPECT_THAT(near.heard, ElementsAre("nearest"));
  EXPECT_THAT(far.heard, ElementsAre("hover"));
  EXPECT_THAT(none.heard, ElementsAre("hover"));
}

TEST(EventDispatcher, ASecondButtonDoesNotDragToo) {
  Recording handler(1.0, true);
  EventDispatcher events;
  events.set_handlers({&handler});
  events.press({}, {});
  PointerEvent other = moved(20.0);
  other.button = Button::kRight;
  events.drag({}, other);
  EXPECT_THAT(handler.heard, ElementsAre("press"));
}

TEST(EventDispatcher, ADragEndsWhenItsOwnerLeaves) {
  Recording tool(0.0, true), rest(std::nullopt, true);
  EventDispatcher events;
  events.set_handlers({&tool, &rest});
  events.press({}, {});
  events.set_handlers({&rest});
  events.drag({}, moved(20.0));
  events.release({}, {});
  EXPECT_THAT(tool.heard, ElementsAre("press"));
  events.press({}, {});
  EXPECT_THAT(rest.heard, ElementsAre("press"));
}

}  // namespace
}  // namespace geomap::viewer
