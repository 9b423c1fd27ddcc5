// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/export_ply.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/PolygonMesh.h>
#include <pcl/conversions.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <sstream>

#include "mapping/example_map.hpp"
#include "mapping/export.hpp"

namespace geomap::mapping {
namespace {

using geomap::testing::example_map;

// What another program gets to see.
struct PclMesh {
  pcl::PointCloud<pcl::PointXYZRGB> points;
  std::vector<pcl::Vertices> faces;

  PclMesh(const MapSnapshot& map, bool ascii) {
    const auto path = geomap::testing::fresh_folder() / "map.ply";
    export_map(map, path, {.ascii = ascii, .svg = {}});
    pcl::PolygonMesh mesh;
    EXPECT_EQ(pcl::io::loadPLYFile(path.string(), mesh), 0);
    // PCL's conversion takes the address of the first point, which an empty cloud does not have.
    if (mesh.cloud.width > 0) pcl::fromPCLPointCloud2(mesh.cloud, points);
    faces = mesh.polygons;
  }

  Eigen::Vector3d at(std::size_t i) const { return points.at(i).getVector3fMap().cast<double>(); }

  double area() const {
    double sum = 0.0;
    for (const pcl::Vertices& face : faces) {
      EXPECT_EQ(face.vertices.size(), 3U);
      const auto corner = [&](std::size_t i) {
        return at(static_cast<std::size_t>(face.vertices.at(i)));
      };
      sum += 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
    }
    return sum;
  }
};

class ExportPly : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(AsciiAndBinary, ExportPly, ::testing::Bool());

TEST_P(ExportPly, PclReadsTheWholeAreaBack) {
  const PclMesh mesh(example_map(), GetParam());
  EXPECT_EQ(mesh.points.size(), 4U + 8U + 8U + 4U);
  EXPECT_NEAR(mesh.area(), 12.0 + 0.84 + 5.0 + 0.3, 1e-5);
}

TEST_P(ExportPly, PclReadsWorldCoordinatesAndColours) {
  const PclMesh mesh(example_map({100.0, -50.0, 3.0}), GetParam());
  Eigen::AlignedBox3d floor;
  for (std::size_t i = 0; i < 4; ++i) {
    floor.extend(mesh.at(i));
    EXPECT_EQ(mesh.points.at(i).r, 120);
    EXPECT_EQ(mesh.points.at(i).g, 61);
    EXPECT_EQ(mesh.points.at(i).b, 30);
  }
  EXPECT_LT((floor.min() - Eigen::Vector3d(98.0, -51.5, 3.0)).norm(), 2e-5);
  EXPECT_LT((floor.max() - Eigen::Vector3d(102.0, -48.5, 3.0)).norm(), 2e-5);
}

TEST_P(ExportPly, FarAwayTheWholeMetreOffsetOfTheCommentKeepsTheGrid) {
  const MapSnapshot map = example_map({60000.25, -80000.5, 120.125});
  const PclMesh mesh(map, GetParam());
  const std::string text = to_ply(map, PlyFormat::kAscii);
  const std::string key = "comment offset ";
  std::istringstream words(text.substr(text.find(key) + key.size()));
  Eigen::Vector3d offset;
  words >> offset.x() >> offset.y() >> offset.z();
  EXPECT_EQ(offset, Eigen::Vector3d(offset.array().round()));
  Eigen::AlignedBox3d floor;
  for (std::size_t i = 0; i < 4; ++i) floor.extend(mesh.at(i) + offset);
  EXPECT_LT((floor.min() - Eigen::Vector3d(59998.25, -80002.0, 120.125)).norm(), 2e-6);
}

TEST_P(ExportPly, PclReadsAnEmptyMap) {
  const PclMesh mesh({}, GetParam());
  EXPECT_TRUE(mesh.points.empty());
  EXPECT_TRUE(mesh.faces.empty());
}

TEST(ExportPlyHeader, NearTheOriginThereIsNoOffset) {
  EXPECT_THAT(to_ply(example_map({1000.0, 0.0, 0.0}), PlyFormat::kAscii),
              ::testing::Not(::testing::HasSubstr("offset")));
}

}  // namespace
}  // namespace geomap::mapping
