// SPDX-License-Identifier: BSD-3-Clause
#include "perception/cell_normals.hpp"

#include <algorithm>
#include <array>
#include <cmath>

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

class NormalFinder {
 public:
  NormalFinder(const DepthCells& cells, double focal_length, const DepthTolerance& tolerance)
      : cells_(cells), focal_length_(focal_length), tolerance_(tolerance) {}

  CellNormal at(int column, int row) const {
    const InverseDepthSums& own = cells_.cell(cells_.index(column, row));
    if (own.count < kLeastFill * kCellPixels) return {};
    const double z = own.mean_depth();
    const double sigma = tolerance_.noise.sigma(z);
    const double sigma_q = sigma / (z * z);
    const auto own_fit = fit_plane(own);
    if (!own_fit || own_fit->rms > kStepGate * sigma_q) return {};

    const int radius = window_radius(z, sigma, focal_length_);
    const auto centred = try_window(column, row, radius, own, sigma_q);
    if (centred) return {CellNormal::Kind::kPlanar, centred->normal()};
    std::optional<InverseDepthFit> best;
    for (const auto& [dc, dr] : kShifts) {
      const auto fit = try_window(column + dc * radius, row + dr * radius, radius, own, sigma_q);
      if (fit && (!best || fit->rms < best->rms)) best = fit;
    }
    if (!best) return {CellNormal::Kind::kRough, Eigen::Vector3d::Zero()};
    return {CellNormal::Kind::kPlanar, best->normal()};
  }

 private:
  static constexpr std::array<std::array<int, 2>, 8> kShifts = {
      {{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};

  std::optional<InverseDepthFit> try_window(int column, int row, int radius,
                                            const InverseDepthSums& own, double sigma_q) const {
    const int side = 2 * radius + 1;
    const InverseDepthSums sums =
        cells_.window(column - radius, row - radius, column + radius + 1, row + radius + 1);
    if (sums.count < kLeastFill * kCellPixels * side * side) return std::nullopt;
    auto fit = fit_plane(sums);
    if (!fit) return std::nullopt;
    // Unevenness along the normal, in inverse depth: dq = q² dz, dz = e / |n·ray|, |n·ray| = q /
    // |(A, B, C)|.
    const double q = own.q / own.count;
    const double uneven = kUnevenRms * tolerance_.unevenness * q * fit->coefficients.norm();
    if (fit->rms > kFlatGate * sigma_q + uneven) return std::nullopt;
    const double off = q - fit->at(own.x / own.count, own.y / own.count);
    if (std::abs(off) > kMeanGate * sigma_q + uneven) return std::nullopt;
    return fit;
  }

  const DepthCells& cells_;
  double focal_length_;
  const DepthTolerance& tolerance_;
};

}  // namespace

std::vector<CellNormal> estimate_normals(const DepthCells& cells,
                                         const geometry::CameraModel& camera,
                                         const DepthTolerance& tolerance) {
  const NormalFinder finder(cells, std::min(camera.fx, camera.fy), tolerance);
  std::vector<CellNormal> normals;
  normals.reserve(static_cast<std::size_t>(cells.size()));
  for (int row = 0; row < cells.rows(); ++row) {
    for (int column = 0; column < cells.columns(); ++column) {
      normals.push_back(finder.at(column, row));
    }
  }
  return normals;
}

}  // namespace geomap::perception
