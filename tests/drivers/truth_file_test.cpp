// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/truth_file.hpp"

#include <fstream>

#include "drivers/data_set_writer.hpp"
#include "drivers/frame_source.hpp"
#include "support/recordings.hpp"

namespace geomap::drivers {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// A wall with a window, of which two parts were seen; one nobody saw; a reference plane.
Truth example() {
  TruthPlane wall;
  wall.name = "wall: \"north\", with #1 window";
  wall.plane = geometry::Plane::through({4, 3, 0}, Vector3d(3, 4, 0) / 5.0);
  const auto on_wall = [](double u, double z) { return Vector3d(4 - 0.8 * u, 3 + 0.6 * u, z); };
  wall.polygon = {{on_wall(0, 0), on_wall(4, 0), on_wall(4, 2.5), on_wall(0, 2.5)},
                  {{on_wall(1, 1), on_wall(1, 2), on_wall(2, 2), on_wall(2, 1)}}};
  wall.area = 9.0;
  wall.visible_area = 1.25;
  wall.seen = true;
  wall.visible = {{{on_wall(0, 0), on_wall(1, 0), on_wall(1, 1)}, {}},
                  {{on_wall(3, 0), on_wall(4, 0), on_wall(4, 1), on_wall(3, 1)}, {}}};
  TruthPlane hidden;
  hidden.name = "true";
  hidden.plane = {Vector3d(0, 0, -1), 0.1};
  hidden.polygon = {{{0, 0, 0.1}, {0, 1, 0.1}, {1, 0, 0.1}}, {}};
  hidden.area = 0.5;
  TruthPlane reference;
  reference.name = "floor";
  reference.plane = geometry::Plane::through({1, 2, 3}, Vector3d(1, 2, 2) / 3.0);
  reference.seen = true;
  reference.centroid = Vector3d(1, 2, 3);
  return {{wall, hidden, reference}};
}

void expect_equal(const TruthPolygon& a, const TruthPolygon& b) {
  ASSERT_EQ(a.outer.size(), b.outer.size());
  for (std::size_t i = 0; i < a.outer.size(); ++i) {
    EXPECT_LT((a.outer[i] - b.outer[i]).norm(), 1e-6);
  }
  ASSERT_EQ(a.holes.size(), b.holes.size());
  for (std::size_t i = 0; i < a.holes.size(); ++i) {
    expect_equal({a.holes[i], {}}, {b.holes[i], {}});
  }
}

TEST(TruthFile, IsReadAsItWasWritten) {
  testing::TemporaryFolder folder;
  const fs::path path = folder.path() / "room.truth.yaml";
  write_truth(example(), path);
  const Truth truth = read_truth(path);
  const Truth expected = example();
  ASSERT_EQ(truth.planes.size(), expected.planes.size());
  for (std::size_t i = 0; i < expected.planes.size(); ++i) {
    const TruthPlane &a = truth.planes[i], &b = expected.planes[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.plane.normal, b.plane.normal);
    EXPECT_EQ(a.plane.d, b.plane.d);
    EXPECT_EQ(a.area, b.area);
    EXPECT_EQ(a.visible_area, b.visible_area);
    EXPECT_EQ(a.seen, b.seen);
    EXPECT_EQ(a.centroid, b.centroid);
    expect_equal(a.polygon, b.polygon);
    ASSERT_EQ(a.visible.size(), b.visible.size());
    for (std::size_t k = 0; k < a.visible.size(); ++k) expect_equal(a.visible[k], b.visible[k]);
  }
}

TEST(TruthFile, TheSameTruthGivesTheSameBytesAndNothingElseIsLeft) {
  testing::TemporaryFolder folder;
  write_truth(example(), folder.path() / "a.yaml");
  write_truth(read_truth(folder.path() / "a.yaml"), folder.path() / "b.yaml");
  EXPECT_EQ(read_text(folder.path() / "a.yaml"), read_text(folder.path() / "b.yaml"));
  write_truth({}, folder.path() / "a.yaml");
  EXPECT_TRUE(read_truth(folder.path() / "a.yaml").planes.empty());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 2);
}

TEST(TruthFile, PointsAreRoundedToAMicrometre) {
  testing::TemporaryFolder folder;
  const fs::path path = folder.path() / "truth.yaml";
  Truth truth = example();
  truth.planes[1].polygon.outer[0] = Vector3d(1.0 / 3.0, -1e-9, 0.1);
  write_truth(truth, path);
  EXPECT_THAT(read_text(path), HasSubstr("outer: [[0.333333, 0, 0.1], "));
}

TEST(TruthFile, ALongNormalIsShortenedWithItsDistance) {
  testing::TemporaryFolder folder;
  const fs::path path = folder.path() / "truth.yaml";
  std::ofstream(path) << "planes: [{name: a, normal: [0, 0, 2], d: 3, centroid: [0, 0, -1.5]}]\n";
  const geometry::Plane plane = read_truth(path).planes.at(0).plane;
  EXPECT_EQ(plane.normal, Vector3d::UnitZ());
  EXPECT_EQ(plane.d, 1.5);
}

