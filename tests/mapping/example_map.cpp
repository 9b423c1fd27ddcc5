// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/example_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <utility>

namespace geomap::testing {

using geometry::Polygon;
using geometry::Ring;
using mapping::MapFeature;

Ring rectangle_ring(double left, double bottom, double right, double top) {
  return {geometry::to_grid({left, bottom}), geometry::to_grid({right, bottom}),
          geometry::to_grid({right, top}), geometry::to_grid({left, top})};
}

Ring reversed(Ring ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

MapFeature make_feature(const DrawnFeature& drawn, Polygon polygon) {
  MapFeature feature;
  feature.id = drawn.id;
  feature.surface.plane = geometry::Plane::through(drawn.origin, drawn.normal.normalized());
  feature.surface.frame = geometry::PlaneFrame::on(feature.surface.plane, drawn.origin,
                                                   drawn.x_axis, Eigen::Vector3d(0.1, 0.2, 0.97));
  feature.surface.polygon = std::move(polygon);
  feature.observations = {drawn.id};
  feature.color = {120.0, 60.5, 30.0};
  return feature;
}

mapping::MapSnapshot example_map(const Eigen::Vector3d& origin) {
  const auto at = [&](double x, double y, double z) -> Eigen::Vector3d {
    return origin + Eigen::Vector3d(x, y, z);
  };
  MapFeature floor = make_feature({.id = {1000, 0}, .origin = at(0, 0, 0)},
                                  {{{rectangle_ring(-2.0, -1.5, 2.0, 1.5), {}}}});
  MapFeature table = make_feature(
      {.id = {1000, 2}, .origin = at(0.3, 0.1, 0.74)},
      {{{rectangle_ring(-0.6, -0.4, 0.6, 0.4), {reversed(rectangle_ring(-0.2, -0.1, 0.2, 0.2))}}}});
  table.label = "table <A & \"B\">";
  table.observations = {{1000, 2}, {2000, 5}, {4000, 1}};
  table.rms = 0.004;
  table.sigma_angle = 0.002;
  table.sigma_d = 0.001;
  MapFeature wall = make_feature(
      {.id = {2000, 0}, .origin = at(0, 2, 1), .normal = {0, -1, 0}, .x_axis = {1, 0, 0}},
      {{{rectangle_ring(-2.0, -1.0, -1.0, 1.0), {}}, {rectangle_ring(0.0, -1.0, 1.5, 1.0), {}}}});
  MapFeature board =
      make_feature({.id = {3000, 1}, .origin = at(-1, -0.5, 0.4), .normal = {0, 1, 1}},
                   {{{rectangle_ring(-0.3, -0.25, 0.3, 0.25), {}}}});
  board.color = {};
  return {17, "5eed", {wall, table, board, floor}};
}

mapping::MapSnapshot crowd(int features) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  mapping::MapSnapshot map;
  for (int i = 0; i < features; ++i) {
    const Eigen::Vector3d normal(unit(random), unit(random), unit(random));
    const double half = 0.3 + 0.2 * unit(random);
    map.features.push_back(
        make_feature({.id = {i, 0},
                      .origin = 5.0 * Eigen::Vector3d(unit(random), unit(random), unit(random)),
                      .normal = normal},
                     {{{rectangle_ring(-half, -half, half, half), {}}}}));
  }
  return map;
}

bool has_program(const std::string& name) { return run_quietly("command -v " + name) == 0; }

int run_quietly(const std::string& command) {
  return std::system((command + " >/dev/null 2>&1").c_str());
}

std::filesystem::path fresh_folder() {
  const ::testing::TestInfo* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "geomap" /
                                       test->test_suite_name() / test->name();
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace geomap::testing
