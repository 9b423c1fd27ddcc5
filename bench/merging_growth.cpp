// SPDX-License-Identifier: BSD-3-Clause
// What merging a key frame visits and takes in a growing map, of which it sees always the same.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "mapping/geometric_map.hpp"
#include "messaging/program.hpp"
#include "perception/organized_extractor.hpp"
#include "statistics.hpp"
#include "support/plane_renderer.hpp"

namespace {

using namespace geomap;
using mapping::Observation;

constexpr std::array<std::size_t, 4> kSizes = {10, 100, 1000, 5000};  // features, at least
constexpr int kRooms = 40;                                            // in a row of the grid
constexpr double kSpacing = 10.0;                                     // of rooms 4 m wide [m]
constexpr double kDepthSigma = 0.002;                                 // [m]
constexpr std::uint32_t kViews = 4;                                   // that a room is mapped from
constexpr std::uint32_t kAddedViews = 40;                             // of which each is timed
constexpr std::size_t kRuns = 5;  // in each; the least time counts

// Around the middle of the room, noise and all from the number.
Observation view_of_room(std::uint32_t number) {
  const double turn = 0.7 * number;
  const Eigen::Vector3d eye(1.2 * std::sin(turn), -1.2 + 0.3 * std::cos(turn), 1.4);
  Observation seen;
  seen.T_world_camera = testing::look_at(eye, {-0.4 + 0.5 * std::cos(1.3 * number), 1.4, 0.5});
  const geometry::RgbdFrame frame = testing::render(testing::small_room(), testing::kinect_camera(),
                                                    seen.T_world_camera, kDepthSigma, number)
                                        .frame;
  seen.planes = perception::OrganizedExtractor().extract(frame, number, {}).planes;
  return seen;
}

Eigen::Isometry3d T_world_room(int room) {
  return Eigen::Isometry3d(
      Eigen::Translation3d(kSpacing * (room % kRooms), kSpacing * (room / kRooms), 0.0));
}

// A map of rooms that all look the same, none near another.
class Rooms {
 public:
  Rooms() {
    for (std::uint32_t i = 0; i < kViews; ++i) views_.push_back(view_of_room(i));
  }

  void grow_to(std::size_t features) {
    for (; map_.features().size() < features; ++rooms_) {
      for (const Observation& view : views_) add(view, rooms_);
    }
  }

  mapping::ApplyResult add(const Observation& view, int room) {
    auto seen = std::make_shared<Observation>(view);
    seen->keyframe = ++keyframes_;
    seen->T_world_camera = T_world_room(room) * view.T_world_camera;
    return map_.apply(std::move(seen));
  }

  std::size_t features() const { return map_.features().size(); }

 private:
  std::vector<Observation> views_;
  mapping::GeometricMap map_{mapping::MergeConfig{}, mapping::HistoryConfig{}};
  std::int64_t keyframes_ = 0;
  int rooms_ = 0;
};

struct Cost {
  std::size_t features = 0;   // in the map before
  double candidates = 0.0;    // visited, a key frame
  double mean = 0.0;          // merging a key frame, copies of the state now and then included [ms]
  std::vector<double> least;  // of all runs, by key frame [ms]
};

void run(std::size_t features, const std::vector<Observation>& added, Cost& cost) {
  Rooms rooms;
  rooms.grow_to(features);
  cost.features = rooms.features();
  cost.least.resize(added.size(), std::numeric_limits<double>::infinity());
  const double share = 1.0 / static_cast<double>(kRuns * added.size());
  for (std::size_t i = 0; i < added.size(); ++i) {
    mapping::ApplyResult result;
    const double time = bench::milliseconds([&] { result = rooms.add(added[i], 0); });
    cost.candidates += share * static_cast<double>(result.candidates);
    cost.mean += share * time;
    cost.least[i] = std::min(cost.least[i], time);
  }
}

void measure() {
  std::vector<Observation> added;
  for (std::uint32_t i = 0; i < kAddedViews; ++i) added.push_back(view_of_room(kViews + i));
  std::printf(
      "| features in the map | candidates | to the first | median [ms] | to the first "
      "| mean [ms] |\n|--:|--:|--:|--:|--:|--:|\n");
  std::array<Cost, kSizes.size()> costs;
  for (std::size_t i = 0; i < kRuns; ++i) {  // in turn: a busy machine slows all sizes alike
    for (std::size_t size = 0; size < kSizes.size(); ++size) run(kSizes[size], added, costs[size]);
  }
  double candidates = 1.0, slowest = 1.0;
  for (const Cost& cost : costs) {
    const double visited = cost.candidates / costs[0].candidates;
    const double median = bench::median(cost.least);
    const double time = median / bench::median(costs[0].least);
    std::printf("| %zu | %.2f | %.3f | %.3f | %.2f | %.3f |\n", cost.features, cost.candidates,
                visited, median, time, cost.mean);
    candidates = std::max({candidates, visited, 1.0 / visited});
    slowest = std::max(slowest, time);
  }
  const auto verdict = [](const char* what, double found, double allowed) {
    std::printf("- %s: largest ratio %.3f, at most %.2f: %s\n", what, found, allowed,
                found <= allowed ? "yes" : "NO");
  };
  std::printf("\n");
  verdict("candidates visited", candidates, 1.05);
  verdict("time", slowest, 1.3);
}

}  // namespace

int main(int argc, char** argv) {
  return messaging::run_program(
      argc, argv,
      {.name = "merging_growth",
       .description = "Cost of merging always the same key frames into growing maps."},
      [](messaging::OptionParser&) {},
      [](const messaging::CommonOptions&) {
        measure();
        return 0;
      });
}
