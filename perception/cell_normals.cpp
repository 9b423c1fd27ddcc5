// SPDX-License-Identifier: BSD-3-Clause
#include "perception/cell_normals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/multiversion.hpp"

namespace geomap::perception {
namespace {

constexpr double kCellPixels = DepthCells::kSide * DepthCells::kSide;
constexpr double kLeastFill = 0.5;     // of a cell or a window
constexpr double kNormalError = 0.05;  // wanted, standard deviation [rad]
// A depth camera's noise is alike in neighbouring pixels: counted as this much more of white noise.
constexpr double kCorrelation = 3.0;
constexpr int kLargestRadius = 5;   // of a window [cell]
constexpr double kFlatGate = 2.0;   // rms of a flat window, over sigma
constexpr double kUnevenRms = 0.5;  // of a window, over the unevenness of flat surfaces
constexpr double kMeanGate = 1.5;   // a cell's mean off its window's plane, over sigma
constexpr double kStepGate = 3.0;   // rms of a cell without a depth step, over sigma

// A window of w pixels at depth z is w·z/f wide: its normal is good to √12 σ f / (w² z).
int window_radius(double z, double sigma, double focal_length) {
  const double width =
      std::sqrt(std::sqrt(12.0) * kCorrelation * sigma * focal_length / (z * kNormalError));
  const int cells = static_cast<int>(std::ceil(std::min(width, 1e3) / DepthCells::kSide));
  return std::clamp(cells / 2, 1, kLargestRadius);
}

// Window radius by depth, in steps of a centimetre.
class RadiusTable {
 public:
  RadiusTable(double focal_length, const geometry::DepthNoise& noise) {
    for (std::size_t i = 0; i < radius_.size(); ++i) {
      const double z = (static_cast<double>(i) + 0.5) / kSteps;
      radius_[i] = static_cast<unsigned char>(window_radius(z, noise.sigma(z), focal_length));
    }
  }
  int at(double z) const {
    return radius_[std::min(static_cast<std::size_t>(z * kSteps), radius_.size() - 1)];
  }

 private:
  static constexpr double kSteps = 100.0;
  std::array<unsigned char, 700> radius_{};
};

// The planes of windows of one size around every cell; rms is infinite where there is none.
struct WindowFits {
  int columns = 0, rows = 0;
  std::vector<float> a, b, c, rms;

  bool contains(int column, int row) const {
    return column >= 0 && row >= 0 && column < columns && row < rows;
  }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row * columns + column);
  }
};

// value[c] += added[c] - removed[c]
GEOMAP_MULTIVERSION void slide(double* __restrict value, const double* __restrict added,
                               const double* __restrict removed, int count) {
  for (int i = 0; i < count; ++i) value[i] += added[i] - removed[i];
}

GEOMAP_MULTIVERSION void add_shifted(double* __restrict sum, const double* __restrict value,
                                     int shifts, int count) {
  for (int i = 0; i < count; ++i) sum[i] = value[i];
  for (int k = 1; k < shifts; ++k) {
    for (int i = 0; i < count; ++i) sum[i] += value[i + k];
  }
}

// fit_plane for a row of windows; `sums` are kSums lists.
GEOMAP_MULTIVERSION void fit_row(const double* __restrict sums, int columns, double least_count,
                                 float* __restrict plane_a, float* __restrict plane_b,
                                 float* __restrict plane_c, float* __restrict rms) {
  constexpr float kNone = std::numeric_limits<float>::infinity();
  const std::ptrdiff_t stride = columns;
  for (int i = 0; i < columns; ++i) {
    const double n = std::max(6.0, sums[i]);
    const double per_n = 1.0 / n;
    const double mx = sums[i + stride] * per_n, my = sums[i + 2 * stride] * per_n;
    const double mq = sums[i + 6 * stride] * per_n;
    const double cxx = sums[i + 3 * stride] - n * mx * mx;
    const double cxy = sums[i + 4 * stride] - n * mx * my;
    const double cyy = sums[i + 5 * stride] - n * my * my;
    const double cqx = sums[i + 7 * stride] - n * mq * mx;
    const double cqy = sums[i + 8 * stride] - n * mq * my;
    const double cqq = sums[i + 9 * stride] - n * mq * mq;
    const double determinant = cxx * cyy - cxy * cxy;
    const double per_determinant = 1.0 / std::max(determinant, 1e-30);
    const double a = (cqx * cyy - cqy * cxy) * per_determinant;
    const double b = (cqy * cxx - cqx * cxy) * per_determinant;
    const double residual = std::max(0.0, cqq - a * cqx - b * cqy);
    const bool is_plane = (sums[i] >= least_count) & (determinant > 1e-3 * cxx * cyy);
    plane_a[i] = static_cast<float>(a);
    plane_b[i] = static_cast<float>(b);
    plane_c[i] = static_cast<float>(mq - a * mx - b * my);
    const float root = std::sqrt(static_cast<float>(residual / (n - 3.0)));
    rms[i] = is_plane ? root : kNone;
  }
}

