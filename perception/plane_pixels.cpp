// SPDX-License-Identifier: BSD-3-Clause
#include "perception/plane_pixels.hpp"

#include <algorithm>
#include <array>

#include "perception/cell_label.hpp"
#include "perception/plane_extractor.hpp"

namespace geomap::perception {
namespace {

constexpr int kCellSide = DepthCells::kSide;
constexpr std::size_t kEnoughPoints = 500;  // of a larger part, every second one, or third

// Sums of one cell, of all readings or of those with one label.
struct CellSums {
  std::array<double, 6> rays{};    // 1, x, y, xx, xy, yy
  std::array<double, 9> depths{};  // z times 1, x, y, and z² times 1, x, y, xx, xy, yy

  void add(double x, double y, double z) {
    const double zz = z * z;
    const std::array<double, 6> ray = {1.0, x, y, x * x, x * y, y * y};
    for (std::size_t k = 0; k < 6; ++k) rays[k] += ray[k];
    for (std::size_t k = 0; k < 3; ++k) depths[k] += z * ray[k];
    for (std::size_t k = 0; k < 6; ++k) depths[k + 3] += zz * ray[k];
  }
  void add(const CellSums& other, double weight) {
    for (std::size_t k = 0; k < rays.size(); ++k) rays[k] += other.rays[k];
    for (std::size_t k = 0; k < depths.size(); ++k) depths[k] += weight * other.depths[k];
  }
  double count() const { return rays[0]; }
  Eigen::Vector3d points() const { return {depths[1], depths[2], depths[0]}; }
};

CellSums sums_of_cell(const DepthCells& cells, int column, int row) {
  CellSums sums;
  const double* at = cells.row(row, DepthCells::kCount) + column;
  for (double& sum : sums.rays) {
    sum = *at;
    at += cells.columns();
  }
  at = cells.row(row, DepthCells::kZ) + column;
  for (double& sum : sums.depths) {
    sum = *at;
    at += cells.columns();
  }
  return sums;
}

Eigen::Matrix3d symmetric(double xx, double xy, double yy, double x, double y, double one) {
  Eigen::Matrix3d matrix;
  matrix << xx, xy, x, xy, yy, y, x, y, one;
  return matrix;
}

class PartSummer {
 public:
  PartSummer(const geometry::RgbdFrame& frame, const DepthCells& cells,
             const geometry::DepthNoise& noise, const std::vector<std::int16_t>& label,
             std::int16_t plane)
      : frame_(frame),
        cells_(cells),
        noise_(noise),
        label_(label),
        plane_(plane),
        has_color_(frame.color.width == frame.depth.width &&
                   frame.color.height == frame.depth.height) {}

  PartSums sum_up(const PlanePart& part) const {
    PartSums sums;
    const std::size_t step = 1 + part.size() / kEnoughPoints;
    sums.points.reserve(part.size() / step + 1);
    CellSums total;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const PlaneCell& cell = *part[i];
      const CellSums s = sums_of(cell);
      const double sigma = noise_.sigma(s.depths[0] / s.count()), weight = 1.0 / (sigma * sigma);
      total.add(s, weight);
      sums.moments.weight += weight * s.count();
      sums.pixels += cell.pixels;
      if (i % step == 0) sums.points.push_back({s.points() / s.count(), s.count()});
      if (has_color_) add_color(cell, sums);
    }
    const auto& [n, x, y, xx, xy, yy] = total.rays;
    const auto& [z, zx, zy, zz, zzx, zzy, zzxx, zzxy, zzyy] = total.depths;
    sums.moments.first = total.points();
    sums.moments.second = symmetric(zzxx, zzxy, zzyy, zzx, zzy, zz);
    sums.moments.noise = symmetric(xx, xy, yy, x, y, n);
    return sums;
  }

 private:
  bool is_own(int u, int v) const {
    return label_[static_cast<std::size_t>(v) * static_cast<std::size_t>(frame_.depth.width) +
                  static_cast<std::size_t>(u)] == plane_;
  }

