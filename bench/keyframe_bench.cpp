// SPDX-License-Identifier: BSD-3-Clause
// Processor time of a key frame, of its stages and of what does the same elsewhere, on the same
// frames of the recorded kitchen.
#include <benchmark/benchmark.h>

#include <array>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
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
#include "simulated_frames.hpp"
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

void report(benchmark::State& state, const std::string& step,
            const std::vector<double>& milliseconds) {
  state.counters[step + "median_ms"] = bench::median(milliseconds);
  state.counters[step + "p95_ms"] = bench::quantile(milliseconds, 0.95);
}

void add_run(const char* name, std::size_t count, std::function<void(benchmark::State&)> run) {
  benchmark::RegisterBenchmark(name, std::move(run))
      ->Iterations(static_cast<benchmark::IterationCount>(count))
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

/// One iteration is one input: `sample_of` is asked for 0 to count - 1, in this order.
void add(const char* name, std::size_t count, std::function<Sample(std::size_t)> sample_of) {
  add_run(name, count, [sample_of = std::move(sample_of)](benchmark::State& state) {
    std::vector<double> milliseconds;
    double found = 0.0;
    for (auto _ : state) {
      const Sample sample = sample_of(milliseconds.size());
      state.SetIterationTime(1e-3 * sample.milliseconds);
      milliseconds.push_back(sample.milliseconds);
      found += sample.found;
    }
    report(state, "", milliseconds);
    state.counters["found"] = found / static_cast<double>(milliseconds.size());
  });
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

/// From a log's messages to the map, one key frame an iteration.
void map_messages(const BenchInputs& inputs, benchmark::State& state) {
  bench::StagedMapping mapping;
  std::array<std::vector<double>, bench::kStages.size()> stages;
  std::vector<double> decoding, decoded, all;
  for (auto _ : state) {
    const std::size_t i = all.size();
    messaging::FrameResult frame;
    decoding.push_back(
        bench::milliseconds([&] { frame = messaging::to_frame(inputs.messages[i]); }));
    double rest = 0.0;
    mapping.add(*frame.frame, inputs.frames[i].T_world_camera,
                [&](std::size_t stage, const auto& work) {
                  stages[stage].push_back(bench::milliseconds(work));
                  rest += stages[stage].back();
                });
    decoded.push_back(rest);
    all.push_back(decoding.back() + rest);
    state.SetIterationTime(1e-3 * all.back());
  }
  report(state, "decoding_", decoding);
  report(state, "tracking_", stages[0]);
  report(state, "extraction_", stages[1]);
  report(state, "merging_", stages[2]);
  report(state, "decoded_", decoded);
  report(state, "all_", all);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const bool is_simulated = argc == 3 && argv[1][0] != '-' && argv[2][0] != '-';
  if (!is_simulated && benchmark::ReportUnrecognizedArguments(argc, argv)) {
    std::fprintf(stderr, "usage: keyframe_bench [SCENE.yaml TRAJECTORY.yaml] [--benchmark_...]\n");
    return 2;
  }
  const BenchInputs inputs = bench::load_bench_inputs([&](const bench::FrameVisitor& visitor) {
    if (is_simulated) {
      bench::visit_simulation(argv[1], argv[2], visitor);
    } else {
      bench::visit_kitchen(1, visitor);
    }
  });
  if (inputs.frames.empty()) {
    std::fprintf(stderr, "keyframe_bench: no recording 'redkitchen' under GEOMAP_DATA\n");
    return 1;
  }
  add_run("keyframe/all", inputs.messages.size(),
          [&inputs](benchmark::State& state) { map_messages(inputs, state); });
  add_extraction(inputs);
  add_outlines(inputs);
  add_unions(inputs);
  add_merging(inputs);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