WindowFits fit_windows(const DepthCells& cells, int radius) {
  constexpr int kSums = DepthCells::kInverseSums;
  const int columns = cells.columns(), rows = cells.rows(), padded = columns + 2 * radius;
  const auto size = static_cast<std::size_t>(cells.size());
  WindowFits fits{columns,
                  rows,
                  std::vector<float>(size),
                  std::vector<float>(size),
                  std::vector<float>(size),
                  std::vector<float>(size)};
  std::vector<double> high(static_cast<std::size_t>(padded * kSums), 0.0);  // columns of windows
  std::vector<double> sums(static_cast<std::size_t>(columns * kSums));
  const std::vector<double> none(static_cast<std::size_t>(columns), 0.0);
  const int side = 2 * radius + 1;
  for (int r = -radius; r < rows; ++r) {
    const int below = r + radius, above = r - radius - 1;
    for (int k = 0; k < kSums; ++k) {
      const auto sum = static_cast<DepthCells::Sum>(k);
      slide(high.data() + static_cast<std::ptrdiff_t>(k) * padded + radius,
            below < rows ? cells.row(below, sum) : none.data(),
            above >= 0 ? cells.row(above, sum) : none.data(), columns);
    }
    if (r < 0) continue;
    for (int k = 0; k < kSums; ++k) {
      add_shifted(sums.data() + static_cast<std::ptrdiff_t>(k) * columns,
                  high.data() + static_cast<std::ptrdiff_t>(k) * padded, side, columns);
    }
    const std::size_t at = fits.index(0, r);
    fit_row(sums.data(), columns, kLeastFill * kCellPixels * side * side, &fits.a[at], &fits.b[at],
            &fits.c[at], &fits.rms[at]);
  }
  return fits;
}

class NormalFinder {
 public:
  NormalFinder(const DepthCells& cells, double focal_length, const DepthTolerance& tolerance)
      : cells_(cells), tolerance_(tolerance), radius_(focal_length, tolerance.noise) {}

  std::vector<CellNormal> all() const {
    const WindowFits own = fit_windows(cells_, 0);
    std::array<std::vector<Open>, kLargestRadius + 1> open;  // by radius
    for (int row = 0; row < cells_.rows(); ++row) collect(row, own, open);
    std::vector<CellNormal> normals(static_cast<std::size_t>(cells_.size()));
    for (int radius = 1; radius <= kLargestRadius; ++radius) {
      const std::vector<Open>& of_radius = open[static_cast<std::size_t>(radius)];
      if (of_radius.empty()) continue;
      const WindowFits fits = fit_windows(cells_, radius);
      for (const Open& cell : of_radius) {
        normals[own.index(cell.column, cell.row)] = choose(cell, fits, radius);
      }
    }
    return normals;
  }

 private:
  static constexpr std::array<std::array<int, 2>, 8> kShifts = {
      {{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};

  // A cell whose surroundings will tell its normal.
  struct Open {
    int column, row;
    float x, y, q, sigma;  // mean ray, mean inverse depth and its noise [1/m]
  };

  void collect(int row, const WindowFits& own,
               std::array<std::vector<Open>, kLargestRadius + 1>& open) const {
    const double* count = cells_.row(row, DepthCells::kCount);
    const double* x = cells_.row(row, DepthCells::kX);
    const double* y = cells_.row(row, DepthCells::kY);
    const double* q = cells_.row(row, DepthCells::kQ);
    for (int column = 0; column < cells_.columns(); ++column) {
      const float rms = own.rms[own.index(column, row)];
      if (!(rms < std::numeric_limits<float>::infinity())) continue;
      const double n = count[column], z = n / q[column];
      const double sigma = tolerance_.noise.sigma(z) / (z * z);
      if (rms > kStepGate * sigma) continue;
      open[static_cast<std::size_t>(radius_.at(z))].push_back(
          {column, row, static_cast<float>(x[column] / n), static_cast<float>(y[column] / n),
           static_cast<float>(1.0 / z), static_cast<float>(sigma)});
    }
  }

  CellNormal choose(const Open& cell, const WindowFits& fits, int radius) const {
    const std::size_t centre = fits.index(cell.column, cell.row);
    if (is_flat(cell, fits, centre)) return normal_of(fits, centre);
    float least = std::numeric_limits<float>::infinity();
    std::size_t best = 0;
    for (const auto& [dc, dr] : kShifts) {
      const int column = cell.column + dc * radius, row = cell.row + dr * radius;
      if (!fits.contains(column, row)) continue;
      const std::size_t at = fits.index(column, row);
      if (fits.rms[at] >= least || !is_flat(cell, fits, at)) continue;
      least = fits.rms[at];
      best = at;
    }
    if (!(least < std::numeric_limits<float>::infinity())) {
      return {CellNormal::Kind::kRough, Eigen::Vector3d::Zero()};
    }
    return normal_of(fits, best);
  }

  bool is_flat(const Open& cell, const WindowFits& fits, std::size_t at) const {
    const float a = fits.a[at], b = fits.b[at], c = fits.c[at];
    // Unevenness along the normal, in inverse depth: dq = q² dz, dz = e / |n·ray|, |n·ray| = q /
    // |(A, B, C)|.
    const float uneven = static_cast<float>(kUnevenRms * tolerance_.unevenness) * cell.q *
                         std::sqrt(a * a + b * b + c * c);
    if (fits.rms[at] > static_cast<float>(kFlatGate) * cell.sigma + uneven) return false;
    const float off = cell.q - (a * cell.x + b * cell.y + c);
    return std::abs(off) <= static_cast<float>(kMeanGate) * cell.sigma + uneven;
  }

  static CellNormal normal_of(const WindowFits& fits, std::size_t at) {
    const Eigen::Vector3d coefficients(fits.a[at], fits.b[at], fits.c[at]);
    return {CellNormal::Kind::kPlanar, -coefficients.normalized()};
  }

  const DepthCells& cells_;
  const DepthTolerance& tolerance_;
  RadiusTable radius_;
};

}  // namespace

std::vector<CellNormal> estimate_normals(const DepthCells& cells,
                                         const geometry::CameraModel& camera,
                                         const DepthTolerance& tolerance) {
  return NormalFinder(cells, std::min(camera.fx, camera.fy), tolerance).all();
}

}  // namespace geomap::perception
