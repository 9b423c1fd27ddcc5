// SPDX-License-Identifier: BSD-3-Clause
#include "logs/evaluation_page.hpp"

#include <nlohmann/json.hpp>

#include "logs/evaluation_runs.hpp"

namespace geomap::logs {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::line_after;
using ::testing::Not;
using testing::write_run;
using Json = nlohmann::json;

class EvaluationPage : public testing::RunsFolder {};

TEST_F(EvaluationPage, MeansAndRangesStandBelowThePapersRow) {
  write_paper_sets();
  write();
  const std::string text = written("evaluation.md");
  EXPECT_EQ(line_after(text, "| **kitchen, no noise**", "| paper"),
            "| paper, Table 1 | - | - | 0.0067 | 7.1 | - | 5.4 | 16.1 |");
  EXPECT_EQ(line_after(text, "| **kitchen, no noise**", "| ransac-moments"),
            "| ransac-moments | 2 | 0.0018 (0.0016 .. 0.0020) | **0.0009** (0.0008 .. 0.0010) | "
            "**2.7** (2.4 .. 3.0) | 1.8 (1.6 .. 2.0) | **1.8** (1.6 .. 2.0) | 4.0 |");
  EXPECT_EQ(line_after(text, "| **kitchen, noise 20 mm**", "| paper"),
            "| paper, Table 1 | - | - | 0.0580 | 136.8 | - | 21.1 | 7.0 |");
  EXPECT_EQ(line_after(text, "| **kitchen, Kinect's noise**", "| paper, real_2"),
            "| paper, real_2 | - | - | 0.0660 | 102.0 | - | 31.7 | - |");
}

TEST_F(EvaluationPage, OnlyFiguresBetterThanThePapersAreBold) {
  write_paper_sets();
  write();
  // 0.008 rad, 24 mm and 16 mm against 0.0067 rad, 7.1 mm and 5.4 mm without noise, and 0.0057 rad,
  // 19.8 mm and 24.6 mm with a noise of 5 mm.
  const std::string text = written("evaluation.md");
  EXPECT_THAT(line_after(text, "| **kitchen, no noise**", "| ransac-paper"), Not(HasSubstr("**")));
  EXPECT_EQ(line_after(text, "| **kitchen, noise 5 mm**", "| ransac-paper"),
            "| ransac-paper | 2 | 0.0160 | 0.0080 | 24.0 | 16.0 | **16.0** | 4.0 |");
  EXPECT_THAT(written("evaluation.html"), HasSubstr("<strong>16.0</strong>"));
}

TEST_F(EvaluationPage, TimesAndBytesStandBesideThePapers) {
  write_run(run("turn360/ransac-moments/seed1"), 0.001);
  write();
  const std::string text = written("evaluation.md");
  const auto row = [&](const std::string& begin) { return line_after(text, "## Table 4", begin); };
  EXPECT_EQ(row("| registration"), "| registration | 27 | **10.0** (10.0, 20.0) |");
  EXPECT_EQ(row("| plane extraction"), "| plane extraction with outlines | 165 | **35.0** |");
  EXPECT_EQ(row("| merging"), "| merging | 2 | 4.0 (4.0, 8.0) |");
  EXPECT_EQ(row("| total"), "| total | 194 | **50.0** (50.0, 100.0) |");
  EXPECT_EQ(row("| key frames"), "| key frames | 52 | 4 |");
  EXPECT_EQ(row("| planes extracted"), "| planes extracted | 152 | 20 |");
  EXPECT_EQ(line_after(text, "## Table 5", "| point map"),
            "| point map | 595 kB, 0.949 % | 10 kB (1 %) |");
  EXPECT_THAT(line_after(text, "## Table 5", "| geometric map"),
              HasSubstr("6.5 kB, 0.0104 % | **50 B** (0.005 %)"));
}

TEST_F(EvaluationPage, PlanesHaveARowEachAndNamesAreEscaped) {
  write_paper_sets();
  write();
  const std::string text = written("evaluation.md");
  EXPECT_EQ(line_after(text, "## Tables 2 and 3", "| door"),
            "| door \\<left> | 3.50 | 1 | 0.0009 (0.0008 .. 0.0010) | 0.0009 (0.0008 .. 0.0010) | "
            "0.9 (0.8 .. 1.0) | - | 1.8 (1.6 .. 2.0) | 0.950 |");
  EXPECT_THAT(line_after(text, "## Tables 2 and 3", "| paper, real_2: kitchen front"),
              HasSubstr("| 78.0 |"));
  EXPECT_THAT(written("evaluation.html"), HasSubstr("door &lt;left&gt;"));
}

TEST_F(EvaluationPage, PlanesThatTheCameraSawTooLittleOfHaveNoRow) {
  write_run(run("kinect/ransac-moments/seed1"), 0.001);
  write();
  const std::string text = written("evaluation.md");
  EXPECT_EQ(line_after(text, "## Tables 2 and 3", "| unfound"),
            "| unfound | - | 0 | - | - | - | - | - | - |");
  EXPECT_THAT(text, Not(HasSubstr("ceiling")));
  EXPECT_THAT(text, Not(HasSubstr("crumb")));
  EXPECT_THAT(written("evaluation.html"), HasSubstr("<td class=\"number bad\">0</td>"));
}

TEST_F(EvaluationPage, AMissedBoundNamesTheWorstSeed) {
  write_paper_sets();
  write_run(run("n0/ransac-moments/seed3"), 0.001,
            {.evaluation = R"({"features_per_component": 1.25, "rms_p": 0.00301})"});
  const EvaluationPageSummary summary = write();
  EXPECT_EQ(summary.runs, 21U);
  EXPECT_EQ(summary.bounds, 33U);
  EXPECT_EQ(summary.missed, 2U);
  const std::string text = written("evaluation.md");
  EXPECT_THAT(text, HasSubstr("31 of 33 bounds are met"));
  EXPECT_EQ(
      line_after(text, "## Bounds", "| features per component"),
      "| features per component | ransac-moments | exactly 1.000 | 1.250 | seed3 | **MISSED** |");
  EXPECT_EQ(line_after(text, "## Bounds", "| RMS_p"),
            "| RMS_p [mm] | ransac-moments | at most 3.00 | 3.01 | seed3 | **MISSED** |");
  EXPECT_EQ(line_after(text, "## Bounds", "| d_angle"),
            "| d_angle [rad] | ransac-moments | at most 0.00200 | 0.00100 | seed2 | met |");
}

TEST_F(EvaluationPage, WhatCouldNotBeMeasuredMeetsNoBound) {
  write_run(run("n0/ransac-moments/seed1"), 0.001);
  write_run(run("n0/ransac-moments/seed2"), 0.001, {.evaluation = R"({"rms_p": null})"});
  EXPECT_EQ(write().missed, 1U);
  EXPECT_EQ(line_after(written("evaluation.md"), "## Bounds", "| RMS_p"),
            "| RMS_p [mm] | ransac-moments | at most 3.00 | - | seed2 | **MISSED** |");
}

TEST_F(EvaluationPage, TheJsonHoldsAllAggregatedFigures) {
  write_paper_sets();
  write();
  const Json json = Json::parse(written("evaluation.json"));
  EXPECT_EQ(json["runs"], 20);
  EXPECT_THAT(json["missing"], IsEmpty());
  const Json& group = json["sets"]["n0"]["ransac-moments"];
  EXPECT_EQ(group["seeds"], Json({"seed1", "seed2"}));
  EXPECT_NEAR(group["d_angle"]["mean"].get<double>(), 0.0009, 1e-12);
  EXPECT_EQ(group["d_angle"]["min"], 0.0008);
  EXPECT_EQ(group["d_angle"]["max"], 0.0010);
  EXPECT_EQ(group["d_angle"]["count"], 2);
  EXPECT_EQ(group["hull_distance_mean"]["mean"], 0.01);
  EXPECT_NEAR(group["planes"]["floor"]["rms_p"]["mean"].get<double>(), 0.0018, 1e-12);
  EXPECT_TRUE(group["planes"]["floor"]["d_dist_local"].is_null());
  EXPECT_EQ(group["stage_seconds"]["total"]["p95"]["max"], 0.1);
  EXPECT_EQ(group["bytes"]["map"]["mean"], 50.0);
  EXPECT_EQ(json["bounds"].size(), 33U);
  EXPECT_EQ(json["bounds"][0]["met"], true);
  EXPECT_EQ(json["paper"]["accuracy"][0]["d_angle"], 0.0067);
}

TEST_F(EvaluationPage, TheBenchmarkFragmentIsTheTablesOneLevelDeeper) {
  write_paper_sets();
  write();
  const std::string text = written("benchmark.md");
  EXPECT_THAT(text, HasSubstr("### Table 1: accuracy of the map\n\n| run |"));
  EXPECT_THAT(text, Not(HasSubstr("\n## ")));
  EXPECT_THAT(text, Not(HasSubstr("pictures/")));
  EXPECT_THAT(text, Not(HasSubstr("Figure 6")));
}

}  // namespace
}  // namespace geomap::logs