  CellSums sums_of(const PlaneCell& cell) const {
    const Eigen::Vector2i& corner = cell.box.min();
    if (cell.is_whole) return sums_of_cell(cells_, corner.x() / kCellSide, corner.y() / kCellSide);
    const geometry::CameraModel& camera = frame_.depth_camera;
    CellSums sums;
    for (int v = cell.box.min().y(); v <= cell.box.max().y(); ++v) {
      for (int u = cell.box.min().x(); u <= cell.box.max().x(); ++u) {
        if (!is_own(u, v)) continue;
        sums.add((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy,
                 0.001 * frame_.depth.at(u, v));
      }
    }
    return sums;
  }

  void add_color(const PlaneCell& cell, PartSums& sums) const {
    std::array<int, 3> color{};
    for (int v = cell.box.min().y(); v <= cell.box.max().y(); ++v) {
      const std::uint8_t* rgb =
          frame_.color.rgb.data() + 3 * static_cast<std::ptrdiff_t>(v) * frame_.color.width;
      for (int u = cell.box.min().x(); u <= cell.box.max().x(); ++u) {
        if (!is_own(u, v)) continue;
        for (std::size_t k = 0; k < 3; ++k) color[k] += rgb[3 * static_cast<std::size_t>(u) + k];
      }
    }
    for (std::size_t k = 0; k < 3; ++k) sums.color[k] += color[k];
  }

  const geometry::RgbdFrame& frame_;
  const DepthCells& cells_;
  const geometry::DepthNoise& noise_;
  const std::vector<std::int16_t>& label_;
  std::int16_t plane_;
  bool has_color_;
};

// Adds the pixels of one cell to the planes they are on.
void collect_cell(const geometry::DepthImage& depth, int column, int row, double readings, int cell,
                  PlanePixels& pixels) {
  if (const std::int16_t common = common_label(pixels.label, depth, column, row);
      common != kNoPlane) {
    const Eigen::Vector2i corner(column * kCellSide, row * kCellSide);
    pixels.cells[static_cast<std::size_t>(common)].push_back(
        {cell,
         kCellSide * kCellSide,
         true,
         {corner, corner + Eigen::Vector2i::Constant(kCellSide - 1)}});
    return;
  }
  std::array<PlaneCell*, kCellSide * kCellSide> known{};
  std::array<std::int16_t, kCellSide * kCellSide> plane{};
  std::size_t count = 0;
  for (int v = row * kCellSide; v < std::min((row + 1) * kCellSide, depth.height); ++v) {
    const std::int16_t* line = pixels.label.data() + static_cast<std::ptrdiff_t>(v) * depth.width;
    for (int u = column * kCellSide; u < std::min((column + 1) * kCellSide, depth.width); ++u) {
      if (line[u] == kNoPlane) continue;
      std::size_t i = 0;
      while (i < count && plane[i] != line[u]) ++i;
      if (i == count) {
        plane[count] = line[u];
        known[count] = &pixels.cells[static_cast<std::size_t>(line[u])].emplace_back();
        known[count++]->cell = cell;
      }
      ++known[i]->pixels;
      known[i]->box.extend(Eigen::Vector2i(u, v));
    }
  }
  if (count == 1) known[0]->is_whole = known[0]->pixels == static_cast<int>(readings);
}

}  // namespace

PlanePixels collect_pixels(const geometry::RgbdFrame& frame, const DepthCells& cells,
                           std::vector<std::int16_t> label, std::size_t planes) {
  PlanePixels result;
  result.label = std::move(label);
  result.cells.resize(planes);
  for (int row = 0; row < cells.rows(); ++row) {
    const double* readings = cells.row(row, DepthCells::kCount);
    for (int column = 0; column < cells.columns(); ++column) {
      if (readings[column] == 0.0) continue;
      collect_cell(frame.depth, column, row, readings[column], cells.index(column, row), result);
    }
  }
  return result;
}

PartSums sum_part(const geometry::RgbdFrame& frame, const DepthCells& cells,
                  const geometry::DepthNoise& noise, const std::vector<std::int16_t>& label,
                  std::int16_t plane, const PlanePart& part) {
  return PartSummer(frame, cells, noise, label, plane).sum_up(part);
}

}  // namespace geomap::perception
