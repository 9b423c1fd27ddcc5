// SPDX-License-Identifier: BSD-3-Clause
#include "perception/depth_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/multiversion.hpp"

namespace geomap::perception {
namespace {

constexpr int kSide = DepthCells::kSide;

// Sums over the pixels of one column of a cell, for all columns of a row of cells; j counts rows
// from the cell's first one.
struct ColumnSums {
  explicit ColumnSums(int pixels) : storage(static_cast<std::size_t>(11 * pixels)) {
    double* at = storage.data();
    for (double** sum : {&n, &nj, &njj, &q, &qj, &qq, &z, &zj, &zz, &zzj, &zzjj}) {
      *sum = at;
      at += pixels;
    }
  }
  std::vector<double> storage;
  double *n, *nj, *njj, *q, *qj, *qq, *z, *zj, *zz, *zzj, *zzjj;
};

// 1 for a reading in range, else 0; without a branch, so that loops become vector code.
inline int is_read(int reading, int nearest, int farthest) {
  return static_cast<int>(reading >= nearest) & static_cast<int>(reading <= farthest);
}

// Readings in range, all four rows of a row of cells. Inverse depth is rounded to a float: a
// thousandth of a reading's own rounding.
GEOMAP_MULTIVERSION void sum_columns(const std::uint16_t* pixels, int stride, int width,
                                     std::uint16_t nearest, std::uint16_t farthest,
                                     double* __restrict n, double* __restrict nj,
                                     double* __restrict njj, double* __restrict q,
                                     double* __restrict qj, double* __restrict qq) {
  static_assert(kSide == 4);
  const std::uint16_t* __restrict row0 = pixels;
  const std::uint16_t* __restrict row1 = row0 + stride;
  const std::uint16_t* __restrict row2 = row1 + stride;
  const std::uint16_t* __restrict row3 = row2 + stride;
  const auto count = [nearest, farthest](int reading) {
    return static_cast<float>(is_read(reading, nearest, farthest));
  };
  const auto divisor = [](int reading) {
    return static_cast<float>(reading + static_cast<int>(reading == 0));
  };
  for (int u = 0; u < width; ++u) {
    const float n0 = count(row0[u]), n1 = count(row1[u]), n2 = count(row2[u]), n3 = count(row3[u]);
    const double q0 = 1000.0F / divisor(row0[u]) * n0, q1 = 1000.0F / divisor(row1[u]) * n1,
                 q2 = 1000.0F / divisor(row2[u]) * n2, q3 = 1000.0F / divisor(row3[u]) * n3;
    n[u] = n0 + n1 + n2 + n3;
    nj[u] = n1 + 2.0F * n2 + 3.0F * n3;
    njj[u] = n1 + 4.0F * n2 + 9.0F * n3;
    q[u] = (q0 + q1) + (q2 + q3);
    qj[u] = q1 + 2.0 * q2 + 3.0 * q3;
    qq[u] = (q0 * q0 + q1 * q1) + (q2 * q2 + q3 * q3);
  }
}

// The same for depth [m].
GEOMAP_MULTIVERSION void sum_depth_columns(const std::uint16_t* pixels, int stride, int width,
                                           std::uint16_t nearest, std::uint16_t farthest,
                                           double* __restrict z, double* __restrict zj,
                                           double* __restrict zz, double* __restrict zzj,
                                           double* __restrict zzjj) {
  const std::uint16_t* __restrict row0 = pixels;
  const std::uint16_t* __restrict row1 = row0 + stride;
  const std::uint16_t* __restrict row2 = row1 + stride;
  const std::uint16_t* __restrict row3 = row2 + stride;
  const auto depth = [nearest, farthest](int reading) {
    return 0.001 * (reading * is_read(reading, nearest, farthest));
  };
  for (int u = 0; u < width; ++u) {
    const double z0 = depth(row0[u]), z1 = depth(row1[u]), z2 = depth(row2[u]), z3 = depth(row3[u]);
    const double zz1 = z1 * z1, zz2 = z2 * z2, zz3 = z3 * z3;
    z[u] = (z0 + z1) + (z2 + z3);
    zj[u] = z1 + 2.0 * z2 + 3.0 * z3;
    zz[u] = (z0 * z0 + zz1) + (zz2 + zz3);
    zzj[u] = zz1 + 2.0 * zz2 + 3.0 * zz3;
    zzjj[u] = zz1 + 4.0 * zz2 + 9.0 * zz3;
  }
}

// Of the sums over the four columns of a cell: plain, times the column's number, and its square.
inline double fold(const double* column) {
  return (column[0] + column[1]) + (column[2] + column[3]);
}
inline double fold_by_i(const double* column) {
  return column[1] + 2.0 * column[2] + 3.0 * column[3];
}
inline double fold_by_ii(const double* column) {
  return column[1] + 4.0 * column[2] + 9.0 * column[3];
}

// From columns to cells, and from pixel offsets to rays: x = x0 + i·sx, y = y0 + j·sy. `cells` are
// kSums lists.
GEOMAP_MULTIVERSION void fold_columns(const double* __restrict n, const double* __restrict nj,
                                      const double* __restrict njj, const double* __restrict q,
                                      const double* __restrict qj, const double* __restrict qq,
                                      int columns, double x_first, double y0, double sx, double sy,
                                      double* __restrict cells) {
  double* __restrict sums[DepthCells::kInverseSums];
  for (int k = 0; k < DepthCells::kInverseSums; ++k)
    sums[k] = cells + static_cast<std::ptrdiff_t>(k) * columns;
  for (int c = 0; c < columns; ++c) {
    const int u = c * kSide;
    const double x0 = x_first + c * (kSide * sx);
    const double count = fold(n + u), depth = fold(q + u);
    const double xi = sx * fold_by_i(n + u), yj = sy * fold(nj + u);
    sums[DepthCells::kCount][c] = count;
    sums[DepthCells::kX][c] = x0 * count + xi;
    sums[DepthCells::kY][c] = y0 * count + yj;
    sums[DepthCells::kXX][c] = x0 * x0 * count + 2.0 * x0 * xi + sx * sx * fold_by_ii(n + u);
    sums[DepthCells::kXY][c] = x0 * y0 * count + x0 * yj + y0 * xi + sx * sy * fold_by_i(nj + u);
    sums[DepthCells::kYY][c] = y0 * y0 * count + 2.0 * y0 * yj + sy * sy * fold(njj + u);
    sums[DepthCells::kQ][c] = depth;
    sums[DepthCells::kQX][c] = x0 * depth + sx * fold_by_i(q + u);
    sums[DepthCells::kQY][c] = y0 * depth + sy * fold(qj + u);
    sums[DepthCells::kQQ][c] = fold(qq + u);
  }
}

GEOMAP_MULTIVERSION void fold_depth_columns(const double* __restrict z, const double* __restrict zj,
                                            const double* __restrict zz,
                                            const double* __restrict zzj,
                                            const double* __restrict zzjj, int columns,
                                            double x_first, double y0, double sx, double sy,
                                            double* __restrict cells) {
  double* __restrict sums[DepthCells::kSums];
  for (int k = DepthCells::kZ; k < DepthCells::kSums; ++k) {
    sums[k] = cells + static_cast<std::ptrdiff_t>(k) * columns;
  }
  for (int c = 0; c < columns; ++c) {
    const int u = c * kSide;
    const double x0 = x_first + c * (kSide * sx);
    const double first = fold(z + u), second = fold(zz + u);
    const double xi = sx * fold_by_i(zz + u), yj = sy * fold(zzj + u);
    sums[DepthCells::kZ][c] = first;
    sums[DepthCells::kZX][c] = x0 * first + sx * fold_by_i(z + u);
    sums[DepthCells::kZY][c] = y0 * first + sy * fold(zj + u);
    sums[DepthCells::kZZ][c] = second;
    sums[DepthCells::kZZX][c] = x0 * second + xi;
    sums[DepthCells::kZZY][c] = y0 * second + yj;
    sums[DepthCells::kZZXX][c] = x0 * x0 * second + 2.0 * x0 * xi + sx * sx * fold_by_ii(zz + u);
    sums[DepthCells::kZZXY][c] =
        x0 * y0 * second + x0 * yj + y0 * xi + sx * sy * fold_by_i(zzj + u);
    sums[DepthCells::kZZYY][c] = y0 * y0 * second + 2.0 * y0 * yj + sy * sy * fold(zzjj + u);
  }
}

// Readings from `near` to `far` [m], in millimetres; never those that mean none.
std::pair<std::uint16_t, std::uint16_t> readings_between(double near, double far) {
  return {static_cast<std::uint16_t>(std::clamp(std::ceil(near * 1000.0), 1.0, 65534.0)),
          static_cast<std::uint16_t>(std::clamp(std::floor(far * 1000.0), 0.0, 65534.0))};
}

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
    : columns_((depth.width + kSide - 1) / kSide),
      rows_((depth.height + kSide - 1) / kSide),
      sums_(std::make_unique_for_overwrite<double[]>(
          static_cast<std::size_t>(columns_ * rows_ * kSums))) {
  const auto [nearest, farthest] = readings_between(near, far);
  const int width = columns_ * kSide;
  ColumnSums columns(width);
  std::vector<std::uint16_t> padded;  // rows that are not whole
  for (int r = 0; r < rows_; ++r) {
    const std::uint16_t* pixels =
        depth.millimetres.data() + static_cast<std::ptrdiff_t>(r * kSide) * depth.width;
    int stride = depth.width;
    const int height = std::min(kSide, depth.height - r * kSide);
    if (depth.width < width || height < kSide) {
      padded.assign(static_cast<std::size_t>(width * kSide), geometry::DepthImage::kNoReading);
      for (int j = 0; j < height; ++j) {
        std::copy_n(pixels + static_cast<std::ptrdiff_t>(j) * stride, depth.width,
                    padded.begin() + static_cast<std::ptrdiff_t>(j) * width);
      }
      pixels = padded.data();
      stride = width;
    }
    sum_columns(pixels, stride, width, nearest, farthest, columns.n, columns.nj, columns.njj,
                columns.q, columns.qj, columns.qq);
    sum_depth_columns(pixels, stride, width, nearest, farthest, columns.z, columns.zj, columns.zz,
                      columns.zzj, columns.zzjj);
    double* cells = sums_.get() + static_cast<std::ptrdiff_t>(r * kSums) * columns_;
    const double x_first = -camera.cx / camera.fx, y_first = (r * kSide - camera.cy) / camera.fy;
    fold_columns(columns.n, columns.nj, columns.njj, columns.q, columns.qj, columns.qq, columns_,
                 x_first, y_first, 1.0 / camera.fx, 1.0 / camera.fy, cells);
    fold_depth_columns(columns.z, columns.zj, columns.zz, columns.zzj, columns.zzjj, columns_,
                       x_first, y_first, 1.0 / camera.fx, 1.0 / camera.fy, cells);
  }
}

InverseDepthSums DepthCells::cell(int column, int r) const {
  const double* s = row(r, kCount) + column;
  const std::ptrdiff_t n = columns_;
  return {s[0],     s[n],     s[2 * n], s[3 * n], s[4 * n],
          s[5 * n], s[6 * n], s[7 * n], s[8 * n], s[9 * n]};
}

InverseDepthSums DepthCells::window(int c0, int r0, int c1, int r1) const {
  InverseDepthSums sum;
  for (int r = std::max(0, r0); r < std::min(r1, rows_); ++r) {
    for (int c = std::max(0, c0); c < std::min(c1, columns_); ++c) sum += cell(c, r);
  }
  return sum;
}

}  // namespace geomap::perception