// A valid file of one plane, one key a line.
const std::vector<std::string> kLines = {
    "planes:",         "  - name: table", "    normal: [0, 0, 1]",
    "    d: -1",       "    area: 1",     "    visible_area: 0",
    "    seen: false", "    polygon:",    "      outer: [[0, 0, 1], [1, 0, 1], [1, 1, 1]]",
    "      holes: []", "    visible: []",
};

TEST(TruthFile, EveryFaultIsOneLineThatNamesFileAndLine) {
  struct Fault {
    std::size_t line;  // that is replaced, counted from 1
    std::string text;
    std::string says;
  };
  const Fault faults[] = {
      {1, "walls:", "truth.yaml:1: 'planes' is missing"},
      {1, "planes: 3\nwalls:", "truth.yaml:1: 'planes' must be a list"},
      {2, "  - label: table", "truth.yaml:2: 'name' is missing"},
      {3, "", "truth.yaml:2: 'normal' is missing"},
      {3, "    normal: [0, 0, 0]", "truth.yaml:3: 'normal' has no direction"},
      {3, "    normal: [0, 1]", "truth.yaml:3: 'normal' must be a list of 3 numbers"},
      {3, "    normal: [0, 0, .nan]", "truth.yaml:3: 'normal' must be a list of 3 numbers"},
      {4, "    d: inf", "truth.yaml:4: 'd' must be a number"},
      {4, "", "truth.yaml:2: 'd' is missing"},
      {5, "    area: 1e999", "truth.yaml:5: 'area' must be a number"},
      {6, "    visible_area: []", "truth.yaml:6: 'visible_area' must be a number"},
      {7, "    seen: maybe", "truth.yaml:7: 'seen' must be true or false"},
      {7, "", "truth.yaml:2: 'seen' is missing"},
      {8, "    polygon: 3\n    wall:", "truth.yaml:8: expected KEY: VALUE pairs"},
      {9, "      outer: [[0, 0, 1], [1, 0, 1]]",
       "truth.yaml:9: 'outer' has a ring of fewer than three vertices"},
      {9, "      outer: [[0, 0, 1], [1, 0, 1],\n        [1, 1, 1.0011]]",
       "truth.yaml:9: 'outer' has a vertex more than 1 mm off its plane"},
      {9, "      outer: [[0, 0, 1], [1, 0, 1], [60000, 1, 1]]",
       "truth.yaml:9: 'outer' has a vertex beyond 10 km"},
      {11, "    visible: [{outer: [[0, 0, 1]], holes: []}]",
       "truth.yaml:11: 'outer' has a ring of fewer than three vertices"},
      {9, "      outer: [[0, 0, 1]", "truth.yaml:10: not YAML"},
  };
  testing::TemporaryFolder folder;
  const fs::path path = folder.path() / "truth.yaml";
  const auto write = [&](const Fault& fault) {
    std::ofstream file(path);
    for (std::size_t i = 1; i <= kLines.size(); ++i) {
      file << (i == fault.line ? fault.text : kLines[i - 1]) << '\n';
    }
  };
  write({0, "", ""});
  EXPECT_EQ(read_truth(path).planes.size(), 1U);
  for (const Fault& fault : faults) {
    write(fault);
    EXPECT_THAT(
        [&] { read_truth(path); },
        ThrowsMessage<SourceError>(AllOf(HasSubstr(fault.says), ::testing::Not(HasSubstr("\n")))))
        << fault.text;
  }
}

TEST(TruthFile, WhatCannotBeReadOrWrittenIsNamed) {
  testing::TemporaryFolder folder;
  const fs::path missing = folder.path() / "missing" / "truth.yaml";
  EXPECT_THAT([&] { read_truth(missing); },
              ThrowsMessage<SourceError>(EndsWith("missing/truth.yaml: no such file")));
  EXPECT_THAT([&] { write_truth(example(), missing); },
              ThrowsMessage<SourceError>(EndsWith("missing/truth.yaml: cannot be written")));
  EXPECT_THROW(read_truth(folder.path()), SourceError);
}

TEST(TruthFile, ReferencePlanesOfARecordingHaveCentroids) {
  GEOMAP_REQUIRE_RECORDING(path, "redkitchen/reference_planes.yaml");
  const Truth truth = read_truth(path);
  ASSERT_EQ(truth.planes.size(), 5U);
  for (const TruthPlane& plane : truth.planes) {
    EXPECT_TRUE(plane.seen) << plane.name;
    EXPECT_TRUE(plane.polygon.outer.empty()) << plane.name;
    EXPECT_NEAR(plane.plane.normal.norm(), 1.0, 1e-12) << plane.name;
    ASSERT_TRUE(plane.centroid) << plane.name;
    EXPECT_LT(std::abs(plane.plane.signed_distance(*plane.centroid)), 0.01) << plane.name;
  }
}

}  // namespace
}  // namespace geomap::drivers
