// SPDX-License-Identifier: BSD-3-Clause
#include "logs/plot_frame.hpp"

namespace geomap::logs {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(PlotFrame, TicksAreRoundAndWithinTheAxis) {
  EXPECT_THAT(ticks_of({0.0, 10.0, ""}, 5.0), ElementsAre(0.0, 2.0, 4.0, 6.0, 8.0, 10.0));
  EXPECT_THAT(ticks_of({-1.2, 1.1, ""}, 4.0), ElementsAre(-1.0, 0.0, 1.0));
  EXPECT_EQ(ticks_of({1000.0, 1000.02, ""}, 4.0).size(), 5U);
  EXPECT_THAT(ticks_of({-1.9, 4.5, ""}, 3.0), ElementsAre(0.0, 2.0, 4.0));  // 5 apart: only 0
}

TEST(PlotFrame, ValuesRunToTheRightAndUpwards) {
  const PlotFrame frame{"", {50.0, 20.0}, {200.0, 100.0}, {-1.0, 1.0, ""}, {0.0, 5.0, ""}};
  EXPECT_EQ(frame.to_picture({-1.0, 5.0}), Eigen::Vector2d(50.0, 20.0));
  EXPECT_EQ(frame.to_picture({1.0, 0.0}), Eigen::Vector2d(250.0, 120.0));
}

TEST(PlotFrame, ALogarithmicAxisHasEqualRatiosEquallyFarApart) {
  PlotFrame frame{"", {0.0, 0.0}, {100.0, 100.0}, {0.0, 1.0, ""}, {0.01, 1.0, "", true}};
  EXPECT_NEAR(frame.to_picture({0.0, 0.01}).y(), 100.0, 1e-9);
  EXPECT_NEAR(frame.to_picture({0.0, 0.1}).y(), 50.0, 1e-9);
  EXPECT_NEAR(frame.to_picture({0.0, 1.0}).y(), 0.0, 1e-9);
  using ::testing::DoubleEq;
  EXPECT_THAT(ticks_of({0.3, 6.0, "", true}, 8.0),
              ElementsAre(DoubleEq(0.5), DoubleEq(1.0), DoubleEq(2.0), DoubleEq(5.0)));
  EXPECT_THAT(ticks_of({0.3, 60.0, "", true}, 3.0), ElementsAre(DoubleEq(1.0), DoubleEq(10.0)));
}

TEST(PlotFrame, NumbersHaveTheDecimalsThatTellThemApart) {
  mapping::SvgCanvas canvas;
  draw_frame(canvas, {"", {50, 20}, {300, 100}, {-0.3, 0.31, ""}, {0.0, 4000.0, ""}});
  const std::string svg = canvas.finish({400, 200}, "");
  for (const char* number : {">-0.2<", ">0.0<", ">0.2<", ">2000<", ">4000<"}) {
    EXPECT_THAT(svg, HasSubstr(number));
  }
  EXPECT_THAT(svg, Not(HasSubstr(">-0.0<")));
}

TEST(PlotFrame, ACurveOfOnePlaceIsADotAndCrowdedPointsAreDrawnOnce) {
  const PlotFrame frame{"", {0, 0}, {100, 100}, {0.0, 1.0, ""}, {0.0, 1.0, ""}};
  mapping::SvgCanvas dot, line;
  draw_curve(dot, frame, {{0.5, 0.5}, {0.5, 0.5001}}, "#123456", 2.0);
  EXPECT_THAT(dot.finish({100, 100}, ""), HasSubstr("<circle cx=\"50.00\" cy=\"50.00\""));
  draw_curve(line, frame, {{0.0, 0.0}, {0.001, 0.0}, {0.5, 0.5}}, "#123456", 2.0);
  EXPECT_THAT(line.finish({100, 100}, ""), HasSubstr("points=\"0.00,100.00 50.00,50.00\""));
}

}  // namespace
}  // namespace geomap::logs
