// SPDX-License-Identifier: BSD-3-Clause
#include "perception/plane_parts.hpp"

namespace geomap::perception {
namespace {

constexpr int kColumns = 160;
const geometry::CameraModel kCamera{640, 480, 600.0, 600.0, 320.0, 240.0};
const geometry::Plane kWall{-Eigen::Vector3d::UnitZ(), 1.0};  // 1 m: 6 pixels are a centimetre

PlaneCell cell_at(int column, int row) {
  PlaneCell cell;
  cell.cell = row * kColumns + column;
  cell.pixels = 16;
  cell.box.extend(Eigen::Vector2i(4 * column, 4 * row));
  cell.box.extend(Eigen::Vector2i(4 * column + 3, 4 * row + 3));
  return cell;
}

// Two squares of 10 x 10 cells, `gap` cells apart.
std::vector<PlaneCell> two_squares(int gap) {
  std::vector<PlaneCell> cells;
  for (int row = 20; row < 30; ++row) {
    for (int column = 20; column < 40 + gap; ++column) {
      if (column < 30 || column >= 30 + gap) cells.push_back(cell_at(column, row));
    }
  }
  return cells;
}

TEST(PlaneParts, AGapWiderThanAllowedSeparates) {
  // 3 cm are 18 pixels.
  for (const auto& [gap, parts] : {std::pair{0, 1u}, {4, 1u}, {5, 2u}, {20, 2u}}) {
    const auto cells = two_squares(gap);
    EXPECT_EQ(split_into_parts(kCamera, kColumns, kWall, cells, 0.03, 100).size(), parts) << gap;
  }
}

TEST(PlaneParts, EveryCellIsInOnePart) {
  const auto cells = two_squares(10);
  const auto parts = split_into_parts(kCamera, kColumns, kWall, cells, 0.03, 100);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].size(), 100u);
  EXPECT_EQ(parts[1].size(), 100u);
}

TEST(PlaneParts, ASnakeIsOnePart) {
  std::vector<PlaneCell> cells;  // a spiral's arms are far apart, but it is one line
  for (int column = 10; column < 40; ++column) cells.push_back(cell_at(column, 10));
  for (int row = 11; row < 40; ++row) {
    cells.push_back(cell_at(10, row));
    cells.push_back(cell_at(39, row));
  }
  EXPECT_EQ(split_into_parts(kCamera, kColumns, kWall, cells, 0.03, 100).size(), 1u);
}

TEST(PlaneParts, TinyPartsAreLeftOut) {
  auto cells = two_squares(10);
  cells.push_back(cell_at(100, 100));
  EXPECT_EQ(split_into_parts(kCamera, kColumns, kWall, cells, 0.03, 100).size(), 2u);
  EXPECT_EQ(split_into_parts(kCamera, kColumns, kWall, cells, 0.03, 1).size(), 3u);
}

}  // namespace
}  // namespace geomap::perception
