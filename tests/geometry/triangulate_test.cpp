// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/triangulate.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/polygon_clip.hpp"
#include "geometry/random_polygons.hpp"

namespace geomap::geometry {
namespace {

using testing::box_ring;
using testing::polygon_of;
using testing::RandomShapes;

Ring corners(const Triangulation& mesh, std::size_t i) {
  const auto& t = mesh.triangles[i];
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

// Every triangle counter-clockwise and inside; together as large as the polygon.
void expect_covers(const Polygon& polygon, const Triangulation& mesh) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Ring triangle = corners(mesh, i);
    EXPECT_GT(signed_area(triangle), 0.0);
    sum += signed_area(triangle);
    const Eigen::Vector2d middle =
        (to_metres(triangle[0]) + to_metres(triangle[1]) + to_metres(triangle[2])) / 3.0;
    EXPECT_TRUE(contains(polygon, middle)) << middle.transpose();
  }
  EXPECT_NEAR(sum, area(polygon), 1e-9 * (1.0 + area(polygon)));
}

TEST(Triangulate, CoversJaggedPolygonsAndLeavesHolesOpen) {
  RandomShapes random(1);
  for (int round = 0; round < 20; ++round) {
    const Polygon polygon = random.jagged_polygon(100, 0.2);
    const Triangulation mesh = triangulate(polygon);
    EXPECT_EQ(mesh.vertices.size(), vertex_count(polygon));
    expect_covers(polygon, mesh);
  }
}

TEST(Triangulate, CoversPolygonsWhoseRingsTouch) {
  RandomShapes random(2);
  for (int round = 0; round < 200; ++round) {
    const Polygon polygon = random.coarse_polygon(1000);
    expect_covers(polygon, triangulate(polygon));
  }
}

TEST(Triangulate, ASquareBecomesTwoTriangles) {
  const Triangulation mesh = triangulate(polygon_of({box_ring(0, 0, 10000, 10000)}));
  EXPECT_EQ(mesh.vertices.size(), 4U);
  EXPECT_EQ(mesh.triangles.size(), 2U);
}

TEST(Triangulate, AnIslandInAHoleIsCovered) {
  const Polygon polygon = polygon_of({box_ring(0, 0, 9000, 9000), box_ring(1000, 1000, 8000, 8000),
                                      box_ring(3000, 3000, 5000, 5000)});
  expect_covers(polygon, triangulate(polygon));
  EXPECT_NEAR(area(polygon), 0.81 - 0.49 + 0.04, 1e-12);
}

TEST(Triangulate, NormalisesAHoleThatSharesPartOfAnEdge) {
  const Polygon raw{
      {{box_ring(0, 0, 40000, 40000), {{{0, 10000}, {0, 20000}, {10000, 20000}, {10000, 10000}}}}}};
  ASSERT_NE(find_fault(raw), "");
  double sum = 0.0;
  const Triangulation mesh = triangulate(raw);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) sum += signed_area(corners(mesh, i));
  EXPECT_NEAR(sum, 15.0, 1e-9);
}

TEST(Triangulate, DegenerateInputGivesNoTriangles) {
  EXPECT_TRUE(triangulate({}).triangles.empty());
  EXPECT_TRUE(triangulate({{{{{0, 0}, {1000, 0}, {2000, 0}}, {}}}}).triangles.empty())
      << "collinear";
  EXPECT_TRUE(triangulate({{{Ring(10, {5, 5}), {}}}}).triangles.empty()) << "ten equal points";
}

TEST(Triangulate, GivesTheSameMeshEveryTimeAndAnywhere) {
  RandomShapes random(3);
  const Polygon polygon = random.jagged_polygon(200, 0.1);
  const Triangulation once = triangulate(polygon);
  EXPECT_EQ(triangulate(polygon).triangles, once.triangles);
  EXPECT_EQ(triangulate(testing::shifted(polygon, 10000000, 10000000)).triangles, once.triangles);
}

}  // namespace
}  // namespace geomap::geometry
