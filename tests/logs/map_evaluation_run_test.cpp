// SPDX-License-Identifier: BSD-3-Clause
#include "logs/map_evaluation_run.hpp"

#include <nlohmann/json.hpp>

#include "drivers/frame_source.hpp"
#include "drivers/truth_file.hpp"
#include "logs/drawn_truth.hpp"
#include "logs/evaluation.hpp"
#include "mapping/map_journal.hpp"
#include "mapping/scene.hpp"
#include "messaging/temporary_folder.hpp"

namespace geomap::logs {
namespace {

using Eigen::Vector3d;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;
using Json = nlohmann::json;

// A floor and a wall as a camera sees them that stands in front of both.
const testing::Rectangle kFloor = {"floor", {0, 1, 0}, Vector3d::UnitX(), Vector3d::UnitY(),
                                   1.0,     0.5,       {90, 90, 90},      {}};
const testing::Rectangle kWall = {"wall", {0, 3, 1}, Vector3d::UnitX(), Vector3d::UnitZ(),
                                  1.0,    1.0,       {90, 90, 90},      {}};

class EvaluatedFiles : public testing::TemporaryFolder {
 protected:
  std::string write_map(const std::string& name, const std::vector<testing::Rectangle>& scene) {
    mapping::GeometricMap map(mapping::MergeConfig{}, mapping::HistoryConfig{});
    map.apply(testing::Observer().observe(1000, scene, testing::look_at({0, -1, 1}, {0, 3, 0.5})));
    mapping::save_map(path(name), map);
    return path(name);
  }

  std::string write_truth_of_both() {
    drivers::write_truth(
        {{testing::draw_truth("floor | <b>", {kFloor.center, kFloor.u, Vector3d::UnitZ()},
                              {-1, -0.5, 1, 0.5}, {{-1, -0.5, 1, 0.5}}),
          testing::draw_truth("wall", {kWall.center, kWall.u, -Vector3d::UnitY()}, {-1, -1, 1, 1},
                              {{-1, -1, 1, 1}}),
          testing::draw_truth("behind", {{0, -5, 1}, kWall.u, Vector3d::UnitY()}, {-1, -1, 1, 1},
                              {})}},
        path("truth.yaml"));
    return path("truth.yaml");
  }

