// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/camera_model.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace geomap::geometry {
namespace {

const CameraModel kCamera{640, 480, 585.0, 580.0, 319.5, 239.5};

TEST(CameraModel, ProjectionUndoesBackProjection) {
  for (const double z : {0.4, 1.0, 7.3}) {
    for (const Eigen::Vector2d& pixel :
         {Eigen::Vector2d(0, 0), Eigen::Vector2d(639, 479), Eigen::Vector2d(100.25, 333.5)}) {
      const Eigen::Vector3d point = kCamera.point(pixel.x(), pixel.y(), z);
      EXPECT_DOUBLE_EQ(point.z(), z);
      EXPECT_LT((kCamera.project(point) - pixel).norm(), 1e-10);
    }
  }
}

TEST(CameraModel, TheFrameIsOptical) {
  EXPECT_LT((kCamera.ray(319.5, 239.5) - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_GT(kCamera.ray(400.0, 239.5).x(), 0.0) << "x to the right";
  EXPECT_GT(kCamera.ray(319.5, 300.0).y(), 0.0) << "y downwards";
}

TEST(CameraModel, IsInvalidWithoutSizeFocalLengthOrFiniteCentre) {
  EXPECT_TRUE(kCamera.valid());
  EXPECT_FALSE(CameraModel{}.valid());
  const auto with = [](auto change) {
    CameraModel camera = kCamera;
    change(camera);
    return camera.valid();
  };
  EXPECT_FALSE(with([](CameraModel& c) { c.width = 0; }));
  EXPECT_FALSE(with([](CameraModel& c) { c.height = -1; }));
  EXPECT_FALSE(with([](CameraModel& c) { c.fx = 0.0; }));
  EXPECT_FALSE(with([](CameraModel& c) { c.fy = std::numeric_limits<double>::infinity(); }));
  EXPECT_FALSE(with([](CameraModel& c) { c.cx = std::numeric_limits<double>::quiet_NaN(); }));
}

}  // namespace
}  // namespace geomap::geometry
