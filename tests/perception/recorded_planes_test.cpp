// SPDX-License-Identifier: BSD-3-Clause
// Real cameras: a kitchen seen by a Kinect, with reference planes, and single views of a RealSense.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "drivers/image_file.hpp"
#include "geometry/angles.hpp"
#include "geometry/polygon.hpp"
#include "perception/outline_image.hpp"
#include "perception/ransac_extractor.hpp"
#include "support/recordings.hpp"

namespace geomap::perception {
namespace {

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
        if (angle < geometry::radians(20.0) &&
            std::abs(reference.signed_distance(centroid)) < 0.03) {
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
    EXPECT_LT(median(angles[k]), geometry::radians(2.0)) << references()[k].name;
    // No slanted bands: nothing large lies across a surface.
    EXPECT_LT(*std::max_element(angles[k].begin(), angles[k].end()), geometry::radians(8.0))
        << references()[k].name;
  }
}

// A surface a person sees in a view's colour picture.
struct Visible {
  const char* name;
  int u, v;          // a pixel well inside it
  int least_pixels;  // of the plane there: half of what twenty seeds find at least
};

// A view of a RealSense: its floor, then surfaces that stand upright on it.
struct RealSenseView {
  int number;
  std::optional<Visible> floor;
  std::vector<Visible> upright;
};

// Not asked for, as only some seeds find them: the walls of views 1 and 9 and the curtains of 2
// and 9, all more than 2 m away, and the drawers of view 4.
const std::vector<RealSenseView>& real_sense_views() {
  static const std::vector<RealSenseView> views = {
      {0,
       Visible{"floor", 320, 430, 59000},
       {{"wall", 230, 70, 19000}, {"door", 540, 130, 8700}, {"box", 250, 230, 23000}}},
      {1, Visible{"floor", 540, 455, 8500}, {{"box", 500, 215, 49000}, {"carton", 250, 330, 5900}}},
      {2, Visible{"floor", 320, 430, 57000}, {{"box", 390, 170, 32000}, {"carton", 70, 150, 6000}}},
      {3,
       Visible{"floor", 320, 350, 86000},
       {{"door frame", 20, 80, 2900}, {"door", 130, 90, 3900}, {"box", 320, 110, 14000}}},
      {4,
       Visible{"floor", 320, 420, 46000},
       {{"carton", 340, 225, 14000}, {"carton's side", 220, 215, 9000}}},
      // 6 cm above the floor: depth is missing on most of it.
      {5, std::nullopt, {{"door", 70, 160, 19000}, {"wall", 285, 110, 2600}}},
      {6,
       Visible{"floor", 310, 360, 49000},
       {{"wall", 225, 127, 1300}, {"curtain", 100, 60, 5600}}},
      {7, Visible{"floor", 320, 400, 43000}, {{"wall", 75, 135, 2700}}},
      {8,
       Visible{"floor", 340, 440, 33000},
       {{"curtain", 220, 40, 2200}, {"carton", 40, 280, 8000}, {"carton's side", 130, 270, 8000}}},
      {9,
       Visible{"floor", 420, 440, 10000},
       {{"box", 400, 270, 23000}, {"carton", 190, 290, 8500}}}};
  return views;
}

geometry::RgbdFrame read_real_sense(const std::filesystem::path& folder, int number) {
  char name[32];
  std::snprintf(name, sizeof name, "%06d.png", number);
  geometry::RgbdFrame frame;
  frame.depth = drivers::read_depth_png(folder / "depth" / name);
  // The file's intrinsic matrix is column by column.
  frame.depth_camera = {640, 480, 617.25, 617.5486450195312, 317.3921203613281, 245.98019409179688};
  return frame;
}

const geometry::PlaneObservation* plane_at(const std::vector<geometry::PlaneObservation>& planes,
                                           const geometry::CameraModel& camera,
                                           const Visible& surface) {
  const auto pixel = static_cast<std::size_t>(surface.v * camera.width + surface.u);
  for (const auto& plane : planes) {
    if (testing::outline_image(plane.surface, camera)[pixel]) return &plane;
  }
  return nullptr;
}

void expect_visible(const RealSenseView& view, const geometry::CameraModel& camera,
                    const std::vector<geometry::PlaneObservation>& planes) {
  // Where the floor is not found: fitted apart from the extractor to what depth there is.
  geometry::Plane floor{{0.017, -0.993, 0.114}, 0.06};
  if (view.floor) {
    const auto* found = plane_at(planes, camera, *view.floor);
    ASSERT_NE(found, nullptr) << "floor";
    floor = found->surface.plane;
    EXPECT_GE(found->inliers, view.floor->least_pixels) << "floor";
    EXPECT_LT(floor.normal.y(), -0.8) << "floor";
  }
  for (const Visible& surface : view.upright) {
    const auto* found = plane_at(planes, camera, surface);
    EXPECT_NE(found, nullptr) << surface.name;
    if (found == nullptr) continue;
    EXPECT_GE(found->inliers, surface.least_pixels) << surface.name;
    // Beyond 2 m this camera bends walls: 8 degrees were seen.
    const double tolerance = found->moments.centroid().z() > 2.0 ? 10.0 : 4.0;
    const double angle = geometry::angle_between(found->surface.plane, floor);
    EXPECT_NEAR(geometry::degrees(angle), 90.0, tolerance) << surface.name;
  }
}

TEST(RecordedPlanes, ViewsOfARealSenseShowTheirFloorAndWalls) {
  GEOMAP_REQUIRE_RECORDING(folder, "felix_planes");
  for (const RealSenseView& view : real_sense_views()) {
    const geometry::RgbdFrame frame = read_real_sense(folder, view.number);
    for (const std::uint64_t seed : {1, 2, 3}) {
      SCOPED_TRACE("view " + std::to_string(view.number) + ", seed " + std::to_string(seed));
      const auto planes = RansacExtractor().extract(frame, seed, std::nullopt).planes;
      ASSERT_FALSE(planes.empty());
      EXPECT_GT(planes[0].inliers, 20000);
      EXPECT_LT(planes[0].rms, 0.01 * planes[0].moments.centroid().z());
      expect_visible(view, frame.depth_camera, planes);
    }
  }
}

}  // namespace
}  // namespace geomap::perception
