// SPDX-License-Identifier: BSD-3-Clause
// Plane extraction with outlines per key frame, beside the plain PCL recipe on the same frames.
#include <benchmark/benchmark.h>

#include <vector>

#include "kitchen_frames.hpp"
#include "pcl_recipe.hpp"
#include "perception/organized_extractor.hpp"
#include "perception/ransac_extractor.hpp"
#include "statistics.hpp"

namespace {

using geomap::bench::median;
using geomap::bench::milliseconds;
using geomap::bench::quantile;
using geomap::geometry::RgbdFrame;

constexpr int kFrameStep = 10;

const std::vector<RgbdFrame>& frames() {
  static const std::vector<RgbdFrame> loaded = geomap::bench::load_kitchen_frames(kFrameStep);
  return loaded;
}

template <typename Extractor>
double extract(const RgbdFrame& frame) {
  static const Extractor extractor;
  return milliseconds([&frame] {
    benchmark::DoNotOptimize(
        extractor.extract(frame, static_cast<std::uint64_t>(frame.utime), {}).planes.size());
  });
}

double extract_by_pcl(const RgbdFrame& frame) {
  return milliseconds(
      [&frame] { benchmark::DoNotOptimize(geomap::bench::pcl_recipe(frame).planes); });
}

// All take turns on every frame, so that whatever else the machine does hits them alike. One
// iteration goes over all frames once.
void extraction_beside_pcl(benchmark::State& state) {
  if (frames().empty()) {
    state.SkipWithError("skipped: no recording 'redkitchen' under GEOMAP_DATA");
    return;
  }
  std::vector<double> organized, ransac, pcl;
  for (auto _ : state) {
    for (const RgbdFrame& frame : frames()) {
      organized.push_back(extract<geomap::perception::OrganizedExtractor>(frame));
      ransac.push_back(extract<geomap::perception::RansacExtractor>(frame));
      pcl.push_back(extract_by_pcl(frame));
    }
  }
  state.counters["frames"] = static_cast<double>(frames().size());
  state.counters["organized_ms"] = median(organized);
  state.counters["organized_p95_ms"] = quantile(organized, 0.95);
  state.counters["ransac_ms"] = median(ransac);
  state.counters["ransac_p95_ms"] = quantile(ransac, 0.95);
  state.counters["pcl_ms"] = median(pcl);
  state.counters["pcl_p95_ms"] = quantile(pcl, 0.95);
  state.counters["pcl_over_organized"] = median(pcl) / median(organized);
  state.counters["pcl_over_ransac"] = median(pcl) / median(ransac);
}
BENCHMARK(extraction_beside_pcl)->Unit(benchmark::kMillisecond)->Iterations(3);

}  // namespace

BENCHMARK_MAIN();
