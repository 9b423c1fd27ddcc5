// SPDX-License-Identifier: BSD-3-Clause
#include "perception/cell_means.hpp"

namespace geomap::perception {

std::vector<CellMean> cell_means(const DepthCells& cells, const DepthTolerance& tolerance) {
  std::vector<CellMean> means(static_cast<std::size_t>(cells.size()));
  CellMean* mean = means.data();
  for (int r = 0; r < cells.rows(); ++r) {
    const double* count = cells.row(r, DepthCells::kCount);
    const double* x = cells.row(r, DepthCells::kX);
    const double* y = cells.row(r, DepthCells::kY);
    const double* q = cells.row(r, DepthCells::kQ);
    for (int c = 0; c < cells.columns(); ++c, ++mean) {
      if (!(count[c] > 0.0)) continue;
      const double mean_q = q[c] / count[c];
      mean->x = static_cast<float>(x[c] / count[c]);
      mean->y = static_cast<float>(y[c] / count[c]);
      mean->q = static_cast<float>(mean_q);
      mean->allowed =
          static_cast<float>(kMeanShare * tolerance.along_ray(1.0 / mean_q) * mean_q * mean_q);
    }
  }
  return means;
}

}  // namespace geomap::perception
