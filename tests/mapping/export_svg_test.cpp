// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/export_svg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "mapping/example_map.hpp"
#include "mapping/export.hpp"
#include "mapping/export_svg_canvas.hpp"
#include "mapping/export_svg_label.hpp"

namespace geomap::mapping {
namespace {

using geomap::testing::example_map;
using geomap::testing::make_feature;
using geomap::testing::rectangle_ring;
using geomap::testing::reversed;
using ::testing::HasSubstr;
using ::testing::Not;

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t number = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++number;
  }
  return number;
}

// Bytes of the picture that librsvg, an independent reader, makes of a sheet; nothing when it
// refuses.
std::size_t rendered_size(const MapSnapshot& map, const SvgOptions& options = {}) {
  const auto folder = geomap::testing::fresh_folder();
  export_map(map, folder / "map.svg", {.ascii = false, .svg = options});
  const std::string picture = (folder / "map.png").string();
  const int status = geomap::testing::run_quietly("rsvg-convert '" + (folder / "map.svg").string() +
                                                  "' -o '" + picture + "'");
  return status == 0 ? std::filesystem::file_size(picture) : 0;
}

// A crowd of rectangles in all orientations.
MapSnapshot crowd(int features) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  MapSnapshot map;
  for (int i = 0; i < features; ++i) {
    const Eigen::Vector3d normal(unit(random), unit(random), unit(random));
    const double half = 0.3 + 0.2 * unit(random);
    map.features.push_back(
        make_feature({.id = {i, 0},
                      .origin = 5.0 * Eigen::Vector3d(unit(random), unit(random), unit(random)),
                      .normal = normal},
                     {{{rectangle_ring(-half, -half, half, half), {}}}}));
  }
  return map;
}

TEST(ExportSvg, LibrsvgRendersEverySheet) {
  if (!geomap::testing::has_program("rsvg-convert")) {
    GTEST_SKIP() << "rsvg-convert (librsvg2-bin) is missing";
  }
  const std::size_t blank = rendered_size({});
  EXPECT_GT(blank, 1000U);
  EXPECT_GT(rendered_size(example_map()), 3 * blank);
  EXPECT_GT(rendered_size(example_map({1e5, -1e5, 50.0})), 3 * blank);
  EXPECT_GT(rendered_size(crowd(500)), 10 * blank);
  MapSnapshot one = example_map();
  one.features.resize(1);
  EXPECT_GT(rendered_size(one), 2 * blank);
}

TEST(ExportSvg, LabelsWithMarkupAndControlCharactersStayText) {
  MapSnapshot map = example_map();
  map.features[0].label = "wall\x01 ]]>";
  const std::string svg = to_svg(map);
  EXPECT_THAT(svg, HasSubstr("#2 table &lt;A &amp; &quot;B&quot;&gt;"));
  EXPECT_THAT(svg, HasSubstr("#3 wall  ]]&gt;"));
  if (geomap::testing::has_program("rsvg-convert")) {
    EXPECT_GT(rendered_size(map), 0U);
  }
}

TEST(ExportSvg, TheTitleCountsWhatIsInTheMap) {
  EXPECT_THAT(to_svg(example_map()),
              HasSubstr("revision 17 · 4 features · 24 vertices · 18.14 m²"));
}

TEST(ExportSvg, EveryViewShowsEveryFeatureWithItsHoles) {
  EXPECT_EQ(count(to_svg(example_map()), "<path "), 12U);
  SvgOptions top;
  top.views = {SvgView::kTop};
  const std::string svg = to_svg(example_map(), top);
  EXPECT_EQ(count(svg, "<path "), 4U);
  EXPECT_EQ(count(svg, "Z"), 4U + 2U);  // rings: the table's hole, the wall's second part
  EXPECT_THAT(svg, HasSubstr("fill-rule=\"evenodd\""));
}

TEST(ExportSvg, FeaturesUnderTwoHundredSquareCentimetresStayUnlabelled) {
  const auto sheet = [](double side) {
    MapSnapshot map;
    map.features.push_back(make_feature({.id = {1, 0}}, {{{rectangle_ring(0, 0, side, 0.1), {}}}}));
    return to_svg(map);
  };
  EXPECT_THAT(sheet(0.19), Not(HasSubstr(">#1<")));
  EXPECT_THAT(sheet(0.21), HasSubstr(">#1<"));
}

