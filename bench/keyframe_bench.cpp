// SPDX-License-Identifier: BSD-3-Clause
// Processor time of a key frame, of its stages and of what does the same elsewhere, on the same
// frames of the recorded kitchen.
#include <benchmark/benchmark.h>

#include <array>
#include <cstdio>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "bench_inputs.hpp"
#include "geometry/polygon_clip.hpp"
#include "mapping/geometric_map.hpp"
#include "messaging/convert_frame.hpp"
#include "pcl_omps.hpp"
#include "pcl_recipe.hpp"
#include "perception/alpha_hull.hpp"
#include "perception/organized_extractor.hpp"
#include "perception/ransac_extractor.hpp"
#include "plane_hulls.hpp"
#include "polygon_unions.hpp"
#include "staged_mapping.hpp"
#include "statistics.hpp"

namespace {

using namespace geomap;
using bench::BenchInputs;

constexpr double kAlpha = 0.05;  // of concave hulls of thinned points [m]

/// Processor time, and how many things were found in it.
struct Sample {
  double milliseconds = 0.0;
  double found = 0.0;
};

template <typename Work>
Sample timed(Work&& work) {
  Sample sample;
  sample.milliseconds = bench::milliseconds([&] { sample.found = static_cast<double>(work()); });
  return sample;
}

/// One iteration is one input: `sample_of` is asked for 0 to count - 1, in this order.
void add(const char* name, std::size_t count, std::function<Sample(std::size_t)> sample_of) {
  const auto run = [sample_of = std::move(sample_of)](benchmark::State& state) {
    std::vector<double> milliseconds;
    double found = 0.0;
    for (auto _ : state) {
      const Sample sample = sample_of(milliseconds.size());
      state.SetIterationTime(1e-3 * sample.milliseconds);
      milliseconds.push_back(sample.milliseconds);
      found += sample.found;
    }
    state.counters["median_ms"] = bench::median(milliseconds);
    state.counters["p95_ms"] = bench::quantile(milliseconds, 0.95);
    state.counters["found"] = found / static_cast<double>(milliseconds.size());
  };
  benchmark::RegisterBenchmark(name, run)
      ->Iterations(static_cast<benchmark::IterationCount>(count))
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

void add_extraction(const BenchInputs& inputs) {
  const auto add_extractor = [&](const char* name, auto&& planes_of) {
    add(name, inputs.frames.size(), [&inputs, planes_of](std::size_t i) {
      return timed([&] { return planes_of(inputs.frames[i].frame); });
    });
  };
  const auto planes_of = [](const auto& extractor, const geometry::RgbdFrame& frame) {
    return extractor.extract(frame, static_cast<std::uint64_t>(frame.utime), {}).planes.size();
  };
  add_extractor("extraction/organized",
                std::bind_front(planes_of, perception::OrganizedExtractor()));
  add_extractor("extraction/ransac", std::bind_front(planes_of, perception::RansacExtractor()));
  add_extractor("extraction/pcl_recipe_4cm",
                [](const geometry::RgbdFrame& frame) { return bench::pcl_recipe(frame).planes; });
  add_extractor("extraction/pcl_recipe_2cm", [](const geometry::RgbdFrame& frame) {
    return bench::pcl_recipe(frame, bench::kFinePclRecipe).planes;
  });
  add_extractor("extraction/pcl_omps", bench::pcl_organized_planes);
}

std::size_t alpha_hull(const std::vector<Eigen::Vector2d>& points, double alpha) {
  const std::vector<double> radius(points.size(), alpha);
  std::size_t vertices = 0;
  for (const auto& ring : perception::alpha_hull(points, radius)) vertices += ring.size();
  return vertices;
}

void add_outlines(const BenchInputs& inputs) {
  // Traced from all pixels; only the extractor knows how long it took, by the clock.
  add("outlines/traced", inputs.frames.size(), [&inputs](std::size_t i) {
    const auto planes = perception::OrganizedExtractor().extract(inputs.frames[i].frame, 0, {});
    Sample sample{1e3 * planes.hull_seconds};
    for (const auto& plane : planes.planes) {
      sample.found += static_cast<double>(geometry::vertex_count(plane.surface.polygon));
    }
    return sample;
  });
  const auto add_hull = [&](const char* name, auto&& vertices_of) {
    add(name, inputs.frames.size(), [&inputs, vertices_of](std::size_t i) {
      return timed([&] {
        std::size_t vertices = 0;
        for (const auto& points : inputs.plane_points[i]) vertices += vertices_of(points, kAlpha);
        return vertices;
      });
    });
  };
  add_hull("outlines/alpha_hull", alpha_hull);
  add_hull("outlines/pcl_concave_hull", bench::pcl_concave_hull);
  add_hull("outlines/cgal_alpha_shape_2", bench::cgal_alpha_shape);
}

void add_unions(const BenchInputs& inputs) {
  add("unions/geomap", inputs.overlaps.size(), [&inputs](std::size_t i) {
    const bench::Overlap& pair = inputs.overlaps[i];
    return timed([&] { return geometry::unite(pair.a, pair.b).parts.size(); });
  });
  const auto add_peer = [&](const char* name, auto&& converted) {
    add(name, inputs.overlaps.size(), [&inputs, converted](std::size_t i) {
      return timed(converted(inputs.overlaps[i].a, inputs.overlaps[i].b));
    });
  };
  add_peer("unions/cgal", bench::cgal_union);
  add_peer("unions/boost", bench::boost_union);
}

void add_merging(const BenchInputs& inputs) {
  const auto add_mode = [&](const char* name, const char* mode) {
    mapping::MergeConfig config;
    config.mode = mode;
    std::shared_ptr<mapping::GeometricMap> map;
    add(name, inputs.observations.size(), [&inputs, config, map](std::size_t i) mutable {
      if (i == 0) map = std::make_shared<mapping::GeometricMap>(config, mapping::HistoryConfig{});
      return timed([&] {
        map->apply(inputs.observations[i]);
        return map->features().size();
      });
    });
  };
  add_mode("merging/moments", "moments");
  add_mode("merging/paper", "paper");
}

/// Decoding, then a key frame's stages.
using Steps = std::array<double, 1 + bench::kStages.size()>;  // [ms]

/// From a log's message to the map; `steps` of it count.
void add_keyframe(const char* name, const BenchInputs& inputs, std::vector<std::size_t> steps) {
  std::shared_ptr<bench::StagedMapping> mapping;
  add(name, inputs.messages.size(), [&inputs, steps, mapping](std::size_t i) mutable {
    if (i == 0) mapping = std::make_shared<bench::StagedMapping>();
    Steps times{};
    messaging::FrameResult decoded;
    times[0] = bench::milliseconds([&] { decoded = messaging::to_frame(inputs.messages[i]); });
    mapping->add(*decoded.frame, inputs.frames[i].T_world_camera,
                 [&times](std::size_t stage, const auto& work) {
                   times[1 + stage] = bench::milliseconds(work);
                 });
    Sample sample;
    for (const std::size_t step : steps) sample.milliseconds += times[step];
    return sample;
  });
}

void add_keyframes(const BenchInputs& inputs) {
  add_keyframe("keyframe/decoding", inputs, {0});
  add_keyframe("keyframe/tracking", inputs, {1});
  add_keyframe("keyframe/extraction", inputs, {2});
  add_keyframe("keyframe/merging", inputs, {3});
  add_keyframe("keyframe/decoded", inputs, {1, 2, 3});
  add_keyframe("keyframe/all", inputs, {0, 1, 2, 3});
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  const BenchInputs inputs = bench::load_bench_inputs();
  if (inputs.frames.empty()) {
    std::fprintf(stderr, "keyframe_bench: no recording 'redkitchen' under GEOMAP_DATA\n");
    return 1;
  }
  add_keyframes(inputs);
  add_extraction(inputs);
  add_outlines(inputs);
  add_unions(inputs);
  add_merging(inputs);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
