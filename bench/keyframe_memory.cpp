// SPDX-License-Identifier: BSD-3-Clause
// Heap allocations of a key frame by stage, and the peak of the process's memory.
#include <sys/resource.h>

#include <array>
#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

#include "allocation_count.hpp"
#include "mapping/geometric_map.hpp"
#include "perception/organized_extractor.hpp"
#include "perception/tracker.hpp"
#include "posed_frames.hpp"
#include "statistics.hpp"

namespace {

using namespace geomap;
using bench::Allocations;

constexpr std::size_t kWarmUp = 10;  // key frames
constexpr std::array kStages = {"tracking", "extraction, outlines", "merging"};
using Stages = std::array<Allocations, kStages.size()>;

template <typename Work>
Allocations allocations_of(Work&& work) {
  const Allocations before = bench::allocations();
  work();
  return bench::allocations() - before;
}

// Tracking, planes and merging as the pipeline does them, with the recorded poses as odometry.
class Mapping {
 public:
  void add(const bench::PosedFrame& posed) {
    const geometry::RgbdFrame& frame = posed.frame;
    tracker_.prior().add_pose(frame.utime, posed.T_world_camera);
    tracker_.prior().add_camera_to_body(frame.utime, Eigen::Isometry3d::Identity());
    Stages stages;
    perception::Tracked tracked;
    stages[0] =
        allocations_of([&] { tracked = tracker_.track(frame.utime, [&] { return &frame; }); });
    if (tracked.status != perception::TrackStatus::kKeyframe) return;
    auto seen = std::make_shared<mapping::Observation>();
    seen->keyframe = frame.utime;
    seen->T_world_camera = *tracked.T_world_camera;
    const auto seed = static_cast<std::uint64_t>(frame.utime);
    stages[1] = allocations_of([&] { seen->planes = extractor_.extract(frame, seed, {}).planes; });
    stages[2] = allocations_of([&] { map_.apply(std::move(seen)); });
    keyframes_.push_back(stages);
  }

  const std::vector<Stages>& keyframes() const { return keyframes_; }

 private:
  perception::Tracker tracker_;
  perception::OrganizedExtractor extractor_;
  mapping::GeometricMap map_{mapping::MergeConfig{}, mapping::HistoryConfig{}};
  std::vector<Stages> keyframes_;
};

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
  Mapping mapping;
  {
    const std::vector<bench::PosedFrame> frames = bench::load_posed_kitchen(1);
    if (frames.empty()) {
      std::printf("skipped: no recording 'redkitchen' under GEOMAP_DATA\n");
      return 0;
    }
    for (const bench::PosedFrame& posed : frames) mapping.add(posed);
  }
  print(mapping.keyframes());
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("\npeak memory %.0f MB, the decoded recording of 307 MB included\n",
              1e-3 * static_cast<double>(usage.ru_maxrss));
  return 0;
}
