// SPDX-License-Identifier: BSD-3-Clause
// Heap allocations of a key frame by stage, and the peak of the process's memory.
#include <sys/resource.h>

#include <array>
#include <cstdio>
#include <vector>

#include "allocation_count.hpp"
#include "posed_frames.hpp"
#include "staged_mapping.hpp"
#include "statistics.hpp"

namespace {

using namespace geomap;
using bench::Allocations;
using bench::kStages;

constexpr std::size_t kWarmUp = 10;  // key frames
using Stages = std::array<Allocations, kStages.size()>;

template <typename Work>
Allocations allocations_of(Work&& work) {
  const Allocations before = bench::allocations();
  work();
  return bench::allocations() - before;
}

// Of each key frame, with the recorded poses as odometry.
std::vector<Stages> map_frames(const std::vector<bench::PosedFrame>& frames) {
  bench::StagedMapping mapping;
  std::vector<Stages> keyframes;
  for (const bench::PosedFrame& posed : frames) {
    Stages stages;
    const auto meter = [&](std::size_t stage, const auto& work) {
      stages[stage] = allocations_of(work);
    };
    if (mapping.add(posed.frame, posed.T_world_camera, meter)) keyframes.push_back(stages);
  }
  return keyframes;
}

void print(const std::vector<Stages>& keyframes) {
  std::printf("%zu key frames, the first %zu of them left out; operator new, medians a key frame\n",
              keyframes.size(), kWarmUp);
  std::printf("\n| stage | allocations | kB |\n|---|--:|--:|\n");
  for (std::size_t stage = 0; stage < kStages.size(); ++stage) {
    std::vector<double> calls, bytes;
    for (std::size_t i = kWarmUp; i < keyframes.size(); ++i) {
      calls.push_back(static_cast<double>(keyframes[i][stage].calls));
      bytes.push_back(static_cast<double>(keyframes[i][stage].bytes));
    }
    std::printf("| %s | %.0f | %.0f |\n", kStages[stage], bench::median(calls),
                1e-3 * bench::median(bytes));
  }
}

}  // namespace

int main() {
  const std::vector<bench::PosedFrame> frames = bench::load_posed_kitchen(1);
  if (frames.empty()) {
    std::printf("skipped: no recording 'redkitchen' under GEOMAP_DATA\n");
    return 0;
  }
  print(map_frames(frames));
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("\npeak memory %.0f MB, the decoded recording of 307 MB included\n",
              1e-3 * static_cast<double>(usage.ru_maxrss));
  return 0;
}