TEST(ExportSvg, HighlightedFeaturesAreOutlinedAgainAndTheOthersPale) {
  SvgOptions options;
  options.views = {SvgView::kOblique};
  const std::string plain = to_svg(example_map(), options);
  options.highlighted = {{3000, 1}, {1000, 2}};
  const std::string marked = to_svg(example_map(), options);
  EXPECT_EQ(count(plain, "stroke=\"#c8102e\""), 0U);
  EXPECT_EQ(count(marked, "stroke=\"#c8102e\""), 2U);
  EXPECT_EQ(count(plain, "fill-opacity=\"0.55\""), 0U);
  EXPECT_GE(count(marked, "fill-opacity=\"0.55\""), 1U);
}

TEST(ExportSvg, AGivenExtentAndDirectionKeepASeriesOfPicturesStill) {
  const MapSnapshot whole = example_map();
  MapSnapshot begun = whole;
  begun.features = {whole.features[3]};  // the floor alone
  SvgOptions options;
  options.views = {SvgView::kOblique};
  options.labels = false;
  options.heading = front_heading(whole.features);
  options.turn = oblique_turn(whole.features, *options.heading);
  options.extent.emplace();
  for (const MapFeature& feature : whole.features) {
    options.extent->extend(feature.surface.bounding_box());
  }
  const std::string late = to_svg(whole, options);
  const std::string early = to_svg(begun, options);
  const std::size_t at = early.find("<path ");
  ASSERT_NE(at, std::string::npos);
  EXPECT_THAT(late, HasSubstr(early.substr(at, early.find("/>", at) - at)));
}

TEST(ExportSvg, NumbersStayFiniteForAwkwardMaps) {
  MapSnapshot tiny;
  tiny.features.push_back(
      make_feature({.id = {1, 0}}, {{{rectangle_ring(0, 0, 0.0001, 0.0001), {}}}}));
  MapSnapshot huge;
  huge.features.push_back(
      make_feature({.id = {1, 0}}, {{{rectangle_ring(-9e4, -9e4, 9e4, 9e4), {}}}}));
  for (const MapSnapshot& map : {tiny, huge, example_map({1e5, 1e5, 1e3}), crowd(60)}) {
    const std::string svg = to_svg(map);
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_THAT(svg, Not(::testing::ContainsRegex("\"-?inf")));
  }
}

TEST(ExportSvg, NoViewsOrNoSizeAreRefused) {
  SvgOptions none;
  none.views.clear();
  EXPECT_THROW(to_svg(example_map(), none), std::invalid_argument);
  SvgOptions flat;
  flat.max_height = std::nan("");
  EXPECT_THROW(to_svg(example_map(), flat), std::invalid_argument);
}

TEST(SvgView, TheFrontViewFacesTheLargestUprightFeature) {
  MapSnapshot map = example_map();
  EXPECT_NEAR(front_heading(map.features), std::numbers::pi / 2.0, 1e-12);
  map.features.push_back(make_feature(
      {.id = {9000, 0}, .origin = {-3, 0, 1}, .normal = {1, 0, 0}, .x_axis = {0, 1, 0}},
      {{{rectangle_ring(-3, -1, 3, 1), {}}}}));
  EXPECT_NEAR(std::abs(front_heading(map.features)), std::numbers::pi, 1e-12);
  EXPECT_NEAR(front_heading({}), std::numbers::pi / 2.0, 1e-12);
}

