// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/preferences.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace geomap::viewer {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class PreferencesFile : public ::testing::Test {
 protected:
  void SetUp() override { fs::remove_all(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_ = fs::path(::testing::TempDir()) / "geomap_preferences";
  fs::path file_ = folder_ / "inner" / "viewer.json";
};

TEST_F(PreferencesFile, WhatWasSetIsThereAgainAndFoldersAreMade) {
  Preferences preferences;
  preferences.set("theme.dark", false);
  preferences.set("Point map.size", 2.5);
  preferences.set("bookmark.1", std::string("0 0 1 2 3 4 perspective"));
  preferences.save(file_);
  const Preferences loaded = Preferences::load(file_);
  EXPECT_EQ(loaded, preferences);
  EXPECT_FALSE(loaded.get("theme.dark", true));
  EXPECT_EQ(loaded.get("Point map.size", 1.0), 2.5);
}

TEST_F(PreferencesFile, WithoutAFileEverythingIsAsItIsByDefault) {
  const Preferences none = Preferences::load(file_);
  EXPECT_TRUE(none.get("theme.dark", true));
  EXPECT_EQ(none.get("anything", std::string("else")), "else");
}

TEST_F(PreferencesFile, AValueOfAnotherKindCountsAsNone) {
  Preferences preferences;
  preferences.set("Point map.size", std::string("large"));
  EXPECT_EQ(preferences.get("Point map.size", 1.5), 1.5);
}

TEST_F(PreferencesFile, ABrokenFileIsSaidToBeBroken) {
  fs::create_directories(file_.parent_path());
  for (const char* text : {"", "{", "[1, 2]", "\"text\""}) {
    std::ofstream(file_) << text;
    try {
      Preferences::load(file_);
      ADD_FAILURE() << text;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr(file_.string()));
    }
  }
}

}  // namespace
}  // namespace geomap::viewer
