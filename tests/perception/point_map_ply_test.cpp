// SPDX-License-Identifier: BSD-3-Clause
#include "perception/point_map_ply.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <stdexcept>

namespace geomap::perception {
namespace {

/// A reader that knows no more than the format: header lines, then 15 bytes a point.
struct PlyFile {
  std::vector<std::string> header;
  std::vector<MapPoint> points;
};

PlyFile read_ply(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  PlyFile file;
  for (std::string line; std::getline(in, line) && line != "end_header";) {
    file.header.push_back(line);
  }
  char bytes[15];
  while (in.read(bytes, sizeof bytes)) {
    float xyz[3];
    std::memcpy(xyz, bytes, sizeof xyz);
    MapPoint point;
    point.position = {xyz[0], xyz[1], xyz[2]};
    std::memcpy(point.color.data(), bytes + sizeof xyz, 3);
    file.points.push_back(point);
  }
  EXPECT_EQ(in.gcount(), 0) << "bytes after the last whole point";
  return file;
}

class Ply : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path(::testing::TempDir()) /
            (std::string("geomap_ply_") + test->name() + ".ply");
  }
  void TearDown() override { std::filesystem::remove(path_); }
  std::filesystem::path path_;
};

std::vector<MapPoint> three_points(const Eigen::Vector3d& offset) {
  std::vector<MapPoint> points(3);
  points[0].position = offset + Eigen::Vector3d(0.25, -1.5, 2.125);
  points[1].position = offset + Eigen::Vector3d(-3.0, 0.1, 0.0);
  points[2].position = offset + Eigen::Vector3d(1.0, 1.0, 1.0);
  points[1].color = {255, 0, 10};
  return points;
}

TEST_F(Ply, CoordinatesAreThoseOfTheWorld) {
  for (const double east : {0.0, 1000.0}) {
    const auto points = three_points({east, 0.0, 0.0});
    write_ply(path_, points);
    const PlyFile file = read_ply(path_);
    const std::vector<std::string> header = {"ply",
                                             "format binary_little_endian 1.0",
                                             "element vertex 3",
                                             "property float x",
                                             "property float y",
                                             "property float z",
                                             "property uchar red",
                                             "property uchar green",
                                             "property uchar blue"};
    EXPECT_EQ(file.header, header);
    ASSERT_EQ(file.points.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LT((file.points[i].position - points[i].position).norm(), 1e-4);
      EXPECT_EQ(file.points[i].color, points[i].color);
    }
  }
}

TEST_F(Ply, FarFromTheOriginTheHeaderSaysWhatToAdd) {
  const auto points = three_points({100'000.0, -250'000.0, 30.0});
  write_ply(path_, points);
  const PlyFile file = read_ply(path_);
  ASSERT_EQ(file.header[2].rfind("comment offset ", 0), 0U);
  Eigen::Vector3d offset;
  std::istringstream(file.header[2].substr(15)) >> offset.x() >> offset.y() >> offset.z();
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT((offset + file.points[i].position - points[i].position).norm(), 1e-6);
  }
}

TEST_F(Ply, AnEmptyMapIsAFileWithoutPoints) {
  write_ply(path_, {});
  const PlyFile file = read_ply(path_);
  EXPECT_EQ(file.header[2], "element vertex 0");
  EXPECT_TRUE(file.points.empty());
}

TEST_F(Ply, SaysWhichFileCannotBeWritten) {
  try {
    write_ply("/nonexistent/map.ply", {});
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/nonexistent/map.ply"), std::string::npos);
  }
}

}  // namespace
}  // namespace geomap::perception
