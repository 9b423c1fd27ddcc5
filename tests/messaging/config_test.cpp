// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "messaging/camera_config.hpp"
#include "messaging/config_checks.hpp"
#include "messaging/temporary_folder.hpp"

namespace geomap::messaging {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr const char* kDefaults = R"(
noise: auto
merge:
  max_angle_deg: 3.0  # a comment
  min_overlap: 0.05
  mode: moments
  fine: true
  passes: 4
  gains: [1, 0.5]
ransac:
  min_inliers: 200
)";

struct MergeSettings {
  double max_angle_deg = 3.0;
  double min_overlap = 0.05;
  std::string mode = "moments";
  bool fine = true;
  int passes = 4;
  std::vector<double> gains = {1.0, 0.5};

  std::vector<std::string> validate() const {
    std::vector<std::string> messages;
    if (max_angle_deg <= 0.0) messages.push_back("max_angle_deg must be positive");
    if (passes < 1) messages.push_back("passes must be at least 1");
    return messages;
  }

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& visitor) {
    visitor("max_angle_deg", self.max_angle_deg);
    visitor("min_overlap", self.min_overlap);
    visitor("mode", self.mode);
    visitor("fine", self.fine);
    visitor("passes", self.passes);
    visitor("gains", self.gains);
  }
};

Config parse(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return Config::from_text(kDefaults, text, "my.yaml", overrides);
}

std::string message_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse(text, overrides).read<MergeSettings>("merge");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Config, ASectionIsReadIntoItsStruct) {
  const auto merge = parse("merge: {max_angle_deg: 5, mode: paper, fine: false, gains: [2]}")
                         .read<MergeSettings>("merge");
  EXPECT_EQ(merge.max_angle_deg, 5.0);
  EXPECT_EQ(merge.min_overlap, 0.05);
  EXPECT_EQ(merge.mode, "paper");
  EXPECT_FALSE(merge.fine);
  EXPECT_EQ(merge.passes, 4);
  EXPECT_THAT(merge.gains, ElementsAre(2.0));
}

TEST(Config, OverridesWinOverTheFileAndLaterOnesOverEarlierOnes) {
  const Config config = parse("merge:\n  passes: 5\n", {"merge.passes=6", "merge.passes=7"});
  EXPECT_EQ(config.get<int>("merge.passes"), 7);
}

TEST(Config, OverridesTakeEveryType) {
  const auto merge =
      parse("", {"merge.fine=false", "merge.mode=a=b", "merge.gains=3,4", "merge.min_overlap=1e-3"})
          .read<MergeSettings>("merge");
  EXPECT_FALSE(merge.fine);
  EXPECT_EQ(merge.mode, "a=b");
  EXPECT_THAT(merge.gains, ElementsAre(3.0, 4.0));
  EXPECT_EQ(merge.min_overlap, 1e-3);
}

TEST(Config, ATextMayLookLikeANumber) {
  EXPECT_EQ(parse("", {"noise=1.5"}).get<std::string>("noise"), "1.5");
  EXPECT_EQ(parse("noise: 1.5").get<std::string>("noise"), "1.5");
}

TEST(Config, AnEmptyFileOrSectionChangesNothing) {
  EXPECT_EQ(parse("").to_yaml(), parse("merge:\n").to_yaml());
  EXPECT_EQ(parse("# only a comment\n").hash(), parse("").hash());
}

TEST(Config, AnUnknownKeyNamesFileLineAndTheNearestKnownOne) {
  EXPECT_THAT(message_of("merge:\n  max_angel_deg: 5\n"),
              AllOf(HasSubstr("'merge.max_angel_deg'"), HasSubstr("my.yaml:2"),
                    HasSubstr("'merge.max_angle_deg'"), Not(HasSubstr("\n"))));
  EXPECT_THAT(message_of("", {"merge.passs=5"}),
              AllOf(HasSubstr("--set"), HasSubstr("'merge.passes'")));
}

TEST(Config, AForgottenSectionIsFoundToo) {
  EXPECT_THAT(message_of("min_inlier: 5\n"), HasSubstr("'ransac.min_inliers'"));
}

TEST(Config, WrongTypesAreRefusedWithFileAndLine) {
  EXPECT_THAT(message_of("\nmerge:\n  passes: many\n"),
              AllOf(HasSubstr("my.yaml:3"), HasSubstr("a number"), HasSubstr("'many'")));
  EXPECT_THAT(message_of("merge: {fine: 1}"), HasSubstr("true or false"));
  EXPECT_THAT(message_of("merge: {gains: 1}"), HasSubstr("a list of numbers"));
  EXPECT_THAT(message_of("merge: {gains: [1, x]}"), HasSubstr("'x' is none"));
  EXPECT_THAT(message_of("merge: {gains: [[1], 2]}"), HasSubstr("list of numbers"));
  EXPECT_THAT(message_of("merge: {passes: [1]}"), HasSubstr("not a list"));
  EXPECT_THAT(message_of("merge: {mode: [a]}"), HasSubstr("a text"));
  EXPECT_THAT(message_of("merge: {passes: 2.5}"), HasSubstr("whole number"));
  EXPECT_THAT(message_of("merge: {passes: 1e12}"), HasSubstr("whole number"));
  EXPECT_THAT(message_of("merge: {passes: nan}"), HasSubstr("a number"));
  EXPECT_THAT(message_of("merge: {passes: }"), HasSubstr("has no value"));
  EXPECT_THAT(message_of("merge: 5"), HasSubstr("is a section"));
}

