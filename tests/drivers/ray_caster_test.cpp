// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/ray_caster.hpp"

#include <cmath>

#include "drivers/simulated_kinect.hpp"
#include "support/plane_renderer.hpp"

namespace geomap::drivers {
namespace {

Scene scene_of(const std::vector<testing::Rectangle>& rectangles) {
  Scene scene;
  for (const testing::Rectangle& r : rectangles) {
    SceneFace face;
    face.corner = r.center - r.half_u * r.u - r.half_v * r.v;
    face.u = 2.0 * r.half_u * r.u;
    face.v = 2.0 * r.half_v * r.v;
    for (const Eigen::AlignedBox2d& o : r.openings) {
      const Eigen::Vector2d shift(r.half_u, r.half_v);
      face.openings.emplace_back(o.min() + shift, o.max() + shift);
    }
    scene.add_face(r.name, r.color, face);
  }
  return scene;
}

TEST(RayCaster, SeesWhatTheClosedFormRendererSees) {
  std::vector<testing::Rectangle> room = testing::small_room();
  room[1].openings.emplace_back(Eigen::Vector2d(-0.4, -0.3), Eigen::Vector2d(0.5, 0.4));
  const Scene scene = scene_of(room);
  const RayCaster caster(scene);
  const geometry::CameraModel camera = testing::kinect_camera(2);
  SceneView view;
  int differing = 0;
  for (int i = 0; i < 5; ++i) {
    const Eigen::Isometry3d T_world_camera =
        testing::look_at({1.0 - 0.4 * i, -1.5, 1.1 + 0.1 * i}, {0.1, 1.2, 0.6});
    caster.cast(camera, T_world_camera, view);
    const testing::Rendering expected = testing::render(room, camera, T_world_camera);
    ASSERT_EQ(view.depth.depth.size(), expected.depth.size());
    for (std::size_t p = 0; p < expected.depth.size(); ++p) {
      const int surface =
          view.triangle[p] < 0
              ? -1
              : static_cast<int>(
                    scene.triangles[static_cast<std::size_t>(view.triangle[p])].surface);
      if (surface != expected.label[p]) {
        ++differing;  // on a border: Embree works in float
      } else if (surface >= 0) {
        ASSERT_NEAR(view.depth.depth[p], expected.depth[p], 1e-9);
      }
    }
  }
  EXPECT_LE(differing, 10);
}

TEST(RayCaster, ASphereIsWhereItsEquationSays) {
  Scene scene;
  Eigen::Isometry3d T_world_sphere = Eigen::Isometry3d::Identity();
  T_world_sphere.translation() << 0.1, -0.05, 2.0;
  scene.add_sphere("ball", {}, T_world_sphere, 0.4, 0.4);
  const RayCaster caster(scene);
  const geometry::CameraModel camera = simulated_kinect();
  SceneView view;
  caster.cast(camera, Eigen::Isometry3d::Identity(), view);
  int hits = 0;
  for (int v = 0; v < camera.height; v += 7) {
    for (int u = 0; u < camera.width; u += 7) {
      const Eigen::Vector3d ray = camera.ray(u, v);
      const Eigen::Vector3d center = T_world_sphere.translation();
      const double b = ray.dot(center);
      const double c = center.squaredNorm() - 0.16;
      const double root = b * b - ray.squaredNorm() * c;
      const auto pixel = static_cast<std::size_t>(v * camera.width + u);
      if (root < 1e-3) continue;  // beside it, or where facets show
      ++hits;
      const double z = (b - std::sqrt(root)) / ray.squaredNorm();
      ASSERT_NEAR(view.depth.depth[pixel], z, 0.003);
      ASSERT_NEAR(view.depth.cosine[pixel],
                  std::abs((z * ray - center).normalized().dot(ray.normalized())), 0.05);
    }
  }
  EXPECT_GT(hits, 500);
}

TEST(RayCaster, WhereNothingIsTheDepthIsZero) {
  const Scene scene = scene_of({testing::small_room().front()});
  const RayCaster caster(scene);
  SceneView view;
  caster.cast(testing::kinect_camera(8), testing::look_at({0, 0, 1}, {0, 5, 4}), view);
  EXPECT_EQ(view.triangle.front(), -1);
  EXPECT_EQ(view.depth.depth.front(), 0.0);
}

TEST(RayCaster, TellsWhetherTheWayIsFree) {
  testing::Rectangle wall;  // 2 m x 2 m in the plane z = 0
  const Scene scene = scene_of({wall});
  const RayCaster caster(scene);
  EXPECT_FALSE(caster.is_free({0.1, 0.2, 1.0}, {0.1, 0.2, -1.0}));
  EXPECT_TRUE(caster.is_free({0.1, 0.2, 1.0}, {0.3, 0.2, 0.0}));  // up to the wall itself
  EXPECT_TRUE(caster.is_free({2.1, 0.2, 1.0}, {2.1, 0.2, -1.0}));
}

}  // namespace
}  // namespace geomap::drivers
