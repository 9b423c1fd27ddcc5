// SPDX-License-Identifier: BSD-3-Clause
// Real cameras: a kitchen seen by a Kinect, with reference planes, and single views of a RealSense.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>

#include "drivers/image_file.hpp"
#include "geometry/polygon.hpp"
#include "perception/ransac_extractor.hpp"
#include "support/recordings.hpp"

namespace geomap::perception {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct Reference {
  const char* name;
  geometry::Plane plane;  // world
};

// As in the recording's reference_planes.yaml.
const std::vector<Reference>& references() {
  static const std::vector<Reference> planes = {
      {"table top", {{0.00612, -0.89238, -0.45124}, 0.8086}},
      {"left cupboard fronts", {{0.99551, 0.00387, 0.09459}, 1.7148}},
      {"floor", {{0.02369, -0.89009, -0.45517}, 1.5538}},
      {"back wall", {{-0.00741, 0.45102, -0.89248}, 3.4174}},
      {"worktop", {{0.00809, -0.89330, -0.44939}, 1.0642}}};
  return planes;
}

struct KitchenView {
  geometry::RgbdFrame frame;
  Eigen::Isometry3d T_world_camera;
  std::vector<geometry::PlaneObservation> planes;
};

KitchenView read_view(const std::filesystem::path& folder, int number) {
  KitchenView view;
  char name[64];
  std::snprintf(name, sizeof name, "frame-%06d.", number);
  view.frame.depth = drivers::read_depth_png(folder / (std::string(name) + "depth.png"));
  view.frame.depth_camera = {640, 480, 585.0, 585.0, 320.0, 240.0};
  std::ifstream file(folder / (std::string(name) + "pose.txt"));
  for (int i = 0; i < 16; ++i) file >> view.T_world_camera.matrix()(i / 4, i % 4);
  view.planes = RansacExtractor()
                    .extract(view.frame, static_cast<std::uint64_t>(number), std::nullopt)
                    .planes;
  return view;
}

double coverage(const KitchenView& view) {
  const auto& readings = view.frame.depth.millimetres;
  const auto valid =
      std::count_if(readings.begin(), readings.end(), geometry::DepthImage::is_reading);
  double inliers = 0.0;
  for (const auto& plane : view.planes) inliers += static_cast<double>(plane.inliers);
  return inliers / static_cast<double>(valid);
}

double median(std::vector<double> values) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// Angles [rad] between a reference plane and the large planes that lie on it, one list per
// reference.
std::vector<std::vector<double>> angles_to_references(const std::vector<KitchenView>& views) {
  std::vector<std::vector<double>> angles(references().size());
  for (const KitchenView& view : views) {
    for (const auto& observed : view.planes) {
      if (observed.inliers < 5000) continue;
      const geometry::Plane plane = observed.surface.plane.transformed(view.T_world_camera);
      const Eigen::Vector3d centroid = view.T_world_camera * observed.moments.centroid();
      for (std::size_t k = 0; k < references().size(); ++k) {
        const geometry::Plane& reference = references()[k].plane;
        const double angle = geometry::angle_between(plane, reference);
        if (angle < 20.0 * kDegree && std::abs(reference.signed_distance(centroid)) < 0.03) {
          angles[k].push_back(angle);
        }
      }
    }
  }
  return angles;
}

TEST(RecordedPlanes, TheKitchensReferencePlanesAreSeenStraight) {
  GEOMAP_REQUIRE_RECORDING(folder, "redkitchen");
  std::vector<KitchenView> views;
  std::vector<double> covered;
  for (int number = 0; number < 500; number += 25) {
    views.push_back(read_view(folder, number));
    covered.push_back(coverage(views.back()));
    EXPECT_GT(covered.back(), 0.75) << "frame " << number;
    for (const auto& plane : views.back().planes) {
      EXPECT_EQ(geometry::find_fault(plane.surface.polygon), "");
    }
  }
  EXPECT_GT(median(covered), 0.85);
  const auto angles = angles_to_references(views);
  for (std::size_t k = 0; k < angles.size(); ++k) {
    ASSERT_GE(angles[k].size(), 5u) << references()[k].name;
    EXPECT_LT(median(angles[k]), 2.0 * kDegree) << references()[k].name;
    // No slanted bands: nothing large lies across a surface.
    EXPECT_LT(*std::max_element(angles[k].begin(), angles[k].end()), 8.0 * kDegree)
        << references()[k].name;
  }
}

TEST(RecordedPlanes, ViewsOfARealSenseShowALargePlaneEach) {
  GEOMAP_REQUIRE_RECORDING(folder, "felix_planes");
  for (int number = 0; number < 10; ++number) {
    char name[32];
    std::snprintf(name, sizeof name, "%06d.png", number);
    geometry::RgbdFrame frame;
    frame.depth = drivers::read_depth_png(folder / "depth" / name);
    // The file's intrinsic matrix is column by column.
    frame.depth_camera = {
        640, 480, 617.25, 617.5486450195312, 317.3921203613281, 245.98019409179688};
    const auto planes = RansacExtractor().extract(frame, 1, std::nullopt).planes;
    ASSERT_FALSE(planes.empty()) << name;
    EXPECT_GT(planes[0].inliers, 20000) << name;
    EXPECT_LT(planes[0].rms, 0.01 * planes[0].moments.centroid().z()) << name;
  }
}

}  // namespace
}  // namespace geomap::perception
