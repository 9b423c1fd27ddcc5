// SPDX-License-Identifier: BSD-3-Clause
#include "logs/evaluation.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "geometry/angles.hpp"
#include "mapping/example_map.hpp"
#include "messaging/temporary_folder.hpp"

namespace geomap::logs {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using ::testing::HasSubstr;
using Json = nlohmann::json;

constexpr const char* kGrey = "#8a94a0";
constexpr const char* kBlue = "#1f5fb4";
constexpr const char* kOrange = "#d9661f";

// Points of all lines of a colour in a picture.
std::vector<std::vector<Vector2d>> curves(const std::string& svg, const std::string& color) {
  std::vector<std::vector<Vector2d>> found;
  std::istringstream lines(svg);
  const std::string head = "<polyline points=\"";
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(head) || line.find(color) == std::string::npos) continue;
    std::istringstream points(line.substr(head.size(), line.find('"', head.size()) - head.size()));
    auto& curve = found.emplace_back();
    Vector2d point;
    for (char comma; points >> point.x() >> comma >> point.y();) curve.push_back(point);
  }
  return found;
}

// Five seconds on a circle of 1 m radius, ten poses a second, turning with it.
Trajectory circle() {
  Trajectory trajectory;
  for (int i = 0; i <= 50; ++i) {
    const double angle = 0.1 * i;
    Eigen::Isometry3d T(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
    T.translation() = Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.2 * std::sin(2 * angle));
    trajectory.emplace_back(1'305'031'102'000'000 + 100'000 * i, T);
  }
  return trajectory;
}

class EvaluationFiles : public testing::TemporaryFolder {
 protected:
  TrajectoryEvaluation evaluate(const Trajectory& estimate, const Trajectory& reference) const {
    write_trajectory(path("estimate.tum"), estimate);
    write_trajectory(path("reference.tum"), reference);
    return evaluate_trajectory(path("estimate.tum"), path("reference.tum"), 0.02);
  }

  Json written(const TrajectoryEvaluation& evaluation) const {
    write_evaluation({{}, evaluation}, path("new/out"));
    return Json::parse(read_file(path("new/out/evaluation.json")));
  }
};

TEST_F(EvaluationFiles, TheJsonHoldsTheFiguresUnderTheirKeys) {
  // The last pose is 6 cm too far to its left and turned by 2°.
  Trajectory estimate = circle();
  estimate.back().second.translate(Eigen::Vector3d(0, 0.06, 0));
  estimate.back().second.rotate(
      Eigen::AngleAxisd(geometry::radians(2.0), Eigen::Vector3d::UnitZ()));
  const TrajectoryEvaluation evaluation = evaluate(estimate, circle());
  const Json json = written(evaluation);

  EXPECT_EQ(json["trajectory"], path("estimate.tum"));
  EXPECT_EQ(json["reference"], path("reference.tum"));
  EXPECT_EQ(json["associated"], 51);
  EXPECT_EQ(json["max_difference"], 0.02);
  EXPECT_EQ(json["ate"]["rmse"], evaluation.metrics.aligned.statistics.rmse);
  for (const char* key : {"rmse", "mean", "median", "max"}) {
    EXPECT_GT(json["ate"][key].get<double>(), 0.0) << key;
    EXPECT_GE(json["ate_anchored"][key].get<double>(), 0.0) << key;
  }
  EXPECT_NEAR(json["ate_anchored"]["rmse"].get<double>(), 0.06 / std::sqrt(51.0), 1e-7);
  EXPECT_NEAR(json["ate_anchored"]["max"].get<double>(), 0.06, 1e-7);
  EXPECT_NEAR(json["ate_anchored"]["median"].get<double>(), 0.0, 1e-7);
  EXPECT_NEAR(json["ate_anchored"]["end_translation"].get<double>(), 0.06, 1e-7);
  EXPECT_NEAR(json["ate_anchored"]["end_rotation_deg"].get<double>(), 2.0, 1e-5);
  // One pair a second apart of 41 ends at the pose that is wrong.
  const Json& second = json["rpe"]["per_second"];
  EXPECT_EQ(second["pairs"], 41);
  EXPECT_NEAR(second["translation"]["rmse"].get<double>(), 0.06 / std::sqrt(41.0), 1e-7);
  EXPECT_NEAR(second["translation"]["median"].get<double>(), 0.0, 1e-7);
  EXPECT_NEAR(second["rotation_deg"]["max"].get<double>(), 2.0, 1e-5);
  EXPECT_GT(json["rpe"]["per_metre"]["pairs"].get<int>(), 30);
  EXPECT_NEAR(json["rpe"]["per_metre"]["translation"]["max"].get<double>(), 0.06, 1e-7);
}

