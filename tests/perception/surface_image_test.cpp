// SPDX-License-Identifier: BSD-3-Clause
#include "perception/surface_image.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "geometry/angles.hpp"
#include "support/plane_renderer.hpp"

namespace geomap::perception {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using geometry::CameraModel;
using geometry::RgbdFrame;

/// A wall through (0, 0, z) of the camera frame, turned about the image's axes.
testing::Rectangle wall(double z, double about_x_deg, double about_y_deg) {
  const Eigen::Matrix3d R = (Eigen::AngleAxisd(geometry::radians(about_x_deg), Vector3d::UnitX()) *
                             Eigen::AngleAxisd(geometry::radians(about_y_deg), Vector3d::UnitY()))
                                .toRotationMatrix();
  return {"wall", {0.0, 0.0, z}, R.col(0), R.col(1), 20.0, 20.0, {}, {}};
}

RgbdFrame frame_of(const std::vector<testing::Rectangle>& scene, int divisor = 7) {
  return testing::render(scene, testing::kinect_camera(divisor), Isometry3d::Identity()).frame;
}

RgbdFrame blank(const CameraModel& camera, int millimetres) {
  RgbdFrame frame;
  frame.depth_camera = camera;
  const auto pixels = static_cast<std::size_t>(camera.width * camera.height);
  frame.depth = {camera.width, camera.height,
                 std::vector<std::uint16_t>(pixels, static_cast<std::uint16_t>(millimetres))};
  return frame;
}

SurfaceImage surfaces(const RgbdFrame& frame) { return {frame, 0.4, 5.0}; }

class TiltedWall : public ::testing::TestWithParam<std::pair<double, double>> {};

TEST_P(TiltedWall, EveryPixelHasTheWallsPlane) {
  const testing::Rectangle rectangle = wall(1.6, GetParam().first, GetParam().second);
  const geometry::Plane plane = rectangle.plane_seen_from(Vector3d::Zero());
  const SurfaceImage image = surfaces(frame_of({rectangle}));
  ASSERT_GT(image.size(), 1000);
  double worst_normal = 0.0, worst_point = 0.0, sum = 0.0;
  for (int v = 2; v < image.height() - 2; ++v) {
    for (int u = 2; u < image.width() - 2; ++u) {
      const SurfacePixel& pixel = image.at(u, v);
      if (!pixel.valid()) continue;
      worst_normal = std::max(worst_normal, (pixel.normal - plane.normal).norm());
      sum += (pixel.normal - plane.normal).norm();
      worst_point = std::max(worst_point, std::abs(plane.signed_distance(pixel.point)));
    }
  }
  EXPECT_LT(worst_normal, 0.02);  // what rounding to the millimetre leaves of 5 x 5 pixels
  EXPECT_LT(sum / image.size(), 0.004);
  EXPECT_LT(worst_point, 0.0005);
  RecordProperty("worst normal", std::to_string(worst_normal));
  RecordProperty("mean normal", std::to_string(sum / image.size()));
  RecordProperty("worst point", std::to_string(worst_point));
}

INSTANTIATE_TEST_SUITE_P(SurfaceImage, TiltedWall,
                         ::testing::Values(std::pair{0.0, 0.0}, std::pair{30.0, 0.0},
                                           std::pair{0.0, -45.0}, std::pair{40.0, 35.0},
                                           std::pair{-20.0, 60.0}));

TEST(SurfaceImage, AWallThatFacesTheCameraIsExact) {
  const SurfaceImage image = surfaces(blank(testing::kinect_camera(8), 1250));
  EXPECT_EQ(image.size(), image.width() * image.height() - 4);  // a corner has too few neighbours
  EXPECT_NEAR(image.farthest(), 1.25, 1e-12);
  for (int v = 1; v < image.height() - 1; ++v) {
    for (int u = 0; u < image.width(); ++u) {
      const SurfacePixel& pixel = image.at(u, v);
      EXPECT_LT((pixel.normal + Vector3d::UnitZ()).norm(), 1e-12);
      EXPECT_LT((pixel.point - image.camera().point(u, v, 1.25)).norm(), 1e-12);
      EXPECT_LT((pixel.inverse_depth - Vector3d(0.0, 0.0, 0.8)).norm(), 1e-12);
    }
  }
}

TEST(SurfaceImage, NormalsLookTowardsTheCameraAndPointsLieOnThePixelsRay) {
  const RgbdFrame frame = testing::render(testing::small_room(), testing::kinect_camera(7),
                                          testing::look_at({0.9, -1.1, 1.4}, {-0.5, 1.2, 0.6}))
                              .frame;
  const SurfaceImage image = surfaces(frame);
  int valid = 0;
  double farthest = 0.0;
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      const SurfacePixel& pixel = image.at(u, v);
      if (!pixel.valid()) continue;
      ++valid;
      farthest = std::max(farthest, pixel.point.z());
      EXPECT_NEAR(pixel.normal.norm(), 1.0, 1e-12);
      EXPECT_LT(pixel.normal.dot(pixel.point), 0.0);
      const Eigen::Vector2d at = image.camera().project(pixel.point);
      EXPECT_LT((at - Eigen::Vector2d(u, v)).norm(), 1e-9);
      EXPECT_NEAR(pixel.inverse_depth.dot(pixel.point), 1.0, 1e-9);
    }
  }
  EXPECT_EQ(image.size(), valid);
  EXPECT_EQ(image.farthest(), farthest);
  EXPECT_GT(valid, 5000);
}

