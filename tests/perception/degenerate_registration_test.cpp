// SPDX-License-Identifier: BSD-3-Clause
#include "perception/frustum_icp.hpp"

#include <gtest/gtest.h>

#include "perception/point_map.hpp"
#include "registration_scenes.hpp"

namespace geomap::perception {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

TEST(DegenerateScenes, LeavesWhatASceneDoesNotTellAtThePriorExactly) {
  for (const RegistrationScene& scene : near_and_far(degenerate_scenes())) {
    SCOPED_TRACE(scene.name);
    const std::vector<Surfel> surfels = exact_surfels(scene);
    const SurfaceImage view = exact_view(scene, scene.T_world_camera);
    Worst open, observed;
    for (unsigned seed = 1; seed <= 10; ++seed) {
      const Isometry3d prior = disturbed(scene.T_world_camera, 0.05, 3.0, seed);
      const Alignment found = align(surfels, view, prior);
      EXPECT_TRUE(found.converged);
      EXPECT_EQ(found.observed_directions, scene.observed_directions());
      const MotionSize made_up = open_part(scene, motion(prior, found.T_world_camera));
      EXPECT_LT(made_up.metres, 1e-6);
      EXPECT_LT(made_up.radians, 1e-6);
      open.add(made_up);
      observed.add(observed_part(scene, motion(scene.T_world_camera, found.T_world_camera)));
    }
    EXPECT_LT(observed.metres, 0.002);
    EXPECT_LT(observed.degrees, 0.1);
    open.record(scene.name + " open");
    observed.record(scene.name + " observed");
  }
}

TEST(DegenerateScenes, MakesUpNextToNothingFromTheNoiseOfAKinect) {
  for (const RegistrationScene& scene : near_and_far(degenerate_scenes())) {
    SCOPED_TRACE(scene.name);
    Worst open, observed;
    for (unsigned seed = 1; seed <= 10; ++seed) {
      const Isometry3d T_map = disturbed(scene.T_world_camera, 0.15, 8.0, 50 + seed);
      PointMap map;
      map.insert(1, noisy_frame(scene, T_map, seed), T_map);
      const FrameView view = map.view(noisy_frame(scene, scene.T_world_camera, 100 + seed));
      const auto all = map.voxels().surfels_in({testing::kinect_camera(), 0.1, 6.0, T_map});
      const Isometry3d prior = disturbed(scene.T_world_camera, 0.03, 1.5, seed);
      const Alignment found = align(all.surfels, view.surfaces, prior);
      EXPECT_TRUE(found.converged);
      EXPECT_EQ(found.observed_directions, scene.observed_directions());
      open.add(open_part(scene, motion(prior, found.T_world_camera)));
      observed.add(observed_part(scene, motion(scene.T_world_camera, found.T_world_camera)));
    }
    EXPECT_LT(open.metres, 0.005);
    EXPECT_LT(open.degrees, 0.2);
    EXPECT_LT(observed.metres, 0.01);
    EXPECT_LT(observed.degrees, 0.5);
    open.record(scene.name + " noisy open");
    observed.record(scene.name + " noisy observed");
  }
}

}  // namespace
}  // namespace geomap::perception
