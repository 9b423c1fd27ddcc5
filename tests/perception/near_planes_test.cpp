// SPDX-License-Identifier: BSD-3-Clause
#include "perception/near_planes.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <set>

namespace geomap::perception {
namespace {

std::set<std::size_t> near_by_hand(const DepthCells& cells, const std::vector<std::int16_t>& label,
                                   int column, int row) {
  std::set<std::size_t> near;
  for (int r = 0; r < cells.rows(); ++r) {
    for (int c = 0; c < cells.columns(); ++c) {
      const std::int16_t plane = label[static_cast<std::size_t>(cells.index(c, r))];
      const bool is_near =
          std::abs(c - column) <= NearPlanes::kReach && std::abs(r - row) <= NearPlanes::kReach;
      if (is_near && plane >= 0) near.insert(static_cast<std::size_t>(plane));
    }
  }
  return near;
}

TEST(NearPlanes, AreThoseOfTheCellsAroundHoweverManyThereAre) {
  geometry::CameraModel camera;
  camera.width = 70;
  camera.height = 42;
  camera.fx = camera.fy = 60.0;
  geometry::DepthImage depth;
  depth.width = camera.width;
  depth.height = camera.height;
  depth.millimetres.assign(static_cast<std::size_t>(depth.width * depth.height), 1000);
  const DepthCells cells(depth, camera, 0.3, 6.0);
  std::mt19937 random(1);
  for (const std::size_t planes :
       {std::size_t{0}, std::size_t{1}, std::size_t{64}, std::size_t{200}}) {
    std::vector<std::int16_t> label(static_cast<std::size_t>(cells.size()), -1);
    for (std::int16_t& plane : label) {
      if (planes > 0 && random() % 8 == 0) plane = static_cast<std::int16_t>(random() % planes);
    }
    const NearPlanes near(cells, label, planes);
    for (int row = 0; row < cells.rows(); ++row) {
      for (int column = 0; column < cells.columns(); ++column) {
        const auto cell = static_cast<std::size_t>(cells.index(column, row));
        const std::set<std::size_t> expected = near_by_hand(cells, label, column, row);
        std::vector<std::size_t> visited;
        near.visit(cell, [&](std::size_t plane) { visited.push_back(plane); });
        EXPECT_EQ(visited, std::vector<std::size_t>(expected.begin(), expected.end()));
        const int only = expected.size() == 1 ? static_cast<int>(*expected.begin()) : -1;
        EXPECT_EQ(near.only(cell), only);
      }
    }
  }
}

}  // namespace
}  // namespace geomap::perception