TEST(SurfaceImage, PixelsBesideADepthStepTakeTheirOwnSidesPlane) {
  RgbdFrame frame = blank(testing::kinect_camera(8), 1500);
  const int edge = frame.depth.width / 2;
  for (int v = 0; v < frame.depth.height; ++v) {
    for (int u = edge; u < frame.depth.width; ++u) {
      frame.depth.millimetres[static_cast<std::size_t>(v * frame.depth.width + u)] = 1800;
    }
  }
  const SurfaceImage image = surfaces(frame);
  for (int v = 1; v < image.height() - 1; ++v) {
    for (int u = edge - 3; u < edge + 3; ++u) {
      const SurfacePixel& pixel = image.at(u, v);
      ASSERT_TRUE(pixel.valid()) << u << ", " << v;
      EXPECT_NEAR(pixel.point.z(), u < edge ? 1.5 : 1.8, 1e-9);
      EXPECT_LT((pixel.normal + Vector3d::UnitZ()).norm(), 1e-9);
    }
  }
}

TEST(SurfaceImage, SpeckleIsNoSurface) {
  RgbdFrame frame = blank(testing::kinect_camera(8), 0);
  std::mt19937 generator(7);
  std::uniform_int_distribution<int> depth(1000, 4000);
  for (auto& reading : frame.depth.millimetres) {
    reading = static_cast<std::uint16_t>(depth(generator));
  }
  const SurfaceImage image = surfaces(frame);
  EXPECT_LT(image.size(), image.width() * image.height() / 200);
}

TEST(SurfaceImage, LonelyReadingsAreNoSurface) {
  RgbdFrame frame = blank(testing::kinect_camera(8), 0);
  for (std::size_t i = 0; i < frame.depth.millimetres.size(); i += 3) {
    frame.depth.millimetres[i] = 1500;
  }
  EXPECT_EQ(surfaces(frame).size(), 0);
}

TEST(SurfaceImage, AWallSeenAtMoreThan81DegreesIsLeftOut) {
  // The middle ray meets it at the angle of the tilt; far columns at more or less than that.
  for (const double tilt : {60.0, 79.0, 84.0}) {
    const testing::Rectangle rectangle = wall(1.2, 0.0, tilt);
    const geometry::Plane plane = rectangle.plane_seen_from(Vector3d::Zero());
    const RgbdFrame frame = frame_of({rectangle}, 2);
    const SurfaceImage image = surfaces(frame);
    int seen = 0;
    for (int v = 0; v < image.height(); ++v) {
      for (int u = 0; u < image.width(); ++u) {
        const double cosine = -plane.normal.dot(image.camera().ray(u, v).normalized());
        if (image.at(u, v).valid()) {
          ++seen;
          EXPECT_GT(cosine, 0.15 - 0.02);
        }
      }
    }
    EXPECT_GT(seen, 100) << tilt;
    const SurfacePixel& middle = image.at(image.width() / 2, image.height() / 2);
    EXPECT_EQ(middle.valid(), tilt < 81.0) << tilt;
  }
}

TEST(SurfaceImage, ReadingsOutOfRangeAreNoSurface) {
  const CameraModel camera = testing::kinect_camera(8);
  for (const int mm : {399, 5001, 0, 0xffff}) {
    const SurfaceImage image = surfaces(blank(camera, mm));
    EXPECT_EQ(image.size(), 0) << mm;
    EXPECT_EQ(image.farthest(), 0.0);
  }
  for (const int mm : {400, 5000}) EXPECT_GT(surfaces(blank(camera, mm)).size(), 0) << mm;
}

