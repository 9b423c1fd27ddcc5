// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "support/architecture.hpp"

namespace geomap::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kSpdx = "// SPDX-License-Identifier: BSD-3-Clause\n";

/// A small source tree on disk, for the length of a test.
class FakeTree : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    root_ = fs::path(::testing::TempDir()) / (std::string("geomap_tree_") + test->name());
    fs::remove_all(root_);
  }
  void TearDown() override { fs::remove_all(root_); }

  void add_raw(const std::string& path, const std::string& text) {
    fs::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << text;
  }
  /// A well-formed file with the given include lines.
  void add(const std::string& path, const std::string& includes = "") {
    add_raw(path, kSpdx + std::string(path.ends_with(".hpp") ? "#pragma once\n" : "") + includes);
  }
  std::vector<std::string> breaches() const { return architecture_breaches(root_); }

  fs::path root_;
};

TEST(Architecture, TheProjectKeepsItsRules) {
  EXPECT_THAT(architecture_breaches(GEOMAP_SOURCE_DIR), IsEmpty());
}

TEST(Architecture, TheProjectIsWhereTheCheckLooks) {
  EXPECT_TRUE(fs::exists(fs::path(GEOMAP_SOURCE_DIR) / "geometry" / "plane.hpp"));
}

TEST_F(FakeTree, ATreeThatKeepsTheRulesHasNoBreach) {
  add("geometry/plane.hpp", "#include <Eigen/Core>\n");
  add("messaging/encode.hpp", "#include <lcm/lcm-cpp.hpp>\n#include \"geometry/plane.hpp\"\n");
  add("perception/extract.cpp", "#include <pcl/point_types.h>\n#include \"geometry/plane.hpp\"\n");
  add("perception/planes_process.hpp", "#include \"messaging/encode.hpp\"\n");
  add("mapping/map_messages.cpp", "#include \"geomap/map_t.hpp\"\n");
  add("mapping/mapper_main.cpp", "#include <lcm/lcm-cpp.hpp>\n");
  add("viewer/core.cpp", "#include \"mapping/map_feature.hpp\"\n");
  add("logs/pipeline.hpp", "#include \"messaging/encode.hpp\"\n#include \"perception/a.hpp\"\n");
  add("tests/mapping/merge_test.cpp", "#include \"support/scene.hpp\"\n#include <lcm/lcm.h>\n");
  EXPECT_THAT(breaches(), IsEmpty());
}

TEST_F(FakeTree, AnAlgorithmThatKnowsLcmIsFound) {
  add("mapping/merge.cpp", "#include <lcm/lcm-cpp.hpp>\n");
  add("perception/extract.cpp", "#include <vector>\n\n#include \"geomap/plane_t.hpp\"\n");
  add("perception/icp.cpp", "#include \"messaging/config.hpp\"\n");
  EXPECT_THAT(breaches(), ElementsAre(HasSubstr("mapping/merge.cpp:2: only processes"),
                                      HasSubstr("perception/extract.cpp:4: only processes"),
                                      HasSubstr("perception/icp.cpp:2: only processes")));
}

TEST_F(FakeTree, AnAlgorithmThatKnowsLcmThroughAnotherFileIsFound) {
  add("mapping/map_journal.hpp", "#include \"messaging/log_writer.hpp\"\n");
  add("mapping/merge.cpp", "#include \"mapping/map_journal.hpp\"\n");
  EXPECT_THAT(breaches(), ElementsAre(HasSubstr("must not include mapping/map_journal.hpp")));
}

TEST_F(FakeTree, EveryArrowUpwardsIsFound) {
  add("geometry/plane.cpp", "#include \"mapping/map_feature.hpp\"\n");
  add("drivers/source.cpp", "#include \"perception/icp.hpp\"\n");
  add("messaging/convert.cpp", "#include \"mapping/map_feature.hpp\"\n");
  add("perception/extract.cpp", "#include \"mapping/map_feature.hpp\"\n");
  add("mapping/merge.cpp", "#include \"perception/extract.hpp\"\n");
  add("logs/replay.cpp", "#include \"viewer/core.hpp\"\n");
  add("logs/replay_main.cpp", "#include \"support/scene.hpp\"\n");
  EXPECT_THAT(breaches(), ElementsAre(HasSubstr("drivers/ must not include perception/"),
                                      HasSubstr("geometry/ must not include mapping/"),
                                      HasSubstr("logs/ must not include viewer/"),
                                      HasSubstr("logs/ must not include support/"),
                                      HasSubstr("mapping/ must not include perception/"),
                                      HasSubstr("messaging/ must not include mapping/"),
                                      HasSubstr("perception/ must not include mapping/")));
}

TEST_F(FakeTree, AProcessMayKnowLcmButNotAFolderAboveItsOwn) {
  add("perception/register_process.cpp", "#include \"mapping/mapper_process.hpp\"\n");
  EXPECT_THAT(breaches(), ElementsAre(HasSubstr("perception/ must not include mapping/")));
}

TEST_F(FakeTree, AHeaderWithAHeavyLibraryIsFound) {
  for (const std::string library : {"CGAL/a.h", "CLI/CLI.hpp", "nlohmann/json.hpp", "pcl/a.h",
                                    "spdlog/spdlog.h", "yaml-cpp/yaml.h"}) {
    add("logs/report.hpp", "#include <" + library + ">\n");
    EXPECT_THAT(breaches(), ElementsAre(HasSubstr("must not include <" + library)));
  }
}

TEST_F(FakeTree, ACycleWithinAFolderIsFound) {
  add("geometry/a.hpp", "#include \"geometry/b.hpp\"\n");
  add("geometry/b.hpp", "#include \"geometry/c.hpp\"\n");
  add("geometry/c.hpp", "#include \"geometry/a.hpp\"\n");
  EXPECT_THAT(breaches(), ElementsAre(HasSubstr("a cycle of includes through geometry/a.hpp")));
}

TEST_F(FakeTree, MissingLinesAreFound) {
  add_raw("geometry/a.hpp", kSpdx);
  add_raw("geometry/b.cpp", "#include <vector>\n");
  add_raw("tests/geometry/c_test.cpp", "");
  EXPECT_THAT(breaches(),
              ElementsAre("geometry/a.hpp:1: no #pragma once", "geometry/b.cpp:1: no SPDX line",
                          "tests/geometry/c_test.cpp:1: no SPDX line"));
}

}  // namespace
}  // namespace geomap::testing
