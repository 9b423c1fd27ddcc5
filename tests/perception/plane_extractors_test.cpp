// SPDX-License-Identifier: BSD-3-Clause
// One suite of properties for all plane extractors.
#include "perception/organized_extractor.hpp"
#include "perception/ransac_extractor.hpp"

#include <array>
#include <cmath>
#include <future>
#include <set>

#include "geometry/angles.hpp"
#include "geometry/polygon.hpp"
#include "perception/outline_image.hpp"
#include "support/plane_renderer.hpp"

namespace geomap::perception {
namespace {

using Eigen::Vector3d;
using geometry::PlaneObservation;
using testing::Rectangle;
using testing::Rendering;

// What one extracted plane has to do with the rectangles of a scene.
struct Match {
  int rectangle = -1;    // most of the outline's pixels show it; -1: none
  double angle = 0.0;    // to the true plane [rad]
  double offset = 0.0;   // of the true plane at the inliers' centroid [m]
  double overlap = 0.0;  // of the outline's image with the rectangle's pixels
};

std::vector<bool> image_of(const Rendering& rendering, int rectangle) {
  std::vector<bool> image;
  for (const int label : rendering.label) image.push_back(label == rectangle);
  return image;
}

Match match(const PlaneObservation& plane, const std::vector<Rectangle>& scene,
            const Rendering& rendering, const Eigen::Isometry3d& T_world_camera) {
  const auto outline = testing::outline_image(plane.surface, rendering.frame.depth_camera);
  Match best;
  for (std::size_t k = 0; k < scene.size(); ++k) {
    const auto image = image_of(rendering, static_cast<int>(k));
    if (2 * testing::common_pixels(outline, image) < testing::count_pixels(outline)) continue;
    const geometry::Plane truth = scene[k].plane_seen_from(T_world_camera.translation());
    const geometry::Plane found = plane.surface.plane.transformed(T_world_camera);
    best.rectangle = static_cast<int>(k);
    best.angle = geometry::angle_between(found, truth);
    best.offset = truth.signed_distance(T_world_camera * plane.moments.centroid());
    best.overlap = testing::overlap_ratio(outline, image);
  }
  return best;
}

// Every rectangle of which at least `least_pixels` are visible is found as one plane within the
// bounds, and nothing else is found.
template <typename Extractor>
void expect_scene(const std::vector<Rectangle>& scene, const Eigen::Isometry3d& T_world_camera,
                  double sigma, double max_angle, double max_offset, double min_overlap,
                  const geometry::CameraModel& camera = testing::kinect_camera()) {
  const Rendering rendering = testing::render(scene, camera, T_world_camera, sigma);
  const auto planes = Extractor().extract(rendering.frame, 7, std::nullopt).planes;
  std::set<int> found;
  for (const PlaneObservation& plane : planes) {
    const Match m = match(plane, scene, rendering, T_world_camera);
    ASSERT_GE(m.rectangle, 0) << "an invented plane of " << plane.inliers << " pixels";
    const std::string& name = scene[static_cast<std::size_t>(m.rectangle)].name;
    EXPECT_TRUE(found.insert(m.rectangle).second) << name << " was found twice";
    EXPECT_LT(m.angle, max_angle) << name;
    EXPECT_LT(std::abs(m.offset), max_offset) << name;
    EXPECT_GT(m.overlap, min_overlap) << name;
    EXPECT_EQ(geometry::find_fault(plane.surface.polygon), "") << name;
    EXPECT_GT(plane.surface.plane.d, 0.0) << name << ": the normal looks away from the camera";
  }
  for (std::size_t k = 0; k < scene.size(); ++k) {
    const auto image = image_of(rendering, static_cast<int>(k));
    if (testing::count_pixels(image) < 1500) continue;
    EXPECT_TRUE(found.count(static_cast<int>(k))) << scene[k].name << " was missed";
  }
}

Eigen::Isometry3d view_into_room() { return testing::look_at({1.2, -1.2, 1.5}, {-0.4, 1.2, 0.6}); }

Rectangle facing(const std::string& name, const Vector3d& center, double half_u, double half_v) {
  // Seen by a camera at the origin that looks along z.
  return {name, center, Vector3d::UnitX(), -Vector3d::UnitY(), half_u, half_v, {200, 100, 50}, {}};
}

template <typename Extractor>
std::vector<PlaneObservation> planes_at_origin(const std::vector<Rectangle>& scene,
                                               double sigma = 0.0,
                                               const typename Extractor::Config& config = {}) {
  const Rendering rendering =
      testing::render(scene, testing::kinect_camera(), Eigen::Isometry3d::Identity(), sigma);
  return Extractor(config).extract(rendering.frame, 1, std::nullopt).planes;
}

template <typename Extractor>
class PlaneExtractors : public ::testing::Test {};

using Extractors = ::testing::Types<RansacExtractor, OrganizedExtractor>;
TYPED_TEST_SUITE(PlaneExtractors, Extractors);

TYPED_TEST(PlaneExtractors, ANoiseFreeRoomIsFoundExactly) {
  expect_scene<TypeParam>(testing::small_room(), view_into_room(), 0.0, geometry::radians(0.05),
                          0.0005, 0.95);
}

TYPED_TEST(PlaneExtractors, WhiteNoiseOfFiveMillimetresLeavesEveryPlaneOfTheRoom) {
  expect_scene<TypeParam>(testing::small_room(), view_into_room(), 0.005, geometry::radians(0.1),
                          0.001, 0.95);
}

TYPED_TEST(PlaneExtractors, WhiteNoiseOfTwentyMillimetresLeavesEveryPlaneOfTheRoom) {
  expect_scene<TypeParam>(testing::small_room(), view_into_room(), 0.020, geometry::radians(0.3),
                          0.003, 0.93);
}

// A block before a wall, its top seen at a flat angle: where planes meet, single readings of such
// noise say little, and nothing may be made up across the edges.
TYPED_TEST(PlaneExtractors, EdgesOfABlockStaySharpUnderTwentyMillimetresOfNoise) {
  const std::vector<Rectangle> block = {
      {"front", {0.0, 0.0, 0.45}, -Vector3d::UnitY(), Vector3d::UnitZ(), 1.2, 0.45, {}, {}},
      {"top", {0.3, 0.0, 0.9}, Vector3d::UnitX(), Vector3d::UnitY(), 0.3, 1.2, {}, {}},
      {"wall", {0.6, 0.0, 1.25}, -Vector3d::UnitY(), Vector3d::UnitZ(), 1.2, 1.25, {}, {}},
      {"floor", {-1.5, 0.0, 0.0}, Vector3d::UnitX(), Vector3d::UnitY(), 2.1, 2.2, {}, {}}};
  for (const double y : {-0.6, 0.0}) {
    expect_scene<TypeParam>(block, testing::look_at({-2.0, y, 1.4}, {0.3, 0.2 * y, 0.7}), 0.020,
                            geometry::radians(1.0), 0.006, 0.90);
  }
}

TYPED_TEST(PlaneExtractors, AQuarterOfTheResolutionShowsTheSameRoom) {
  expect_scene<TypeParam>(testing::small_room(), view_into_room(), 0.0, geometry::radians(0.2),
                          0.001, 0.9, testing::kinect_camera(4));
}

TYPED_TEST(PlaneExtractors, ABookOnATableIsAPlaneOfItsOwn) {
  std::vector<Rectangle> scene = testing::small_room();
  Rectangle book = scene[3];
  book.name = "book";
  book.center += Vector3d(0.1, 0.0, 0.04);
  book.half_u = 0.15;
  book.half_v = 0.12;
  scene.push_back(book);
  expect_scene<TypeParam>(scene, view_into_room(), 0.003, geometry::radians(0.5), 0.002, 0.9);
}

TYPED_TEST(PlaneExtractors, AWindowStaysOpen) {
  Rectangle wall = facing("wall", {0.0, 0.0, 2.0}, 0.9, 0.6);
  wall.openings = {{Eigen::Vector2d(-0.2, -0.1), Eigen::Vector2d(0.3, 0.3)}};
  const auto planes = planes_at_origin<TypeParam>({wall}, 0.003);
  ASSERT_EQ(planes.size(), 1u);
  const geometry::Polygon& polygon = planes[0].surface.polygon;
  ASSERT_EQ(polygon.parts.size(), 1u);
  ASSERT_EQ(polygon.parts[0].holes.size(), 1u);
  EXPECT_NEAR(-geometry::signed_area(polygon.parts[0].holes[0]), 0.5 * 0.4, 0.02);
  EXPECT_NEAR(geometry::area(polygon), 1.8 * 1.2 - 0.5 * 0.4, 0.03);
}

TYPED_TEST(PlaneExtractors, TheOutlineOfARectangleIsFourCornersWithoutShrinking) {
  const auto planes =
      planes_at_origin<TypeParam>({facing("board", {0.0, 0.0, 1.5}, 0.4, 0.3)}, 0.004);
  ASSERT_EQ(planes.size(), 1u);
  const geometry::PlanarPolygon& surface = planes[0].surface;
  EXPECT_LE(geometry::vertex_count(surface.polygon), 8u);
  const auto box = surface.bounding_box();
  EXPECT_NEAR(box.sizes().x(), 0.8, 0.012);
  EXPECT_NEAR(box.sizes().y(), 0.6, 0.012);
  EXPECT_NEAR(geometry::area(surface.polygon), 0.48, 0.48 * 0.02);
}

TYPED_TEST(PlaneExtractors, ObliqueNoiseDoesNotTiltASmallPlane) {
  // 0.4 m, seen at 60 degrees: least squares without the noise term turns it by 0.012 rad.
  const Eigen::Isometry3d T_world_camera = testing::look_at({0.0, -1.3, 0.75}, {0.0, 0.0, 0.0});
  const std::vector<Rectangle> scene = {
      {"tile", Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY(), 0.2, 0.2, {9, 9, 9}, {}}};
  expect_scene<TypeParam>(scene, T_world_camera, 0.020, 0.006, 0.003, 0.85);
}

TYPED_TEST(PlaneExtractors, TheTwoSidesOfADoorLookAtTheirCameras) {
  const std::vector<Rectangle> door = {
      {"door", {0.0, 0.0, 1.0}, Vector3d::UnitX(), Vector3d::UnitZ(), 0.5, 0.6, {1, 2, 3}, {}}};
  std::vector<Vector3d> normals;
  for (const double side : {-2.0, 2.0}) {
    const Eigen::Isometry3d T_world_camera = testing::look_at({0.3, side, 1.2}, {0.0, 0.0, 1.0});
    const Rendering rendering = testing::render(door, testing::kinect_camera(), T_world_camera);
    const auto planes = TypeParam().extract(rendering.frame, 1, std::nullopt).planes;
    ASSERT_EQ(planes.size(), 1u);
    normals.push_back(T_world_camera.linear() * planes[0].surface.plane.normal);
  }
  EXPECT_NEAR(normals[0].y(), -1.0, 1e-4);
  EXPECT_NEAR(normals[1].y(), 1.0, 1e-4);
}

TYPED_TEST(PlaneExtractors, CoplanarPartsFarApartAreTwoPlanes) {
  const auto planes = planes_at_origin<TypeParam>(
      {facing("left", {-0.4, 0.0, 1.5}, 0.25, 0.3), facing("right", {0.4, 0.0, 1.5}, 0.25, 0.3)});
  EXPECT_EQ(planes.size(), 2u);
}

TYPED_TEST(PlaneExtractors, CoplanarPartsWithANarrowGapAreOnePlane) {
  const auto planes = planes_at_origin<TypeParam>(
      {facing("left", {-0.26, 0.0, 1.5}, 0.25, 0.3), facing("right", {0.26, 0.0, 1.5}, 0.25, 0.3)});
  EXPECT_EQ(planes.size(), 1u);
}

TYPED_TEST(PlaneExtractors, ASurfaceSeenAlongItselfIsNotReported) {
  const Eigen::Isometry3d T_world_camera = testing::look_at({0.0, -2.0, 0.05}, {0.0, 1.0, 0.02});
  const std::vector<Rectangle> floor = {
      {"floor", Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY(), 2.0, 1.2, {9, 9, 9}, {}}};
  const Rendering rendering = testing::render(floor, testing::kinect_camera(), T_world_camera);
  EXPECT_TRUE(TypeParam().extract(rendering.frame, 1, std::nullopt).planes.empty());
}

TYPED_TEST(PlaneExtractors, ASphereOfNoiseHasNoPlane) {
  Rendering rendering = testing::render({facing("board", {0.0, 0.0, 2.0}, 3.0, 3.0)},
                                        testing::kinect_camera(), Eigen::Isometry3d::Identity());
  std::mt19937 generator(5);
  std::uniform_int_distribution<int> any(500, 4000);
  for (auto& reading : rendering.frame.depth.millimetres) {
    reading = static_cast<std::uint16_t>(any(generator));
  }
  EXPECT_TRUE(TypeParam().extract(rendering.frame, 1, std::nullopt).planes.empty());
}

TYPED_TEST(PlaneExtractors, QuantisationTerracesStayOneWall) {
  Rectangle wall = facing("wall", {0.0, 0.0, 2.8}, 1.4, 1.0);
  wall.u = Vector3d(std::cos(0.2), 0.0, std::sin(0.2));
  Rendering rendering =
      testing::render({wall}, testing::kinect_camera(), Eigen::Isometry3d::Identity());
  for (auto& reading : rendering.frame.depth.millimetres) {  // Kinect v1: steps of 1/8 disparity
    if (reading == 0) continue;
    const double disparity = std::round(8.0 * 585.0 * 75.0 / reading);
    reading = static_cast<std::uint16_t>(std::lround(8.0 * 585.0 * 75.0 / disparity));
  }
  const auto planes = TypeParam().extract(rendering.frame, 1, std::nullopt).planes;
  ASSERT_EQ(planes.size(), 1u);
  const geometry::Plane truth = wall.plane_seen_from(Vector3d::Zero());
  EXPECT_LT(geometry::angle_between(planes[0].surface.plane, truth), geometry::radians(0.3));
  EXPECT_NEAR(geometry::area(planes[0].surface.polygon), 2.8 * 2.0, 0.15);
}

TYPED_TEST(PlaneExtractors, ScatteredMissingReadingsLeaveAClosedSurface) {
  Rendering rendering = testing::render({facing("wall", {0.0, 0.0, 1.8}, 0.8, 0.6)},
                                        testing::kinect_camera(), Eigen::Isometry3d::Identity());
  std::mt19937 generator(3);
  for (auto& reading : rendering.frame.depth.millimetres) {
    const auto draw = generator() % 10;
    if (draw < 2) reading = draw == 0 ? 0 : 65535;
  }
  const auto planes = TypeParam().extract(rendering.frame, 1, std::nullopt).planes;
  ASSERT_EQ(planes.size(), 1u);
  EXPECT_TRUE(planes[0].surface.polygon.parts[0].holes.empty());
  EXPECT_NEAR(geometry::area(planes[0].surface.polygon), 1.6 * 1.2, 0.03);
}

TYPED_TEST(PlaneExtractors, StatisticsAreThoseOfTheInliers) {
  const auto planes =
      planes_at_origin<TypeParam>({facing("board", {0.0, 0.0, 1.5}, 0.4, 0.3)}, 0.004);
  ASSERT_EQ(planes.size(), 1u);
  const double pixels = 0.8 * 0.6 * 585.0 * 585.0 / (1.5 * 1.5);
  EXPECT_NEAR(static_cast<double>(planes[0].inliers), pixels, 0.02 * pixels);
  EXPECT_NEAR(planes[0].rms, 0.004, 0.0003);
  EXPECT_NEAR(planes[0].color[0], 200.0, 1e-9);
  EXPECT_NEAR(planes[0].color[1], 100.0, 1e-9);
  EXPECT_NEAR(planes[0].color[2], 50.0, 1e-9);
}

TYPED_TEST(PlaneExtractors, EveryPlanesPixelsAreLabelled) {
  const Rendering rendering =
      testing::render(testing::small_room(), testing::kinect_camera(), view_into_room());
  const auto found = TypeParam().extract(rendering.frame, 1, std::nullopt);
  ASSERT_EQ(found.label.size(), rendering.frame.depth.millimetres.size());
  const geometry::CameraModel& camera = rendering.frame.depth_camera;
  std::vector<std::int64_t> pixels(found.planes.size(), 0);
  for (std::size_t i = 0; i < found.label.size(); ++i) {
    if (found.label[i] == kNoPlane) continue;
    const auto plane = static_cast<std::size_t>(found.label[i]);
    ++pixels.at(plane);
    const int u = static_cast<int>(i) % camera.width, v = static_cast<int>(i) / camera.width;
    const auto p = camera.point(u, v, 0.001 * rendering.frame.depth.millimetres[i]);
    ASSERT_NEAR(found.planes[plane].surface.plane.signed_distance(p), 0.0, 0.01);
  }
  for (std::size_t k = 0; k < pixels.size(); ++k) EXPECT_EQ(pixels[k], found.planes[k].inliers);
}

TYPED_TEST(PlaneExtractors, LargerPlanesComeFirst) {
  const Rendering rendering =
      testing::render(testing::small_room(), testing::kinect_camera(), view_into_room());
  const auto planes = TypeParam().extract(rendering.frame, 1, std::nullopt).planes;
  ASSERT_GE(planes.size(), 3u);
  EXPECT_TRUE(std::is_sorted(planes.begin(), planes.end(),
                             [](const auto& a, const auto& b) { return a.inliers > b.inliers; }));
}

TYPED_TEST(PlaneExtractors, OnlyTheWantedOrientationIsReported) {
  const Eigen::Isometry3d T_world_camera = view_into_room();
  const Rendering rendering =
      testing::render(testing::small_room(), testing::kinect_camera(), T_world_camera);
  const Vector3d up_camera = T_world_camera.linear().transpose() * Vector3d::UnitZ();
  for (const char* orientation : {"horizontal", "vertical"}) {
    typename TypeParam::Config config;
    config.orientation = orientation;
    const auto planes = TypeParam(config).extract(rendering.frame, 1, up_camera).planes;
    EXPECT_EQ(planes.size(), 2u) << orientation;
    for (const PlaneObservation& plane : planes) {
      const double rise = std::abs(plane.surface.plane.normal.dot(up_camera));
      EXPECT_NEAR(rise, std::string(orientation) == "horizontal" ? 1.0 : 0.0, 0.01);
    }
    EXPECT_THROW(TypeParam(config).extract(rendering.frame, 1, std::nullopt),
                 std::invalid_argument);
  }
}

bool equal(const ExtractedPlanes& a, const ExtractedPlanes& b) {
  return std::equal(a.planes.begin(), a.planes.end(), b.planes.begin(), b.planes.end(),
                    [](const PlaneObservation& p, const PlaneObservation& q) {
                      return p.surface.plane.normal == q.surface.plane.normal &&
                             p.surface.plane.d == q.surface.plane.d &&
                             p.surface.polygon == q.surface.polygon &&
                             p.moments.to_array() == q.moments.to_array();
                    });
}

TYPED_TEST(PlaneExtractors, TheSameSeedGivesTheSamePlanesToTheLastBitFromAnyThread) {
  const Rendering rendering =
      testing::render(testing::small_room(), testing::kinect_camera(), view_into_room(), 0.01);
  const TypeParam extractor;
  const auto run = [&] { return extractor.extract(rendering.frame, 42, std::nullopt); };
  const ExtractedPlanes here = run();
  auto first = std::async(std::launch::async, run);
  auto second = std::async(std::launch::async, run);
  EXPECT_FALSE(here.planes.empty());
  EXPECT_TRUE(equal(here, first.get()));
  EXPECT_TRUE(equal(here, second.get()));
}

TYPED_TEST(PlaneExtractors, AnotherSeedFindsTheSameSurfaces) {
  const Rendering rendering =
      testing::render(testing::small_room(), testing::kinect_camera(), view_into_room(), 0.01);
  const TypeParam extractor;
  const auto planes = extractor.extract(rendering.frame, 1, std::nullopt).planes;
  for (const std::uint64_t seed : {2ULL, 3ULL, 1000000000000000ULL}) {
    const auto others = extractor.extract(rendering.frame, seed, std::nullopt).planes;
    ASSERT_EQ(others.size(), planes.size());
    for (std::size_t i = 0; i < planes.size(); ++i) {
      EXPECT_LT(geometry::angle_between(planes[i].surface.plane, others[i].surface.plane),
                geometry::radians(0.05));
    }
  }
}

TYPED_TEST(PlaneExtractors, FramesWithoutAnythingHaveNoPlanes) {
  const TypeParam extractor;
  geometry::RgbdFrame frame;
  EXPECT_TRUE(extractor.extract(frame, 1, std::nullopt).planes.empty());
  const std::vector<std::array<int, 2>> sizes = {{1, 1}, {3, 2}, {5, 7}, {641, 3}, {640, 480}};
  for (const auto& [width, height] : sizes) {
    for (const std::uint16_t reading : std::vector<std::uint16_t>{0, 65535, 1500, 20}) {
      const bool is_wall = reading == 1500 && width == 640 && height == 480;
      frame.depth = {width, height,
                     std::vector<std::uint16_t>(static_cast<std::size_t>(width * height), reading)};
      frame.depth_camera = {width, height, 500.0, 500.0, 0.5 * width, 0.5 * height};
      EXPECT_EQ(extractor.extract(frame, 1, std::nullopt).planes.size(), is_wall ? 1u : 0u)
          << width << "x" << height << " of " << reading;
    }
  }
}

TYPED_TEST(PlaneExtractors, SizesThatAreNoMultipleOfACellAreSeenToTheBorder) {
  geometry::RgbdFrame frame;
  frame.depth = {317, 203, std::vector<std::uint16_t>(317 * 203, 1000)};
  frame.depth_camera = {317, 203, 300.0, 300.0, 158.0, 101.0};
  const auto planes = TypeParam().extract(frame, 1, std::nullopt).planes;
  ASSERT_EQ(planes.size(), 1u);
  EXPECT_EQ(planes[0].inliers, 317 * 203);
  EXPECT_NEAR(geometry::area(planes[0].surface.polygon), 317.0 * 203.0 / 9e4, 0.002);
}

TYPED_TEST(PlaneExtractors, WrongFramesAreTheCallersMistake) {
  const TypeParam extractor;
  geometry::RgbdFrame frame;
  frame.depth = {4, 4, std::vector<std::uint16_t>(15, 1000)};
  frame.depth_camera = {4, 4, 5.0, 5.0, 2.0, 2.0};
  EXPECT_THROW(extractor.extract(frame, 1, std::nullopt), std::invalid_argument);
  frame.depth.millimetres.push_back(1000);
  EXPECT_NO_THROW(extractor.extract(frame, 1, std::nullopt));
  frame.depth_camera.width = 5;
  EXPECT_THROW(extractor.extract(frame, 1, std::nullopt), std::invalid_argument);
}

TEST(RansacExtractorConfig, DefaultsAreValidAndEverySettingIsVisited) {
  RansacExtractorConfig config;
  EXPECT_TRUE(config.validate().empty());
  std::set<std::string> names;
  RansacExtractorConfig::visit(config, [&](const char* name, auto&) { names.insert(name); });
  EXPECT_EQ(names.size(), 22u);
}

TEST(OrganizedExtractorConfig, DefaultsAreValidAndNonsenseIsNamed) {
  OrganizedExtractorConfig config;
  EXPECT_TRUE(config.validate().empty());
  config.max_hole_area = -1.0;
  config.min_pixels = 0;
  EXPECT_EQ(config.validate().size(), 2u);
  EXPECT_THROW(OrganizedExtractor{config}, std::invalid_argument);
}

TEST(RansacExtractorConfig, NonsenseIsNamed) {
  RansacExtractorConfig config;
  config.noise = "perhaps";
  config.min_depth = 3.0;
  config.max_depth = 2.0;
  config.alpha = std::nan("");
  EXPECT_EQ(config.validate().size(), 3u);
  EXPECT_THROW(RansacExtractor{config}, std::invalid_argument);
}

}  // namespace
}  // namespace geomap::perception
