// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/export_svg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "mapping/example_map.hpp"
#include "mapping/export.hpp"
#include "mapping/export_svg_canvas.hpp"

namespace geomap::mapping {
namespace {

using geomap::testing::crowd;
using geomap::testing::example_map;
using geomap::testing::make_feature;
using geomap::testing::rectangle_ring;
using ::testing::HasSubstr;
using ::testing::Not;

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t number = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++number;
  }
  return number;
}

double number_after(const std::string& text, const std::string& key) {
  return std::stod(text.substr(text.find(key) + key.size()));
}

// The labels "#N" of a sheet and the boxes their texts take.
std::vector<std::pair<std::string, Eigen::AlignedBox2d>> label_boxes(const std::string& svg) {
  std::vector<std::pair<std::string, Eigen::AlignedBox2d>> boxes;
  std::istringstream lines(svg);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(">#");
    if (!line.starts_with("<text ") || at == std::string::npos) continue;
    const std::string text = line.substr(at + 1, line.find('<', at) - at - 1);
    const Eigen::Vector2d middle(number_after(line, "x=\""), number_after(line, "y=\""));
    const Eigen::Vector2d half(text_width(text, 12.0) / 2.0, 4.0);
    boxes.emplace_back(text, Eigen::AlignedBox2d(middle - half, middle + half));
  }
  return boxes;
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

TEST(ExportSvg, LabelsDoNotLieOnEachOther) {
  const auto boxes = label_boxes(to_svg(crowd(300)));
  ASSERT_GT(boxes.size(), 100U);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_FALSE(boxes[i].second.intersects(boxes[j].second))
          << boxes[i].first << " and " << boxes[j].first;
    }
  }
}

TEST(ExportSvg, ALabelStandsOnThePartOfItsFeatureThatIsSeen) {
  MapSnapshot map;
  map.features.push_back(make_feature({.id = {1, 0}}, {{{rectangle_ring(-2, -1, 2, 1), {}}}}));
  map.features.push_back(
      make_feature({.id = {2, 0}, .origin = {0, 0, 1}}, {{{rectangle_ring(-2, -1, 1, 1), {}}}}));
  map.features.push_back(make_feature({.id = {3, 0}, .origin = {0, 0, 0.5}},
                                      {{{rectangle_ring(-1.9, -0.9, 0.9, 0.9), {}}}}));
  SvgOptions top;
  top.views = {SvgView::kTop};
  const auto boxes = label_boxes(to_svg(map, top));
  ASSERT_EQ(boxes.size(), 2U);  // nothing of #3 is seen from above
  EXPECT_EQ(boxes[0].first, "#1");
  EXPECT_EQ(boxes[1].first, "#2");
  EXPECT_GT(boxes[0].second.min().x(), boxes[1].second.max().x());
}

TEST(ExportSvg, ALabelDoesNotHideAFaceThatIsSmallerThanItself) {
  MapSnapshot map;
  map.features.push_back(make_feature({.id = {1, 0}}, {{{rectangle_ring(-1, -1, 1, 1), {}}}}));
  map.features[0].label = "in the way";
  map.features.push_back(make_feature({.id = {2, 0}, .origin = {0.0, 0.0, 0.1}},
                                      {{{rectangle_ring(0.011, -0.003, 0.017, 0.003), {}}}}));
  SvgOptions top;
  top.views = {SvgView::kTop};
  const std::string svg = to_svg(map, top);
  const auto boxes = label_boxes(svg);
  ASSERT_EQ(boxes.size(), 1U);
  const std::string small = svg.substr(svg.rfind("<path d=\"M"));  // painted last
  const double x = number_after(small, "M");
  const double y = number_after(small, ",");
  EXPECT_FALSE(boxes[0].second.contains(Eigen::Vector2d(x, y)));
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

TEST(ExportSvg, TheScaleBarHasARoundLengthAndTheScaleOfTheDrawing) {
  for (const double side : {0.013, 0.4, 1.0, 3.7, 26.0, 950.0}) {
    MapSnapshot map;
    const double half = side / 2.0;
    map.features.push_back(
        make_feature({.id = {1, 0}}, {{{rectangle_ring(-half, -half, half, half), {}}}}));
    SvgOptions top;
    top.views = {SvgView::kTop};
    const std::string svg = to_svg(map, top);
    const std::string square = svg.substr(svg.find("<path d=\"M"));
    const double scale = (number_after(square, "L") - number_after(square, "M")) / side;

    const std::size_t unit =
        std::min(svg.find(" m<"), std::min(svg.find(" cm<"), svg.find(" mm<")));
    ASSERT_NE(unit, std::string::npos);
    const double number = number_after(svg.substr(svg.rfind('>', unit)), ">");
    const double metres = svg[unit + 1] == 'c'   ? number / 100.0
                          : svg[unit + 2] == 'm' ? number / 1000.0
                                                 : number;
    const double digit = number / std::pow(10.0, std::floor(std::log10(number) + 1e-9));
    EXPECT_THAT(digit, ::testing::AnyOf(1.0, 2.0, 5.0)) << number;
    // The bar is the line drawn last but two; its ends have ticks.
    const std::size_t bar = svg.rfind("<line", svg.rfind("<line", svg.rfind("<line") - 1) - 1);
    const double length =
        number_after(svg.substr(bar), "x2=\"") - number_after(svg.substr(bar), "x1=\"");
    EXPECT_NEAR(length, metres * scale, 0.05 + 0.001 * length) << side;
  }
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

}  // namespace
}  // namespace geomap::mapping
