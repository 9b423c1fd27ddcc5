// SPDX-License-Identifier: BSD-3-Clause
#include "perception/plane_pixels.hpp"

#include <algorithm>
#include <array>

namespace geomap::perception {
namespace {

constexpr int kSide = DepthCells::kSide;

// Sums over the pixels of one cell.
class CellSummer {
 public:
  CellSummer(const geometry::RgbdFrame& frame, const DepthCells& cells,
             const geometry::DepthNoise& noise, const std::vector<std::int16_t>& label,
             int row_step)
      : depth_(frame.depth),
        camera_(frame.depth_camera),
        color_(frame.color),
        has_color_(color_.width == depth_.width && color_.height == depth_.height),
        columns_(cells.columns()),
        label_(label),
        row_step_(row_step) {
    std::uint16_t largest = 0;
    for (std::size_t i = 0; i < label.size(); ++i) {
      if (label[i] != kNoPlane) largest = std::max(largest, depth_.millimetres[i]);
    }
    weight_.assign(static_cast<std::size_t>(largest) + 1, 0.0);
    for (std::size_t mm = 1; mm < weight_.size(); ++mm) {
      const double sigma = noise.sigma(0.001 * static_cast<double>(mm));
      weight_[mm] = 1.0 / (sigma * sigma);
    }
  }

  // The planes in a cell, in the order of their first pixels.
  int distinct_labels(int column, int row, std::array<std::int16_t, kSide * kSide>& labels) const {
    const int u_end = std::min((column + 1) * kSide, depth_.width);
    const int v_end = std::min((row + 1) * kSide, depth_.height);
    int distinct = 0;
    std::int16_t previous = kNoPlane;
    for (int v = row * kSide; v < v_end; v += row_step_) {
      const std::int16_t* line = label_.data() + static_cast<std::ptrdiff_t>(v) * depth_.width;
      for (int u = column * kSide; u < u_end; ++u) {
        if (line[u] == previous || line[u] == kNoPlane) continue;
        previous = line[u];
        const auto end = labels.begin() + distinct;
        if (std::find(labels.begin(), end, previous) == end) {
          labels[static_cast<std::size_t>(distinct++)] = previous;
        }
      }
    }
    return distinct;
  }

  PlaneCell sum(int column, int row, std::int16_t label) const {
    const int u0 = column * kSide, v0 = row * kSide;
    const int u_end = std::min(u0 + kSide, depth_.width),
              v_end = std::min(v0 + kSide, depth_.height);
    const double per_fx = 1.0 / camera_.fx;

    PlaneCell result;
    result.cell = row * columns_ + column;
    PlaneSums& sums = result.sums;
    // Sums of 1, w, wz and wz² times monomials of the ray (x, y); y is the same along a row.
    double w = 0, wz = 0, wzx = 0, wzy = 0, s = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
    double n = 0, nx = 0, ny = 0, nxx = 0, nxy = 0, nyy = 0;
    for (int v = v0; v < v_end; v += row_step_) {
      double row_wz = 0, row_wzx = 0, row_s = 0, row_sx = 0, row_n = 0, row_nx = 0;
      for (int u = u0; u < u_end; ++u) {
        const auto pixel = static_cast<std::size_t>(v * depth_.width + u);
        if (label_[pixel] != label) continue;
        result.box.extend(Eigen::Vector2i(u, v));
        const double x = (u - camera_.cx) * per_fx;
        const std::size_t reading = depth_.millimetres[pixel];
        const double z = 0.001 * static_cast<double>(reading);
        const double a = weight_[reading];
        const double b = a * z;
        const double c = b * z;
        const double cx = c * x;
        w += a;
        row_wz += b;
        row_wzx += b * x;
        row_s += c;
        row_sx += cx;
        sxx += cx * x;
        row_n += 1.0;
        row_nx += x;
        nxx += x * x;
        if (has_color_) {
          for (std::size_t k = 0; k < 3; ++k) sums.color[k] += color_.rgb[3 * pixel + k];
        }
      }
      const double y = (v - camera_.cy) / camera_.fy;
      wz += row_wz;
      wzx += row_wzx;
      wzy += y * row_wz;
      s += row_s;
      sx += row_sx;
      sy += y * row_s;
      sxy += y * row_sx;
      syy += y * y * row_s;
      n += row_n;
      nx += row_nx;
      ny += y * row_n;
      nxy += y * row_nx;
      nyy += y * y * row_n;
    }
    sums.pixels = static_cast<int>(n);
    sums.moments.weight = w;
    sums.moments.first << wzx, wzy, wz;
    sums.moments.second << sxx, sxy, sx, sxy, syy, sy, sx, sy, s;
    sums.moments.noise << nxx, nxy, nx, nxy, nyy, ny, nx, ny, n;
    return result;
  }

 private:
  const geometry::DepthImage& depth_;
  const geometry::CameraModel& camera_;
  const geometry::ColorImage& color_;
  bool has_color_;
  int columns_;
  const std::vector<std::int16_t>& label_;
  int row_step_;
  std::vector<double> weight_;  // 1/σ_z² per depth reading [1/m²]
};

// Empty lists with room for about as many cells as the planes cover: the largest memory in use.
std::vector<std::vector<PlaneCell>> reserve_cells(const std::vector<std::int16_t>& label,
                                                  std::size_t planes, int row_step) {
  std::vector<std::size_t> covered(planes, 0);
  for (std::size_t i = 0; i < label.size(); i += kSide) {
    if (label[i] != kNoPlane) ++covered[static_cast<std::size_t>(label[i])];
  }
  std::vector<std::vector<PlaneCell>> cells(planes);
  for (std::size_t i = 0; i < planes; ++i) {
    cells[i].reserve(covered[i] * static_cast<std::size_t>(row_step) / kSide + kSide);
  }
  return cells;
}

}  // namespace

PlaneSums& PlaneSums::operator+=(const PlaneSums& other) {
  moments += other.moments;
  pixels += other.pixels;
  for (std::size_t k = 0; k < color.size(); ++k) color[k] += other.color[k];
  return *this;
}

PlanePixels sum_pixels(const geometry::RgbdFrame& frame, const DepthCells& cells,
                       const geometry::DepthNoise& noise, std::vector<std::int16_t> label,
                       std::size_t planes, int row_step) {
  PlanePixels result;
  result.label = std::move(label);
  result.cells = reserve_cells(result.label, planes, row_step);
  result.cell_label.assign(static_cast<std::size_t>(cells.size()), kNoPlane);
  const CellSummer summer(frame, cells, noise, result.label, row_step);
  std::array<std::int16_t, kSide * kSide> labels{};
  for (int row = 0; row < cells.rows(); ++row) {
    for (int column = 0; column < cells.columns(); ++column) {
      const int distinct = summer.distinct_labels(column, row, labels);
      int most = 0;
      for (int k = 0; k < distinct; ++k) {
        const std::int16_t plane = labels[static_cast<std::size_t>(k)];
        auto& of_plane = result.cells[static_cast<std::size_t>(plane)];
        of_plane.push_back(summer.sum(column, row, plane));
        if (of_plane.back().sums.pixels <= most) continue;
        most = of_plane.back().sums.pixels;
        result.cell_label[static_cast<std::size_t>(cells.index(column, row))] = plane;
      }
    }
  }
  return result;
}

}  // namespace geomap::perception