TEST(SurfaceImage, TinyImagesHaveNoSurface) {
  EXPECT_EQ(surfaces(blank({1, 1, 50.0, 50.0, 0.0, 0.0}, 1000)).size(), 0);
  EXPECT_EQ(surfaces(blank({7, 1, 50.0, 50.0, 3.0, 0.0}, 1000)).size(), 0);
  EXPECT_GT(surfaces(blank({3, 3, 50.0, 50.0, 1.0, 1.0}, 1000)).size(), 0);
}

TEST(SurfaceImage, ThrowsWhereImageAndCameraDisagree) {
  const RgbdFrame good = blank(testing::kinect_camera(8), 1000);
  RgbdFrame cut = good;
  cut.depth.millimetres.pop_back();
  RgbdFrame other = good;
  other.depth_camera = testing::kinect_camera(4);
  RgbdFrame no_focal_length = good;
  no_focal_length.depth_camera.fx = 0.0;
  for (const RgbdFrame& frame : {cut, other, no_focal_length, RgbdFrame()}) {
    EXPECT_THROW(surfaces(frame), std::invalid_argument);
  }
}

TEST(SurfaceImage, SeenAtFindsThePixelOntoWhichAPointFalls) {
  const SurfaceImage image = surfaces(blank(testing::kinect_camera(8), 1250));
  for (const double off : {-0.49, 0.0, 0.49}) {
    for (const double z : {0.2, 1.25, 7.0}) {
      EXPECT_EQ(image.seen_at(image.camera().point(12.0 + off, 31.0 - off, z)), &image.at(12, 31));
    }
  }
  const double right = image.width() - 0.51, bottom = image.height() - 1.51;
  EXPECT_EQ(image.seen_at(image.camera().point(-0.49, 0.51, 1.0)), &image.at(0, 1));
  EXPECT_EQ(image.seen_at(image.camera().point(right, bottom, 1.0)),
            &image.at(image.width() - 1, image.height() - 2));
}

TEST(SurfaceImage, SeenAtFindsNothingOutsideBehindOrWhereThereIsNoNumber) {
  const SurfaceImage image = surfaces(blank(testing::kinect_camera(8), 1250));
  const CameraModel& camera = image.camera();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const double right = camera.width - 0.49, bottom = camera.height - 0.49;
  for (const Vector3d& p :
       {camera.point(-0.51, 20.0, 1.0), camera.point(20.0, -0.51, 1.0),
        camera.point(right, 20.0, 1.0), camera.point(20.0, bottom, 1.0),
        camera.point(20.0, 20.0, -1.0), camera.point(20.0, 20.0, 0.05), Vector3d(0.0, 0.0, 0.0),
        Vector3d(nan, 0.0, 1.0), Vector3d(0.0, nan, 1.0), Vector3d(0.0, 0.0, nan),
        Vector3d(infinity, 0.0, 1.0), Vector3d(1e300, 0.0, 0.2)}) {
    EXPECT_EQ(image.seen_at(p), nullptr) << p.transpose();
  }
  EXPECT_EQ(surfaces(blank(camera, 0)).seen_at({0.0, 0.0, 1.0}), nullptr);
}

TEST(SurfacePixel, OnRayOfIsWhereTheRayMeetsThePlane) {
  // n·x = -d of the plane becomes 1/z = (n / -d)·ray.
  const Vector3d normal = Vector3d(0.3, -0.2, -0.9).normalized();
  const double distance = 1.7;  // of the camera from the plane
  SurfacePixel pixel;
  pixel.normal = normal;
  pixel.inverse_depth = -normal / distance;
  for (const Vector3d& p : {Vector3d(0.1, 0.2, 1.0), Vector3d(-0.4, 0.1, 2.5)}) {
    const auto found = pixel.on_ray_of(p);
    ASSERT_TRUE(found);
    EXPECT_NEAR(normal.dot(*found), -distance, 1e-12);
    EXPECT_LT(found->cross(p).norm(), 1e-12);
    EXPECT_GT(found->z(), 0.0);
  }
  EXPECT_FALSE(pixel.on_ray_of({6.0, 0.0, 1.0}));  // runs away from the plane
  EXPECT_FALSE(pixel.on_ray_of({std::numeric_limits<double>::quiet_NaN(), 0.0, 1.0}));
}

}  // namespace
}  // namespace geomap::perception