TEST_F(EvaluationFiles, WhatCouldNotBeMeasuredIsNullNotZero) {
  Trajectory rest = circle();
  for (auto& [utime, T] : rest) T = Eigen::Isometry3d::Identity();
  const TrajectoryEvaluation evaluation = evaluate(rest, rest);
  const Json json = written(evaluation);
  EXPECT_EQ(json["rpe"]["per_metre"]["pairs"], 0);
  EXPECT_TRUE(json["rpe"]["per_metre"]["translation"]["rmse"].is_null());
  EXPECT_EQ(json["rpe"]["per_second"]["translation"]["rmse"], 0.0);
  EXPECT_EQ(json["ate"]["rmse"], 0.0);
  EXPECT_THAT(summary_text(evaluation), HasSubstr("RPE per metre: no such pairs"));
}

TEST_F(EvaluationFiles, TheReportShowsThePictureAndTheSameFiles) {
  Trajectory estimate = circle();
  estimate.resize(40);
  const TrajectoryEvaluation evaluation = evaluate(estimate, circle());
  written(evaluation);
  EXPECT_EQ(read_file(path("new/out/trajectory.svg")), evaluation.picture);
  const std::string report = read_file(path("new/out/evaluation.md"));
  EXPECT_THAT(report, HasSubstr("# Trajectory estimate.tum against reference.tum"));
  EXPECT_THAT(report, HasSubstr("](trajectory.svg)"));
  EXPECT_THAT(report, HasSubstr("40 of 40 poses match one of the reference's 51 within 0.02 s"));
  EXPECT_THAT(summary_text(evaluation), HasSubstr("ATE aligned: rmse 0.00 cm"));
}

TEST_F(EvaluationFiles, ThePictureHoldsBothPathsTwiceAndBothErrors) {
  // Moved as a whole: once aligned, both paths are the same line; anchored at the first pose, which
  // is turned, they are not.
  Trajectory estimate = circle();
  for (auto& [utime, T] : estimate) {
    T = Eigen::Translation3d(4, 5, 6) * Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitX()) * T;
  }
  estimate.front().second.rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
  const std::string svg = evaluate(estimate, circle()).picture;
  const auto reference = curves(svg, kGrey);
  const auto blue = curves(svg, kBlue);
  ASSERT_EQ(reference.size(), 2U);
  ASSERT_EQ(blue.size(), 3U);  // from above, from the side, error
  EXPECT_EQ(curves(svg, kOrange).size(), 1U);
  for (std::size_t view = 0; view < 2; ++view) {
    ASSERT_EQ(reference[view].size(), 51U);
    ASSERT_EQ(blue[view].size(), 51U);
    for (std::size_t i = 0; i < 51; ++i) {
      EXPECT_LT((reference[view][i] - blue[view][i]).norm(), 0.02);
    }
  }
  // From above, a circle stays one: chords of 1.6 and 3.1 rad keep their ratio; x to the right, y
  // up.
  const Vector2d right = reference[0][0], above = reference[0][16], left = reference[0][31];
  EXPECT_NEAR((right - above).norm() / (right - left).norm(), std::sin(0.8) / std::sin(1.55), 1e-3);
  EXPECT_GT(right.x(), left.x() + 100.0);
  EXPECT_LT(above.y(), right.y() - 50.0);
}

TEST_F(EvaluationFiles, LibrsvgRendersThePictureOfEveryKindOfPath) {
  if (!testing::has_program("rsvg-convert")) {
    GTEST_SKIP() << "rsvg-convert (librsvg2-bin) is missing";
  }
  Trajectory rest = circle(), far = circle(), tall = circle();
  for (auto& [utime, T] : rest) T.translation().setZero();
  for (auto& [utime, T] : far) T.translation() += Eigen::Vector3d(1e9, -1e9, 0) * 0.99;
  for (auto& [utime, T] : tall) T.translation().z() *= 50.0;
  for (const Trajectory& path_kind : {circle(), rest, far, tall}) {
    written(evaluate(path_kind, path_kind));
    EXPECT_EQ(testing::run_quietly("rsvg-convert '" + path("new/out/trajectory.svg") + "' -o '" +
                                   path("picture.png") + "'"),
              0);
    EXPECT_GT(fs::file_size(path("picture.png")), 5000U);
  }
}

TEST_F(EvaluationFiles, AFileNameWithMarkupStaysText) {
  write_trajectory(path("a<b>&.tum"), circle());
  write_trajectory(path("reference.tum"), circle());
  const auto evaluation = evaluate_trajectory(path("a<b>&.tum"), path("reference.tum"), 0.02);
  EXPECT_THAT(evaluation.picture, HasSubstr("a&lt;b&gt;&amp;.tum"));
}

}  // namespace
}  // namespace geomap::logs