TEST(SvgView, TheTopViewHasXRightAndYUpWhenTheFrontLooksAlongY) {
  const ViewAxes axes = view_axes(SvgView::kTop, std::numbers::pi / 2.0, 0.5);
  EXPECT_LT((axes.right - Eigen::Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((axes.up - Eigen::Vector3d::UnitY()).norm(), 1e-12);
  EXPECT_LT((axes.forward + Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(SvgView, AxesAreRightHandedUnitVectors) {
  for (const SvgView view : {SvgView::kTop, SvgView::kFront, SvgView::kOblique}) {
    const ViewAxes axes = view_axes(view, 0.7, -0.4);
    EXPECT_LT((axes.right.cross(axes.forward) - axes.up).norm(), 1e-12);
    EXPECT_NEAR(axes.right.norm() * axes.up.norm() * axes.forward.norm(), 1.0, 1e-12);
  }
}

TEST(SvgView, TheObliqueViewTurnsToTheSideThatShowsMore) {
  const double ahead = std::numbers::pi / 2.0;
  const auto wall = [](double nx) {
    return make_feature({.id = {1, 0}, .normal = {nx, 0, 0}, .x_axis = {0, 1, 0}},
                        {{{rectangle_ring(-1, -1, 1, 1), {}}}});
  };
  const MapFeature on_the_left = wall(1.0);
  const MapFeature on_the_right = wall(-1.0);
  EXPECT_GT(oblique_turn({&on_the_left, 1}, ahead), 0.0);
  EXPECT_LT(oblique_turn({&on_the_right, 1}, ahead), 0.0);
}

std::vector<std::int64_t> painted_ids(const MapSnapshot& map, const ViewAxes& axes) {
  const auto projected = project_features(map.features, axes);
  std::vector<std::int64_t> ids;
  for (const std::size_t i : paint_order(projected)) {
    ids.push_back(projected[i].feature->id.keyframe);
  }
  return ids;
}

TEST(SvgView, ASmallTableIsPaintedOverTheFloorThoughTheFloorsMiddleIsNearer) {
  MapSnapshot map;
  // Far at the back of a long floor: its depth alone would put it behind.
  map.features.push_back(make_feature({.id = {1, 0}, .origin = {0, 4, 0.7}},
                                      {{{rectangle_ring(-0.5, -0.5, 0.5, 0.5), {}}}}));
  map.features.push_back(make_feature({.id = {2, 0}}, {{{rectangle_ring(-2, -5, 2, 5), {}}}}));
  const ViewAxes axes = view_axes(SvgView::kOblique, std::numbers::pi / 2.0, 0.0);
  EXPECT_THAT(painted_ids(map, axes), ::testing::ElementsAre(2, 1));
}

TEST(SvgView, EveryFeatureOfATangleIsPaintedOnce) {
  const MapSnapshot tangle = crowd(300);  // full of features that cover each other in circles
  const ViewAxes axes = view_axes(SvgView::kTop, 0.0, 0.0);
  std::vector<std::int64_t> ids = painted_ids(tangle, axes);
  std::sort(ids.begin(), ids.end());
  for (std::size_t i = 0; i < 300; ++i) EXPECT_EQ(ids.at(i), static_cast<std::int64_t>(i));
}

TEST(SvgView, HorizontalFeaturesArePaintedFromTheLowestUpInTheTopView) {
  MapSnapshot map;
  for (const int height : {3, 0, 4, 1, 2}) {
    map.features.push_back(make_feature({.id = {height, 0}, .origin = {0.0, 0.0, 0.2 * height}},
                                        {{{rectangle_ring(-1, -1, 1, 1), {}}}}));
  }
  const ViewAxes axes = view_axes(SvgView::kTop, 0.0, 0.0);
  EXPECT_THAT(painted_ids(map, axes), ::testing::ElementsAre(0, 1, 2, 3, 4));
}

TEST(SvgLabel, SpotsOfARingShapedAreaLieOnItAndNotInItsHole) {
  const PictureRings frame = {{{0, 0}, {100, 0}, {100, 80}, {0, 80}},
                              {{20, 20}, {20, 60}, {70, 60}, {70, 20}}};
  const std::vector<LabelSpot> spots = label_spots(frame);
  ASSERT_FALSE(spots.empty());
  // The right-hand bar, 30 wide, is the roomiest; a corner's bisector gives a little more.
  EXPECT_GT(spots.front().clearance, 14.0);
  for (const LabelSpot& spot : spots) {
    const bool in_hole =
        spot.point.x() > 20 && spot.point.x() < 70 && spot.point.y() > 20 && spot.point.y() < 60;
    EXPECT_FALSE(in_hole);
    EXPECT_NEAR(spot.clearance, clearance(frame, spot.point), 1e-12);
  }
}

TEST(SvgLabel, AmpleRoomPrefersTheMiddle) {
  const PictureRings sheet = {{{0, 0}, {900, 0}, {900, 200}, {0, 200}}};
  EXPECT_LT((label_spots(sheet).front().point - Eigen::Vector2d(450, 100)).norm(), 1.0);
}

TEST(SvgLabel, ALineOffersNoSpot) {
  EXPECT_TRUE(label_spots({{{0, 0}, {50, 0}, {100, 0}}}).empty());
  EXPECT_TRUE(label_spots({}).empty());
}

}  // namespace
}  // namespace geomap::mapping
