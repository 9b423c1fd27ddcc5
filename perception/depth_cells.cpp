// SPDX-License-Identifier: BSD-3-Clause
#include "perception/depth_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace geomap::perception {
namespace {

constexpr int kSide = DepthCells::kSide;
constexpr std::size_t kDepthValues = 65536;

// Inverse depth [1/m] of every possible reading; 0 for none.
std::vector<double> inverse_table(double near, double far) {
  std::vector<double> table(kDepthValues, 0.0);
  const auto first = static_cast<std::size_t>(std::clamp(std::ceil(near * 1000.0), 1.0, 65534.0));
  const auto last = static_cast<std::size_t>(std::clamp(std::floor(far * 1000.0), 0.0, 65534.0));
  for (std::size_t mm = first; mm <= last; ++mm) table[mm] = 1000.0 / static_cast<double>(mm);
  return table;
}

// Sums with pixel offsets (i, j) from the cell's first pixel in place of rays.
struct OffsetSums {
  double count = 0.0, i = 0.0, j = 0.0, ii = 0.0, ij = 0.0, jj = 0.0;
  double q = 0.0, qi = 0.0, qj = 0.0, qq = 0.0;

  void add_row(const double* values, int width, int row) {
    double n = 0.0, ni = 0.0, nii = 0.0, s = 0.0, si = 0.0;
    for (int k = 0; k < width; ++k) {
      const double value = values[k];
      const double is_read = value > 0.0 ? 1.0 : 0.0;
      n += is_read;
      ni += k * is_read;
      nii += k * k * is_read;
      s += value;
      si += k * value;
      qq += value * value;
    }
    count += n;
    i += ni;
    ii += nii;
    j += row * n;
    jj += row * row * n;
    ij += row * ni;
    q += s;
    qi += si;
    qj += row * s;
  }

  // x = x0 + i·sx, y = y0 + j·sy.
  InverseDepthSums in_rays(double x0, double y0, double sx, double sy) const {
    InverseDepthSums r;
    r.count = count;
    r.x = x0 * count + sx * i;
    r.y = y0 * count + sy * j;
    r.xx = x0 * x0 * count + 2.0 * x0 * sx * i + sx * sx * ii;
    r.yy = y0 * y0 * count + 2.0 * y0 * sy * j + sy * sy * jj;
    r.xy = x0 * y0 * count + x0 * sy * j + y0 * sx * i + sx * sy * ij;
    r.q = q;
    r.qx = x0 * q + sx * qi;
    r.qy = y0 * q + sy * qj;
    r.qq = qq;
    return r;
  }
};

}  // namespace

InverseDepthSums& InverseDepthSums::operator+=(const InverseDepthSums& o) {
  count += o.count;
  x += o.x;
  y += o.y;
  xx += o.xx;
  xy += o.xy;
  yy += o.yy;
  q += o.q;
  qx += o.qx;
  qy += o.qy;
  qq += o.qq;
  return *this;
}

InverseDepthSums& InverseDepthSums::operator-=(const InverseDepthSums& o) {
  count -= o.count;
  x -= o.x;
  y -= o.y;
  xx -= o.xx;
  xy -= o.xy;
  yy -= o.yy;
  q -= o.q;
  qx -= o.qx;
  qy -= o.qy;
  qq -= o.qq;
  return *this;
}

std::optional<InverseDepthFit> fit_plane(const InverseDepthSums& s) {
  if (s.count < 5.5) return std::nullopt;
  const double n = s.count, mx = s.x / n, my = s.y / n, mq = s.q / n;
  const double cxx = s.xx - n * mx * mx, cxy = s.xy - n * mx * my, cyy = s.yy - n * my * my;
  const double cqx = s.qx - n * mq * mx, cqy = s.qy - n * mq * my, cqq = s.qq - n * mq * mq;
  const double determinant = cxx * cyy - cxy * cxy;
  if (!(determinant > 1e-3 * cxx * cyy) || !(mq > 0.0)) return std::nullopt;
  const double a = (cqx * cyy - cqy * cxy) / determinant;
  const double b = (cqy * cxx - cqx * cxy) / determinant;
  const double residual = std::max(0.0, cqq - a * cqx - b * cqy);
  return InverseDepthFit{{a, b, mq - a * mx - b * my}, std::sqrt(residual / (n - 3.0))};
}

DepthCells::DepthCells(const geometry::DepthImage& depth, const geometry::CameraModel& camera,
                       double near, double far)
    : columns_((depth.width + kSide - 1) / kSide), rows_((depth.height + kSide - 1) / kSide) {
  cells_.resize(static_cast<std::size_t>(size()));
  read(depth, camera, near, far);
  integrate();
}

void DepthCells::read(const geometry::DepthImage& depth, const geometry::CameraModel& camera,
                      double near, double far) {
  const std::vector<double> inverse = inverse_table(near, far);
  std::vector<OffsetSums> line(static_cast<std::size_t>(columns_));
  for (int row = 0; row < rows_; ++row) {
    std::fill(line.begin(), line.end(), OffsetSums{});
    const int height = std::min(kSide, depth.height - row * kSide);
    for (int j = 0; j < height; ++j) {
      const std::uint16_t* pixels =
          depth.millimetres.data() + static_cast<std::ptrdiff_t>(row * kSide + j) * depth.width;
      for (int column = 0; column < columns_; ++column) {
        const int width = std::min(kSide, depth.width - column * kSide);
        std::array<double, kSide> values{};
        for (int i = 0; i < width; ++i) values[static_cast<std::size_t>(i)] = inverse[pixels[i]];
        line[static_cast<std::size_t>(column)].add_row(values.data(), kSide, j);
        pixels += kSide;
      }
    }
    for (int column = 0; column < columns_; ++column) {
      const Eigen::Vector3d ray = camera.ray(column * kSide, row * kSide);
      cells_[static_cast<std::size_t>(index(column, row))] =
          line[static_cast<std::size_t>(column)].in_rays(ray.x(), ray.y(), 1.0 / camera.fx,
                                                         1.0 / camera.fy);
    }
  }
}

void DepthCells::integrate() {
  integral_.resize(static_cast<std::size_t>((columns_ + 1) * (rows_ + 1)));
  for (int row = 0; row < rows_; ++row) {
    InverseDepthSums line;
    for (int column = 0; column < columns_; ++column) {
      line += cell(index(column, row));
      InverseDepthSums sum = corner(column + 1, row);
      sum += line;
      integral_[static_cast<std::size_t>((row + 1) * (columns_ + 1) + column + 1)] = sum;
    }
  }
}

InverseDepthSums DepthCells::window(int c0, int r0, int c1, int r1) const {
  c0 = std::clamp(c0, 0, columns_);
  c1 = std::clamp(c1, c0, columns_);
  r0 = std::clamp(r0, 0, rows_);
  r1 = std::clamp(r1, r0, rows_);
  InverseDepthSums sum = corner(c1, r1);
  sum -= corner(c0, r1);
  sum -= corner(c1, r0);
  sum += corner(c0, r0);
  return sum;
}

}  // namespace geomap::perception
