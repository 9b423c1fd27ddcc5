// SPDX-License-Identifier: BSD-3-Clause
#include "perception/grow_regions.hpp"

#include <algorithm>
#include <cmath>

#include "perception/cell_means.hpp"
#include "perception/plane_extractor.hpp"
#include "perception/surface_region.hpp"

namespace geomap::perception {
namespace {

constexpr std::size_t kLeastCells = 6;
constexpr int kSeedReach = 3;          // of the normals that agree around a seed [cell]
constexpr double kSeedCosine = 0.985;  // 10°
constexpr double kRefitGrowth = 1.5;   // a region is fitted again when it has so much more

class Grower {
 public:
  Grower(const DepthCells& cells, const std::vector<CellNormal>& normals,
         const std::vector<CellMean>& means, const DepthTolerance& tolerance,
         double max_normal_angle)
      : cells_(cells),
        normals_(normals),
        means_(means),
        tolerance_(tolerance),
        cosine_(std::cos(max_normal_angle)),
        label_(static_cast<std::size_t>(cells.size()), kNoPlane) {}

  void grow_all() {
    for (const bool any : {false, true}) {
      for (int row = 0; row < cells_.rows(); ++row) {
        for (int column = 0; column < cells_.columns(); ++column) {
          if (is_free(cells_.index(column, row)) && (any || is_seed(column, row))) {
            grow(cells_.index(column, row));
          }
        }
      }
    }
  }

  std::vector<SurfaceRegion>& regions() { return regions_; }
  std::vector<std::int16_t>& label() { return label_; }

 private:
  static constexpr std::int16_t kTried = -2;

  bool is_free(int cell) const {
    const auto i = static_cast<std::size_t>(cell);
    return label_[i] == kNoPlane && normals_[i].kind == CellNormal::Kind::kPlanar;
  }

  // All around has much the same normal.
  bool is_seed(int column, int row) const {
    if (column < kSeedReach || row < kSeedReach || column + kSeedReach >= cells_.columns() ||
        row + kSeedReach >= cells_.rows()) {
      return false;
    }
    const Eigen::Vector3d& own =
        normals_[static_cast<std::size_t>(cells_.index(column, row))].normal;
    for (const int dr : {-kSeedReach, 0, kSeedReach}) {
      for (const int dc : {-kSeedReach, 0, kSeedReach}) {
        const int other = cells_.index(column + dc, row + dr);
        if (!is_free(other)) return false;
        if (normals_[static_cast<std::size_t>(other)].normal.dot(own) < kSeedCosine) return false;
      }
    }
    return true;
  }

  void grow(int seed) {
    if (regions_.size() == kMostPlanes) return;
    const auto number = static_cast<std::int16_t>(regions_.size());
    SurfaceRegion region;
    const CellMean& at = means_[static_cast<std::size_t>(seed)];
    const Eigen::Vector3d& normal = normals_[static_cast<std::size_t>(seed)].normal;
    const double along = normal.dot(Eigen::Vector3d(at.x, at.y, 1.0));
    region.plane = InversePlane::of(at.q / along * normal);
    take(seed, number, region);
    double next_fit = 8.0 * kPixels;
    for (std::size_t done = 0; done < region.cells.size(); ++done) {
      const int cell = region.cells[done];
      const int column = cell % cells_.columns();
      if (column > 0) try_cell(cell - 1, number, region);
      if (column + 1 < cells_.columns()) try_cell(cell + 1, number, region);
      if (cell >= cells_.columns()) try_cell(cell - cells_.columns(), number, region);
      if (cell + cells_.columns() < cells_.size()) {
        try_cell(cell + cells_.columns(), number, region);
      }
      if (region.sums.count < next_fit) continue;
      next_fit = kRefitGrowth * region.sums.count;
      if (const auto fit = fit_plane(region.sums))
        region.plane = InversePlane::of(fit->coefficients);
    }
    region.fit();
    if (region.cells.size() < kLeastCells || !region.plane) {
      for (const int cell : region.cells) label_[static_cast<std::size_t>(cell)] = kTried;
      return;
    }
    regions_.push_back(std::move(region));
  }

  void try_cell(int cell, std::int16_t number, SurfaceRegion& region) {
    if (!is_free(cell)) return;
    const auto i = static_cast<std::size_t>(cell);
    if (!region.plane->is_near(means_[i], tolerance_) ||
        !normals_[i].allows(region.plane->normal(), cosine_)) {
      return;
    }
    take(cell, number, region);
  }

  void take(int cell, std::int16_t number, SurfaceRegion& region) {
    label_[static_cast<std::size_t>(cell)] = number;
    region.cells.push_back(cell);
    region.sums += cells_.cell(cell);
  }

  static constexpr double kPixels = DepthCells::kSide * DepthCells::kSide;

  const DepthCells& cells_;
  const std::vector<CellNormal>& normals_;
  const std::vector<CellMean>& means_;
  const DepthTolerance& tolerance_;
  double cosine_;
  std::vector<std::int16_t> label_;
  std::vector<SurfaceRegion> regions_;
};

}  // namespace

CellRegions grow_regions(const DepthCells& cells, const std::vector<CellNormal>& normals,
                         const DepthTolerance& tolerance, double max_normal_angle,
                         double max_merge_angle) {
  const std::vector<CellMean> means = cell_means(cells, tolerance);
  Grower grower(cells, normals, means, tolerance, max_normal_angle);
  grower.grow_all();
  return merge_regions(cells, normals, means, tolerance, max_normal_angle, max_merge_angle,
                       std::move(grower.regions()), std::move(grower.label()));
}

}  // namespace geomap::perception
