// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/palette.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace geomap::viewer {
namespace {

double distance(const Rgba& a, const Rgba& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// Relative luminance (WCAG 2.1).
double luminance(const Rgba& color) {
  const auto linear = [](double v) {
    return v <= 0.03928 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(color[0]) + 0.7152 * linear(color[1]) + 0.0722 * linear(color[2]);
}

double contrast(const Rgba& a, const Rgba& b) {
  const double x = luminance(a), y = luminance(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

TEST(Palette, TextAndMarksCanBeReadOnTheirGround) {
  for (const Theme& theme : {dark_theme(), light_theme()}) {
    EXPECT_GT(contrast(theme.foreground, theme.background), 7.0);
    for (const Rgba& mark : {theme.selected, theme.hovered, theme.warning, theme.good, theme.bad}) {
      EXPECT_GT(contrast(mark, theme.background), 3.0);
    }
  }
}

TEST(Palette, NeighboursOfOneKeyframeDiffer) {
  for (std::int32_t plane = 0; plane < 20; ++plane) {
    EXPECT_GT(distance(color_of({.keyframe = 7, .plane = plane}),
                       color_of({.keyframe = 7, .plane = plane + 1})),
              0.1);
  }
}

TEST(Palette, FloorsCeilingsWallsAndInclinedFacesDiffer) {
  const double h = std::sqrt(0.5);
  const std::vector<Eigen::Vector3d> kinds = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0},
                                              {0, 1, 0}, {0, -1, 0}, {h, 0, h}};
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT(distance(color_of_normal(kinds[i]), color_of_normal(kinds[j])), 0.2);
    }
  }
}

TEST(Palette, AWallThatTurnsALittleChangesItsColourALittle) {
  constexpr int kSteps = 720;
  for (int i = 0; i < kSteps; ++i) {
    const auto color = [](int step) {
      const double heading = 2.0 * std::numbers::pi * step / kSteps;
      return color_of_normal({std::cos(heading), std::sin(heading), 0.0});
    };
    EXPECT_LT(distance(color(i), color(i + 1)), 0.02);
  }
}

TEST(Palette, TheRampGrowsLighterAndTakesAnyNumber) {
  for (int i = 0; i < 20; ++i) {
    EXPECT_LT(luminance(ramp(i / 20.0)), luminance(ramp((i + 1) / 20.0)));
  }
  EXPECT_EQ(ramp(-5.0), ramp(0.0));
  EXPECT_EQ(ramp(7.0), ramp(1.0));
  EXPECT_EQ(ramp(std::numeric_limits<double>::quiet_NaN()), ramp(0.0));
}

TEST(Palette, OneLabelHasOneColourAndUsualOnesDiffer) {
  const std::vector<std::string> usual = {"wall", "floor", "ceiling", "table", "door", ""};
  for (std::size_t i = 0; i < usual.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT(distance(color_of_label(usual[i]), color_of_label(usual[j])), 0.2);
    }
  }
  EXPECT_EQ(color_of_label("shelf"), color_of_label("shelf"));
}

}  // namespace
}  // namespace geomap::viewer