  Json written(const EvaluationOptions& options) const {
    write_evaluation(evaluate(options), path("new/out"));
    return Json::parse(read_file(path("new/out/evaluation.json")));
  }
};

TEST_F(EvaluatedFiles, TheJsonHoldsTheFiguresUnderTheirKeys) {
  testing::Rectangle wall = kWall;
  wall.center.y() += 0.02;
  testing::Rectangle ghost = kFloor;
  ghost.center = Vector3d(2.5, 2, 0.3);
  const std::string map = write_map("map.lcmlog", {kFloor, wall, ghost});
  const std::string truth = write_truth_of_both();
  write_file("report.json", R"({"planes_extracted": 12})");
  const Json json = written({.map = {.map = map, .truth = truth}});

  EXPECT_EQ(json["map"], map);
  EXPECT_EQ(json["truth"], truth);
  EXPECT_TRUE(json["against"].is_null());
  EXPECT_NEAR(json["d_dist"].get<double>(), 0.01, 1e-6);
  EXPECT_NEAR(json["d_dist_local"].get<double>(), 0.01, 1e-6);
  EXPECT_NEAR(json["d_coeff"].get<double>(), 0.01, 1e-6);
  EXPECT_NEAR(json["rms_p"].get<double>(), 0.01, 1e-6);
  EXPECT_NEAR(json["d_angle"].get<double>(), 0.0, 1e-6);
  EXPECT_EQ(json["recall"], 1.0);
  EXPECT_NEAR(json["precision"].get<double>(), 2.0 / 3.0, 1e-9);
  EXPECT_EQ(json["features_per_component"], 1.0);
  EXPECT_NEAR(json["area_iou"].get<double>(), 1.0, 1e-3);
  EXPECT_LT(json["hull_distance"]["max"].get<double>(), 1e-3);
  EXPECT_LE(json["hull_distance"]["mean"], json["hull_distance"]["max"]);
  EXPECT_EQ(json["reduction_ratio"], 4.0);
  EXPECT_EQ(json["map_features_counted"], 3);
  ASSERT_EQ(json["false_features"].size(), 1U);
  EXPECT_EQ(json["false_features"][0]["id"], "1000-2");
  EXPECT_NEAR(json["false_features"][0]["area"].get<double>(), 2.0, 1e-3);
  for (const char* key : {"ate", "ate_anchored", "rpe", "trajectory", "associated"}) {
    EXPECT_TRUE(json.contains(key) && json[key].is_null()) << key;
  }
}

TEST_F(EvaluatedFiles, EveryPlaneHasItsFigures) {
  const Json json =
      written({.map = {.map = write_map("map.lcmlog", {kWall}), .truth = write_truth_of_both()}});
  const Json& planes = json["planes"];
  ASSERT_EQ(planes.size(), 3U);
  EXPECT_EQ(planes[0]["name"], "floor | <b>");
  EXPECT_EQ(planes[0]["features"], 0);
  EXPECT_EQ(planes[0]["components"], 1);
  EXPECT_TRUE(planes[0]["d_angle"].is_null());
  EXPECT_TRUE(planes[0]["hull_distance"].is_null());
  EXPECT_EQ(planes[0]["area_iou"], 0.0);
  EXPECT_EQ(planes[1]["seen"], true);
  EXPECT_EQ(planes[1]["features"], 1);
  for (const char* key : {"d_coeff", "d_angle", "d_dist", "d_dist_local", "rms_p"}) {
    EXPECT_LT(planes[1][key].get<double>(), 1e-6) << key;
  }
  for (const char* key : {"area", "visible_area", "map_area"}) {
    EXPECT_NEAR(planes[1][key].get<double>(), 4.0, 1e-3) << key;
  }
  EXPECT_EQ(planes[2]["seen"], false);
  EXPECT_EQ(planes[2]["components"], 0);
  EXPECT_TRUE(planes[2]["area_iou"].is_null());
  EXPECT_EQ(json["recall"], 0.5);
}

TEST_F(EvaluatedFiles, TheReportHoldsTablesAndTheFalseFeatures) {
  testing::Rectangle ghost = kFloor;
  ghost.center = Vector3d(2.5, 2, 0.3);
  const EvaluationOptions options = {
      .map = {.map = write_map("map.lcmlog", {kWall, ghost}), .truth = write_truth_of_both()}};
  written(options);
  const std::string report = read_file(path("new/out/evaluation.md"));
  EXPECT_THAT(report, HasSubstr("# Map map.lcmlog against truth.yaml\n"));
  EXPECT_THAT(report, HasSubstr("1 of 2 features"));
  EXPECT_THAT(report, HasSubstr("| recall | 0.500 |"));
  EXPECT_THAT(report, HasSubstr("| planes extracted for each feature | - | 16.14 |"));
  EXPECT_THAT(report, HasSubstr("| floor \\| <b> | 0 | 1 | - |"));
  EXPECT_THAT(report, HasSubstr("| wall | 1 | 1 | 0.00 |"));
  EXPECT_THAT(report, Not(HasSubstr("| behind |")));
  EXPECT_THAT(report, HasSubstr("Planes that could not be seen: 1."));
  EXPECT_THAT(report, HasSubstr("| 1000-1 | 2.000 |"));
  EXPECT_THAT(report, Not(HasSubstr("# Trajectory")));
  const std::string summary = summary_text(evaluate(options));
  EXPECT_THAT(summary, HasSubstr("map: 1 of 2 features belong to a known surface"));
  EXPECT_THAT(summary, Not(HasSubstr("ATE")));
}

TEST_F(EvaluatedFiles, AMapAndATrajectoryShareOneReport) {
  Trajectory trajectory;
  for (int i = 0; i <= 20; ++i) {
    trajectory.emplace_back(1'000'000 + 100'000 * i,
                            Eigen::Isometry3d(Eigen::Translation3d(0.1 * i, 0.01 * i * i, 0)));
  }
  write_trajectory(path("a.tum"), trajectory);
  const Json json =
      written({.map = {.map = write_map("map.lcmlog", {kWall}), .truth = write_truth_of_both()},
               .trajectory = path("a.tum"),
               .reference = path("a.tum")});
  EXPECT_EQ(json["recall"], 0.5);
  EXPECT_NEAR(json["ate"]["rmse"].get<double>(), 0.0, 1e-9);
  const std::string report = read_file(path("new/out/evaluation.md"));
  EXPECT_THAT(report, HasSubstr("# Map map.lcmlog against"));
  EXPECT_THAT(report, HasSubstr("\n\n# Trajectory a.tum against a.tum"));
}

TEST_F(EvaluatedFiles, AMapAgainstItselfIsPerfect) {
  const std::string map = write_map("map.lcmlog", {kFloor, kWall});
  const Json json = written({.map = {.map = map, .against = map}});
  EXPECT_EQ(json["against"], map);
  EXPECT_TRUE(json["truth"].is_null());
  EXPECT_EQ(json["recall"], 1.0);
  EXPECT_EQ(json["precision"], 1.0);
  EXPECT_NEAR(json["area_iou"].get<double>(), 1.0, 1e-3);
  EXPECT_EQ(json["false_features"], Json::array());
  EXPECT_TRUE(json["reduction_ratio"].is_null());
  EXPECT_THAT(read_file(path("new/out/evaluation.md")), Not(HasSubstr("paper")));
}

TEST_F(EvaluatedFiles, TheReportThatIsNamedCounts) {
  const std::string map = write_map("map.lcmlog", {kFloor, kWall});
  const auto ratio = [&](const std::string& report) {
    return evaluate_map_files({.map = map, .against = map, .report = report}).reduction_ratio();
  };
  write_file("report.json", "{}");
  EXPECT_FALSE(ratio(""));
  write_file("report.json", "no JSON");
  EXPECT_FALSE(ratio(""));
  write_file("report.json", R"({"planes_extracted": 7})");
  EXPECT_EQ(ratio(""), 3.5);
  EXPECT_EQ(ratio(write_file("other.json", R"({"planes_extracted": 9})")), 4.5);
  EXPECT_THAT([&] { ratio(write_file("bad.json", R"({"planes_extracted": "9"})")); },
              ThrowsMessage<std::runtime_error>(EndsWith("bad.json is no report with "
                                                         "planes_extracted")));
  EXPECT_THROW(ratio(path("missing.json")), std::runtime_error);
}

TEST_F(EvaluatedFiles, AFileThatCannotBeUsedIsNamed) {
  const std::string map = write_map("map.lcmlog", {kFloor});
  const std::string junk = write_file("junk", "planes: [{name: x}]\n");
  EXPECT_THAT([&] { evaluate({.map = {.map = path("missing"), .truth = junk}}); },
              ThrowsMessage<std::runtime_error>(HasSubstr("missing")));
  EXPECT_THAT([&] { evaluate({.map = {.map = map, .truth = junk}}); },
              ThrowsMessage<drivers::SourceError>(EndsWith("junk:1: 'normal' is missing")));
  EXPECT_THAT([&] { evaluate({.map = {.map = map, .against = junk}}); },
              ThrowsMessage<std::runtime_error>(HasSubstr("junk")));
}

TEST(UsageFault, EveryWrongChoiceOfFilesIsNamed) {
  EXPECT_EQ(usage_fault({.map = {.map = "m", .truth = "t"}}), "");
  EXPECT_EQ(usage_fault({.map = {.map = "m", .against = "n", .report = "r"}}), "");
  EXPECT_EQ(usage_fault({.map = {}, .trajectory = "a", .reference = "b"}), "");
  EXPECT_THAT(usage_fault({}), HasSubstr("nothing to evaluate"));
  EXPECT_EQ(usage_fault({.map = {.map = "m"}}), "--map needs --truth or --against");
  EXPECT_EQ(usage_fault({.map = {.map = "m", .truth = "t", .against = "n"}}),
            "--truth excludes --against");
  EXPECT_EQ(usage_fault({.map = {.map = "", .truth = "t"}}), "--truth needs --map");
  EXPECT_EQ(usage_fault({.map = {.map = "", .truth = "", .against = "n"}}),
            "--against needs --map");
  EXPECT_EQ(usage_fault({.map = {.report = "r"}, .trajectory = "a", .reference = "b"}),
            "--report needs --map");
  EXPECT_EQ(usage_fault({.map = {}, .trajectory = "a"}), "--trajectory needs --reference");
  EXPECT_EQ(usage_fault({.map = {.map = "m", .truth = "t"}, .reference = "b"}),
            "--reference needs --trajectory");
  EXPECT_THROW(evaluate({}), std::invalid_argument);
}

}  // namespace
}  // namespace geomap::logs
