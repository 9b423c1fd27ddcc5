// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/planar_polygon.hpp"

#include <gtest/gtest.h>

#include "geometry/polygon_clip.hpp"
#include "geometry/random_polygons.hpp"

namespace geomap::geometry {
namespace {

using Eigen::Vector3d;
using testing::RandomShapes;

// A jagged polygon with a hole on a plane turned by `turn` [rad] against its frame, 1 km away.
PlanarPolygon far_surface(double turn) {
  RandomShapes random(4);
  const Vector3d origin(1000.0, -200.0, 30.0);
  const Vector3d normal = Vector3d(0.2, -0.5, 1.0).normalized();
  const Plane base = Plane::through(origin, normal);
  const PlaneFrame frame = PlaneFrame::on(base, origin, Vector3d::UnitX(), Vector3d::UnitY());
  const Vector3d turned = Eigen::AngleAxisd(turn, frame.x_axis) * normal;
  return {Plane::through(origin + 0.01 * normal, turned), frame, random.jagged_polygon(60, 0.1)};
}

Eigen::Isometry3d any_motion() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.rotate(Eigen::AngleAxisd(1.3, Vector3d(0.5, 1.0, -0.2).normalized()));
  T.pretranslate(Vector3d(-700.0, 500.0, 12.0));
  return T;
}

TEST(PlanarPolygon, LiftedPointsLieOnThePlaneAboveTheirCoordinates) {
  const PlanarPolygon surface = far_surface(0.01);
  for (const Eigen::Vector2d& uv : {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, -0.5)}) {
    const Vector3d point = surface.lift(uv);
    EXPECT_NEAR(surface.plane.signed_distance(point), 0.0, 1e-9);
    EXPECT_LT(((surface.frame.T_plane_parent() * point).head<2>() - uv).norm(), 1e-9);
  }
}

TEST(PlanarPolygon, BoundingBoxHoldsTheLiftedVerticesTightly) {
  const PlanarPolygon surface = far_surface(0.01);
  const Eigen::AlignedBox3d box = surface.bounding_box();
  Vector3d least = Vector3d::Constant(1e9);
  for (const GridPoint vertex : surface.polygon.parts[0].outer) {
    EXPECT_TRUE(box.contains(surface.lift(vertex)));
    least = least.cwiseMin(surface.lift(vertex));
  }
  EXPECT_LT((box.min() - least).norm(), 1e-9);
}

TEST(PlanarPolygon, TransformedMovesEveryPointAlongAndKeepsTheRings) {
  const PlanarPolygon surface = far_surface(0.008);
  const PlanarPolygon moved = surface.transformed(any_motion());
  EXPECT_EQ(moved.polygon, surface.polygon);
  for (const GridPoint vertex : surface.polygon.parts[0].outer) {
    EXPECT_LT((moved.lift(vertex) - any_motion() * surface.lift(vertex)).norm(), 1e-9);
  }
}

TEST(PlanarPolygon, InItsOwnFrameItIsTheSamePolygon) {
  for (const double turn : {0.0, 0.008}) {
    const PlanarPolygon surface = far_surface(turn);
    const Polygon same = surface.in_frame(surface.frame);
    EXPECT_EQ(same, surface.polygon);
  }
}

TEST(PlanarPolygon, AnotherFrameAndBackStaysWithinAGridUnit) {
  const PlanarPolygon surface = far_surface(0.0);
  // Origin 3 m away, x turned by 40 degrees in the plane.
  const Vector3d x = Eigen::AngleAxisd(0.7, surface.frame.normal) * surface.frame.x_axis;
  const PlaneFrame other =
      PlaneFrame::on(surface.plane, surface.lift(Eigen::Vector2d(3.0, 1.0)), x, Vector3d::UnitY());
  const PlanarPolygon there{surface.plane, other, surface.in_frame(other)};
  EXPECT_EQ(find_fault(there.polygon), "");
  const Polygon back = there.in_frame(surface.frame);
  ASSERT_EQ(vertex_count(back), vertex_count(surface.polygon));
  for (const GridPoint vertex : back.parts[0].outer) {
    double nearest = 1.0;
    for (const GridPoint original : surface.polygon.parts[0].outer) {
      nearest = std::min(nearest, (to_metres(vertex) - to_metres(original)).cwiseAbs().maxCoeff());
    }
    EXPECT_LE(nearest, kGridUnit * 1.001);
  }
}

TEST(PlanarPolygon, AFrameTurnedAgainstThePlaneForeshortensTheArea) {
  const PlanarPolygon surface = far_surface(0.0);
  const Vector3d leaning = Eigen::AngleAxisd(0.5, surface.frame.x_axis) * surface.plane.normal;
  const PlaneFrame other =
      PlaneFrame::on(Plane::through(surface.frame.origin, leaning), surface.frame.origin,
                     surface.frame.x_axis, Vector3d::UnitY());
  EXPECT_NEAR(area(surface.in_frame(other)), area(surface.polygon) * std::cos(0.5), 1e-3);
}

TEST(PlanarPolygon, AFrameSeenFromBehindStillGivesAValidPolygon) {
  const PlanarPolygon surface = far_surface(0.0);
  const PlaneFrame behind = PlaneFrame::on(surface.plane.flipped(), surface.frame.origin,
                                           surface.frame.x_axis, Vector3d::UnitY());
  const Polygon mirrored = surface.in_frame(behind);
  EXPECT_EQ(find_fault(mirrored), "");
  EXPECT_NEAR(area(mirrored), area(surface.polygon), 1e-3);
  EXPECT_EQ(mirrored.parts[0].holes.size(), 1U);
}

}  // namespace
}  // namespace geomap::geometry
