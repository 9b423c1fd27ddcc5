// SPDX-License-Identifier: BSD-3-Clause
#include "perception/noise_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace geomap::perception {
namespace {

constexpr int kBlockCells = 4;        // 16 x 16 pixels
constexpr double kLeastPixels = 200;  // of the 256 of a block
constexpr int kLeastBlocks = 8;       // below that a quantile means nothing
constexpr double kBinDepth = 0.5;     // [m]
// No camera comes below this factor: what is left of a rendering is its rounding.
constexpr double kRenderedFactor = 0.1;
constexpr double kQuantile = 0.25;  // of the blocks' residuals that is taken as noise
// That quantile of a residual's rms with 253 degrees of freedom, over its true value.
constexpr double kQuantileOfRms = 0.970;

struct BlockNoise {
  double depth = 0.0;  // [m]
  double sigma = 0.0;  // residual along the ray, rounding to the depth unit taken off [m]
};

// Standard deviation of the block's depth about its mean [m].
double relief(const InverseDepthSums& sums) {
  const double mean = sums.q / sums.count;
  return std::sqrt(std::max(0.0, sums.qq / sums.count - mean * mean)) / (mean * mean);
}

// Blocks of equal readings lie within one step of a coarse sensor, or face a noise-free one: they
// tell nothing, and are left out where there are others.
std::vector<BlockNoise> measure_blocks(const DepthCells& cells, double quantisation) {
  std::vector<BlockNoise> blocks, level;
  for (int r = 0; r + kBlockCells <= cells.rows(); r += kBlockCells) {
    for (int c = 0; c + kBlockCells <= cells.columns(); c += kBlockCells) {
      const InverseDepthSums sums = cells.window(c, r, c + kBlockCells, r + kBlockCells);
      if (sums.count < kLeastPixels) continue;
      const auto fit = fit_plane(sums);
      if (!fit) continue;
      const double z = sums.mean_depth();
      const double residual = fit->rms * z * z;  // dz = z² dq
      const double rounding = quantisation * quantisation / 12.0;
      auto& kind = relief(sums) > quantisation ? blocks : level;
      kind.push_back({z, std::sqrt(std::max(0.0, residual * residual - rounding))});
    }
  }
  if (blocks.size() < static_cast<std::size_t>(kLeastBlocks)) {
    blocks.insert(blocks.end(), level.begin(), level.end());
  }
  return blocks;
}

double low_quantile(std::vector<double> values) {
  const auto rank = static_cast<std::ptrdiff_t>(kQuantile * static_cast<double>(values.size()));
  const auto at = values.begin() + rank;
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

template <typename Measure>
double low_quantile_of(const std::vector<BlockNoise>& blocks, const Measure& measure) {
  std::vector<double> values;
  values.reserve(blocks.size());
  for (const BlockNoise& block : blocks) values.push_back(measure(block));
  return low_quantile(std::move(values)) / kQuantileOfRms;
}

// How unevenly a measure is spread over depth: standard deviation of its logarithm between depth
// bins. Flat means that the measure describes the noise's dependence on depth.
template <typename Measure>
double spread_over_depth(const std::vector<BlockNoise>& blocks, const Measure& measure) {
  std::map<int, std::vector<BlockNoise>> bins;
  for (const BlockNoise& block : blocks) {
    bins[static_cast<int>(block.depth / kBinDepth)].push_back(block);
  }
  double n = 0.0, sum = 0.0, squares = 0.0;
  for (const auto& [bin, members] : bins) {
    if (members.size() < static_cast<std::size_t>(kLeastBlocks)) continue;
    const double weight = static_cast<double>(members.size());
    const double value = std::log(std::max(1e-6, low_quantile_of(members, measure)));
    n += weight;
    sum += weight * value;
    squares += weight * value * value;
  }
  if (n == 0.0) return 0.0;
  const double mean = sum / n;
  return std::sqrt(std::max(0.0, squares / n - mean * mean));
}

}  // namespace

geometry::DepthNoise estimate_noise(const DepthCells& cells, const geometry::DepthNoise& model) {
  const std::vector<BlockNoise> blocks = measure_blocks(cells, model.quantisation);
  if (blocks.size() < static_cast<std::size_t>(kLeastBlocks)) return model;

  geometry::DepthNoise unit = model;
  unit.factor = 1.0;
  unit.quantisation = 0.0;
  const auto over_model = [&](const BlockNoise& b) { return b.sigma / unit.sigma(b.depth); };
  const auto over_base = [&](const BlockNoise& b) { return b.sigma / unit.base; };

  geometry::DepthNoise estimate = model;
  const double of_model = low_quantile_of(blocks, over_model);
  const double of_base = low_quantile_of(blocks, over_base);
  if (of_model < kRenderedFactor) {
    estimate.factor = kLeastNoiseFactor;
    return estimate;
  }
  // White noise: the same at all depths. Half the model's spread, since either measure scatters.
  const double model_spread = spread_over_depth(blocks, over_model);
  const bool is_white =
      model_spread > 0.2 && spread_over_depth(blocks, over_base) < 0.5 * model_spread;
  if (is_white) estimate.slope = 0.0;
  estimate.factor = std::min(is_white ? of_base : of_model, kLargestNoiseFactor);
  return estimate;
}

}  // namespace geomap::perception