TEST(Config, WhatIsNotYamlIsRefusedWithItsLine) {
  EXPECT_THAT(message_of("merge:\n  passes: [1, 2\n"), HasSubstr("my.yaml:"));
  EXPECT_THAT(message_of("just words"), HasSubstr("my.yaml"));
  EXPECT_THAT(message_of("merge: {passes: 1}\nmerge: {passes: 2}"), HasSubstr("given twice"));
}

TEST(Config, AnOverrideWithoutAValueIsRefused) {
  EXPECT_THAT(message_of("", {"merge.passes"}), HasSubstr("KEY=VALUE"));
  EXPECT_THAT(message_of("", {"=5"}), HasSubstr("KEY=VALUE"));
}

TEST(Config, AllMessagesOfTheStructAreShown) {
  EXPECT_THAT(message_of("merge: {max_angle_deg: -1, passes: 0}"),
              AllOf(HasSubstr("'merge'"), HasSubstr("max_angle_deg must be positive"),
                    HasSubstr("passes must be at least 1")));
}

TEST(Config, WhatIsInForceCanBeLoadedAgain) {
  const Config config = parse("merge: {min_overlap: 0.1, mode: \"a: b\"}", {"noise="});
  const Config again = Config::from_text(kDefaults, config.to_yaml(), "config_used.yaml");
  EXPECT_EQ(again.to_yaml(), config.to_yaml());
  EXPECT_EQ(again.hash(), config.hash());
  EXPECT_EQ(again.get<std::string>("merge.mode"), "a: b");
  EXPECT_EQ(again.get<std::string>("noise"), "");
}

TEST(Config, NumbersReadBackToTheLastBit) {
  const Config config = parse("", {"merge.min_overlap=0.1234567890123456789"});
  const Config again = Config::from_text(kDefaults, config.to_yaml(), "config_used.yaml");
  EXPECT_EQ(again.get<double>("merge.min_overlap"), 0.1234567890123456789);
}

TEST(Config, TheHashDependsOnValuesNotOnHowTheyWereGiven) {
  const std::string hash = parse("").hash();
  EXPECT_EQ(hash.size(), 64U);
  EXPECT_EQ(parse("merge: {passes: 4.0}", {"merge.gains=[1.0, 5e-1]"}).hash(), hash);
  EXPECT_NE(parse("merge: {passes: 5}").hash(), hash);
}

/// SHA-256 of "a=1\n", from an independent tool.
TEST(Config, TheHashIsSha256) {
  EXPECT_EQ(Config::from_text("a: 1", "", "").hash(),
            "fe3209d6d4f51935b391288a43df48d9ddece1a992597ae53387ca16611a9179");
}

TEST(Config, ASettingThatNobodyDefinedIsNamed) {
  EXPECT_THROW(parse("").get<int>("merge.missing"), ConfigError);
  EXPECT_THROW(parse("").read<MergeSettings>("nowhere"), ConfigError);
}

using ConfigFile = testing::TemporaryFolder;

TEST_F(ConfigFile, IsLoadedOverTheDefaultsOfAllPrograms) {
  const std::string file = write_file("my.yaml", "driver_camera: {depth: {fx: 585}}\n");
  const std::vector<std::string> overrides = {"driver_camera.depth.fy=584"};
  const auto camera = Config::load(file, overrides).read<CameraConfig>("driver_camera.depth");
  EXPECT_EQ(camera.fx, 585.0);
  EXPECT_EQ(camera.fy, 584.0);
  EXPECT_EQ(camera.width, 640);
}

TEST_F(ConfigFile, ThatIsMissingIsNamed) {
  try {
    Config::load(path("missing.yaml"));
    FAIL() << "a missing file was loaded";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("missing.yaml"));
  }
}

TEST(DefaultYaml, HoldsTheDefaultsOfTheCameraSettings) {
  testing::ConfigChecks checks;
  checks.expect_defaults<CameraConfig>("driver_camera.depth");
  checks.expect_defaults<CameraConfig>("driver_camera.color");
  EXPECT_THAT(checks.differences(), IsEmpty());
}

TEST(ConfigChecks, FindDifferencesAndKeysThatNobodyReads) {
  testing::ConfigChecks checks(parse("", {"merge.passes=9", "merge.mode=other"}));
  checks.expect_defaults<MergeSettings>("merge");
  EXPECT_THAT(checks.differences(),
              ElementsAre(HasSubstr("merge.mode"), HasSubstr("merge.passes")));
  EXPECT_THAT(checks.unread_keys(), ElementsAre("noise", "ransac.min_inliers"));
}

}  // namespace
}  // namespace geomap::messaging
