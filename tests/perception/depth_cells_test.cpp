// SPDX-License-Identifier: BSD-3-Clause
#include "perception/depth_cells.hpp"

#include <cmath>

namespace geomap::perception {
namespace {

constexpr int kImageWidth = 37;  // no multiple of a cell
constexpr int kImageHeight = 22;
const geometry::CameraModel kCamera{kImageWidth, kImageHeight, 50.0, 45.0, 18.0, 10.0};

// The plane 1/z = 0.3 x - 0.2 y + 0.5, rounded to millimetres, with holes.
geometry::DepthImage tilted_plane() {
  geometry::DepthImage image{kImageWidth, kImageHeight, {}};
  for (int v = 0; v < kImageHeight; ++v) {
    for (int u = 0; u < kImageWidth; ++u) {
      const Eigen::Vector3d ray = kCamera.ray(u, v);
      const double z = 1.0 / (0.3 * ray.x() - 0.2 * ray.y() + 0.5);
      const bool is_missing = (u * 7 + v * 13) % 11 == 0;
      image.millimetres.push_back(is_missing ? std::uint16_t{65535}
                                             : static_cast<std::uint16_t>(std::lround(1000.0 * z)));
    }
  }
  return image;
}

TEST(DepthCells, AWindowIsTheSumOfItsPixels) {
  const geometry::DepthImage image = tilted_plane();
  const DepthCells cells(image, kCamera, 0.3, 8.0);
  ASSERT_EQ(cells.columns(), 10);
  ASSERT_EQ(cells.rows(), 6);
  InverseDepthSums expected;
  for (int v = 4; v < 20; ++v) {
    for (int u = 8; u < kImageWidth; ++u) {
      if (!geometry::DepthImage::is_reading(image.at(u, v))) continue;
      const Eigen::Vector3d ray = kCamera.ray(u, v);
      const double q = 1000.0 / image.at(u, v);
      expected += {1.0,
                   ray.x(),
                   ray.y(),
                   ray.x() * ray.x(),
                   ray.x() * ray.y(),
                   ray.y() * ray.y(),
                   q,
                   q * ray.x(),
                   q * ray.y(),
                   q * q};
    }
  }
  const InverseDepthSums found = cells.window(2, 1, 99, 5);
  EXPECT_EQ(found.count, expected.count);
  EXPECT_NEAR(found.x, expected.x, 1e-9);
  EXPECT_NEAR(found.y, expected.y, 1e-9);
  EXPECT_NEAR(found.xx, expected.xx, 1e-9);
  EXPECT_NEAR(found.xy, expected.xy, 1e-9);
  EXPECT_NEAR(found.yy, expected.yy, 1e-9);
  EXPECT_NEAR(found.q, expected.q, 1e-7 * expected.q);
  EXPECT_NEAR(found.qx, expected.qx, 1e-7 * expected.q);
  EXPECT_NEAR(found.qy, expected.qy, 1e-7 * expected.q);
  EXPECT_NEAR(found.qq, expected.qq, 1e-7 * expected.q);
}

TEST(DepthCells, AFitFindsThePlaneAndItsRounding) {
  const DepthCells cells(tilted_plane(), kCamera, 0.3, 8.0);
  const auto fit = fit_plane(cells.window(0, 0, cells.columns(), cells.rows()));
  ASSERT_TRUE(fit);
  EXPECT_LT((fit->coefficients - Eigen::Vector3d(0.3, -0.2, 0.5)).norm(), 1e-4);
  EXPECT_LT(fit->rms, 0.00029 * 0.7 * 0.7 * 1.2);  // 1/√12 mm, as inverse depth
  EXPECT_NEAR(fit->normal().norm(), 1.0, 1e-12);
  EXPECT_LT(fit->normal().z(), 0.0);
}

TEST(DepthCells, ReadingsOutOfRangeCountAsNone) {
  const geometry::DepthImage image{
      4,
      4,
      {0, 65535, 299, 300, 1000, 1000, 1000, 1000, 2000, 2001, 5000, 1000, 1000, 1000, 1000, 1000}};
  const DepthCells cells(image, {4, 4, 5.0, 5.0, 2.0, 2.0}, 0.3, 2.0);
  EXPECT_EQ(cells.cell(0).count, 11.0);
}

TEST(DepthCells, PixelsOnALineOrTooFewHaveNoFit) {
  geometry::DepthImage image{16, 16, std::vector<std::uint16_t>(256, 0)};
  const geometry::CameraModel camera{16, 16, 20.0, 20.0, 8.0, 8.0};
  EXPECT_FALSE(fit_plane(DepthCells(image, camera, 0.3, 8.0).window(0, 0, 4, 4)));
  std::fill_n(image.millimetres.begin(), 16, std::uint16_t{1000});
  EXPECT_FALSE(fit_plane(DepthCells(image, camera, 0.3, 8.0).window(0, 0, 4, 4)));
}

}  // namespace
}  // namespace geomap::perception
