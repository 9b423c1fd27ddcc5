// SPDX-License-Identifier: BSD-3-Clause
#include "perception/plane_pixels.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "perception/plane_extractor.hpp"

namespace geomap::perception {
namespace {

constexpr int kSide = DepthCells::kSide;

// Sums of one cell, of all readings or of those with one label: 1, z and z² times monomials of the
// ray.
struct CellSums {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  double z = 0, zx = 0, zy = 0, zz = 0, zzx = 0, zzy = 0, zzxx = 0, zzxy = 0, zzyy = 0;

  void add(double ray_x, double ray_y, double depth) {
    const double square = depth * depth;
    n += 1.0;
    x += ray_x;
    y += ray_y;
    xx += ray_x * ray_x;
    xy += ray_x * ray_y;
    yy += ray_y * ray_y;
    z += depth;
    zx += depth * ray_x;
    zy += depth * ray_y;
    zz += square;
    zzx += square * ray_x;
    zzy += square * ray_y;
    zzxx += square * ray_x * ray_x;
    zzxy += square * ray_x * ray_y;
    zzyy += square * ray_y * ray_y;
  }
};

CellSums sums_of_cell(const DepthCells& cells, int column, int row) {
  const auto at = [&cells, column, row](DepthCells::Sum sum) {
    return cells.row(row, sum)[column];
  };
  return {at(DepthCells::kCount), at(DepthCells::kX),    at(DepthCells::kY),   at(DepthCells::kXX),
          at(DepthCells::kXY),    at(DepthCells::kYY),   at(DepthCells::kZ),   at(DepthCells::kZX),
          at(DepthCells::kZY),    at(DepthCells::kZZ),   at(DepthCells::kZZX), at(DepthCells::kZZY),
          at(DepthCells::kZZXX),  at(DepthCells::kZZXY), at(DepthCells::kZZYY)};
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

  void add(const PlaneCell& cell, PartSums& sums) const {
    const CellSums s = cell.is_whole ? sums_of_cell(cells_, cell.cell % cells_.columns(),
                                                    cell.cell / cells_.columns())
                                     : sums_of_label(cell);
    const double sigma = noise_.sigma(s.z / s.n), weight = 1.0 / (sigma * sigma);
    geometry::PlaneMoments& m = sums.moments;
    m.weight += weight * s.n;
    m.first += weight * Eigen::Vector3d(s.zx, s.zy, s.z);
    m.second += weight * symmetric(s.zzxx, s.zzxy, s.zzyy, s.zzx, s.zzy, s.zz);
    m.noise += symmetric(s.xx, s.xy, s.yy, s.x, s.y, s.n);
    sums.pixels += cell.pixels;
    sums.points.push_back({Eigen::Vector3d(s.zx, s.zy, s.z) / s.n, s.n});
    if (has_color_) add_color(cell, sums);
  }

 private:
  bool is_own(int u, int v) const {
    return label_[static_cast<std::size_t>(v) * static_cast<std::size_t>(frame_.depth.width) +
                  static_cast<std::size_t>(u)] == plane_;
  }

  CellSums sums_of_label(const PlaneCell& cell) const {
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

// The label that all pixels of a cell have, or kNoPlane where they differ.
std::int16_t common_label(const std::int16_t* first, int width) {
  static_assert(kSide == 4);
  std::array<std::uint64_t, kSide> rows;
  for (std::size_t j = 0; j < kSide; ++j) {
    std::memcpy(&rows[j], first + static_cast<std::ptrdiff_t>(j) * width, sizeof rows[j]);
  }
  const bool is_common = rows[0] == std::rotl(rows[0], 16) && rows[1] == rows[0] &&
                         rows[2] == rows[0] && rows[3] == rows[0];
  return is_common ? *first : kNoPlane;
}

// Adds the pixels of one cell to the planes they are on.
void collect_cell(const geometry::DepthImage& depth, int column, int row, double readings, int cell,
                  PlanePixels& pixels) {
  if ((column + 1) * kSide <= depth.width && (row + 1) * kSide <= depth.height) {
    const std::int16_t common =
        common_label(pixels.label.data() + static_cast<std::ptrdiff_t>(row * kSide) * depth.width +
                         column * kSide,
                     depth.width);
    if (common != kNoPlane) {
      const Eigen::Vector2i corner(column * kSide, row * kSide);
      pixels.cells[static_cast<std::size_t>(common)].push_back(
          {cell, kSide * kSide, true, {corner, corner + Eigen::Vector2i::Constant(kSide - 1)}});
      return;
    }
  }
  std::array<PlaneCell*, kSide * kSide> known{};
  std::array<std::int16_t, kSide * kSide> plane{};
  std::size_t count = 0;
  for (int v = row * kSide; v < std::min((row + 1) * kSide, depth.height); ++v) {
    const std::int16_t* line = pixels.label.data() + static_cast<std::ptrdiff_t>(v) * depth.width;
    for (int u = column * kSide; u < std::min((column + 1) * kSide, depth.width); ++u) {
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
  PartSums sums;
  sums.points.reserve(part.size());
  const PartSummer summer(frame, cells, noise, label, plane);
  for (const PlaneCell* cell : part) summer.add(*cell, sums);
  return sums;
}

}  // namespace geomap::perception
