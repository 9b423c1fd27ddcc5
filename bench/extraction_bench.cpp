// SPDX-License-Identifier: BSD-3-Clause
// Plane extraction with outlines per key frame, beside the plain PCL recipe on the same frames.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "kitchen_frames.hpp"
#include "pcl_recipe.hpp"
#include "perception/ransac_extractor.hpp"

namespace {

using geomap::geometry::RgbdFrame;

constexpr int kFrameStep = 10;

const std::vector<RgbdFrame>& frames() {
  static const std::vector<RgbdFrame> loaded = geomap::bench::load_kitchen_frames(kFrameStep);
  return loaded;
}

std::size_t extract(const RgbdFrame& frame) {
  static const geomap::perception::RansacExtractor extractor;
  return extractor.extract(frame, static_cast<std::uint64_t>(frame.utime), {}).planes.size();
}

std::size_t extract_by_pcl(const RgbdFrame& frame) {
  return geomap::bench::pcl_recipe(frame).planes;
}

double milliseconds(std::size_t (*run)(const RgbdFrame&), const RgbdFrame& frame) {
  const auto start = std::chrono::steady_clock::now();
  benchmark::DoNotOptimize(run(frame));
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

double quantile(std::vector<double> values, double share) {
  const auto at = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

// Both take turns on every frame, so that whatever else the machine does hits them alike. One
// iteration goes over all frames once.
void extraction_beside_pcl(benchmark::State& state) {
  if (frames().empty()) {
    state.SkipWithError("skipped: no recording 'redkitchen' under GEOMAP_DATA");
    return;
  }
  std::vector<double> ours, pcl;
  for (auto _ : state) {
    for (const RgbdFrame& frame : frames()) {
      ours.push_back(milliseconds(extract, frame));
      pcl.push_back(milliseconds(extract_by_pcl, frame));
    }
  }
  state.counters["frames"] = static_cast<double>(frames().size());
  state.counters["ours_median_ms"] = quantile(ours, 0.5);
  state.counters["ours_p95_ms"] = quantile(ours, 0.95);
  state.counters["pcl_median_ms"] = quantile(pcl, 0.5);
  state.counters["pcl_p95_ms"] = quantile(pcl, 0.95);
  state.counters["pcl_over_ours"] = quantile(pcl, 0.5) / quantile(ours, 0.5);
}
BENCHMARK(extraction_beside_pcl)->Unit(benchmark::kMillisecond)->Iterations(3);

}  // namespace

BENCHMARK_MAIN();
