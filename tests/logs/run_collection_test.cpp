// SPDX-License-Identifier: BSD-3-Clause
#include "logs/run_collection.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "logs/evaluation_runs.hpp"

namespace geomap::logs {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::line_after;
using ::testing::Not;
using testing::write_run;
using Json = nlohmann::json;

class RunCollection : public testing::RunsFolder {};

TEST_F(RunCollection, UnfinishedRunsAreListedAndLeftOut) {
  write_run(run("n0/ransac-moments/seed1"), 0.001);
  write_run(run("n0/ransac-moments/seed2"), 0.009);
  fs::remove(run("n0/ransac-moments/seed2/evaluation/evaluation.json"));
  const EvaluationPageSummary summary = write();
  EXPECT_EQ(summary.runs, 1U);
  EXPECT_EQ(summary.missing, 1U);
  EXPECT_THAT(written("evaluation.md"),
              HasSubstr("| n0/ransac-moments/seed2/evaluation/evaluation.json |"));
}

TEST_F(RunCollection, ABrokenFileIsOneLineThatNamesIt) {
  const auto message = [&]() -> std::string {
    try {
      write();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(message(), HasSubstr("no such folder"));
  fs::create_directories(run("n0"));
  EXPECT_THAT(message(), HasSubstr("no finished run"));

  const fs::path broken = run("n0/ransac-moments/seed1");
  write_run(broken, 0.001);
  std::ofstream(broken / "report.json") << "{\"keyframes\": 4,\n\n";
  EXPECT_THAT(message(), HasSubstr((broken / "report.json").string() + ": "));
  EXPECT_THAT(message(), Not(HasSubstr("\n")));

  write_run(broken, 0.001, {.report = R"({"growth": null})"});
  EXPECT_THAT(message(), HasSubstr("'growth'"));
  write_run(broken, 0.001, {.report = R"({"growth": {"map_features": [5, 5, 5]}})"});
  EXPECT_THAT(message(), HasSubstr("differ in length"));

  write_run(broken, 0.001, {.evaluation = R"({"d_angle": "small"})"});
  EXPECT_THAT(message(), HasSubstr((broken / "evaluation/evaluation.json").string() + ": "));
}

TEST_F(RunCollection, UnknownSetsAreShownWithoutThePaper) {
  write_run(run("attic/ransac-moments/seed1"), 0.001);
  write_run(run("attic/ransac-moments/seed10"), 0.001);
  write_run(run("attic/ransac-moments/seed9"), 0.001);
  write();
  const std::string text = written("evaluation.md");
  EXPECT_EQ(line_after(text, "## Accuracy in other scenes", "| ransac-moments"),
            "| ransac-moments | 3 | 0.0020 | 0.0010 | 3.0 | 2.0 | 2.0 | 4.0 |");
  EXPECT_THAT(text, Not(HasSubstr("## Table 1")));
  EXPECT_THAT(text, Not(HasSubstr("## Bounds")));
  EXPECT_EQ(Json::parse(written("evaluation.json"))["sets"]["attic"]["ransac-moments"]["seeds"],
            Json({"seed1", "seed9", "seed10"}));
}

}  // namespace
}  // namespace geomap::logs
