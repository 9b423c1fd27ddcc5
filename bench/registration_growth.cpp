// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cstdio>
#include <stdexcept>
#include <utility>
#include <vector>

#include "geometry/angles.hpp"
#include "registration_bench.hpp"
#include "registration_stages.hpp"
#include "statistics.hpp"
#include "support/plane_renderer.hpp"

namespace geomap::bench {
namespace {

using namespace perception;

constexpr std::array kSizes = {1, 10, 100};  // rooms
constexpr int kRooms = 10;                   // in a row of the grid
constexpr int kRuns = 200;
constexpr double kDepthSigma = 0.002;  // [m]

struct View {
  geometry::RgbdFrame frame;
  Eigen::Isometry3d T_room_camera;
};

View view_of_room(const Eigen::Vector3d& eye, const Eigen::Vector3d& target, std::uint32_t seed) {
  const Eigen::Isometry3d T = testing::look_at(eye, target);
  return {
      testing::render(testing::small_room(), testing::kinect_camera(), T, kDepthSigma, seed).frame,
      T};
}

std::vector<View> room_views() {
  return {view_of_room({1.0, -1.2, 1.4}, {-0.5, 1.5, 0.6}, 1),
          view_of_room({0.6, -1.4, 1.5}, {-0.8, 1.2, 0.7}, 2),
          view_of_room({1.3, -0.6, 1.3}, {-1.0, 1.6, 0.5}, 3),
          view_of_room({0.0, -1.0, 1.6}, {0.3, 1.6, 0.4}, 4)};
}

// Rooms stand apart by whole blocks of the map, far enough that none sees another: all alike.
Eigen::Isometry3d T_world_room(int room, double voxel_size) {
  const double spacing = 20.0 * MapBlock::kSide * voxel_size;
  return Eigen::Isometry3d(
      Eigen::Translation3d(spacing * (room % kRooms), spacing * (room / kRooms), 0.0));
}

struct Times {
  std::vector<double> select, align, insert, total;  // [ms]
  int blocks_visited = 0;
};

// A view that the map does not have, aligned and inserted, and taken out again. Each run is in
// another room where `everywhere`, so that nothing of the map is left in the caches by the last.
Times run(PointMap& map, const View& view, int rooms, bool everywhere,
          const RegistrationBenchSettings& settings) {
  const FrameView made = map.view(view.frame);
  Eigen::Isometry3d off = Eigen::Isometry3d::Identity();
  off.translation() = Eigen::Vector3d(0.02, -0.01, 0.02);
  off.linear() =
      Eigen::AngleAxisd(geometry::radians(1.0), Eigen::Vector3d(0.6, 0.8, 0.0)).toRotationMatrix();
  Times times;
  for (int i = 0; i < kRuns; ++i) {
    const int room = everywhere ? i * 7 % rooms : 0;
    const Eigen::Isometry3d prior =
        T_world_room(room, settings.tracker.point_map.voxels.voxel_size) * view.T_room_camera * off;
    const IcpRegistrationConfig& config = settings.tracker.registration.icp;
    FrameView copy = made;
    SurfelSelection selection;
    Alignment found;
    times.select.push_back(milliseconds(
        [&] { selection = select_surfels(map.voxels(), copy, prior, config.margin); }));
    times.align.push_back(milliseconds(
        [&] { found = perception::align(selection.surfels, copy.surfaces, prior, config.icp); }));
    if (!found.converged) throw std::runtime_error("growth: an alignment did not converge");
    times.insert.push_back(
        milliseconds([&] { map.insert(-1, std::move(copy), found.T_world_camera); }));
    times.total.push_back(times.select.back() + times.align.back() + times.insert.back());
    times.blocks_visited = selection.blocks_visited;
    map.remove(-1);
  }
  return times;
}

}  // namespace

void bench_growth(const RegistrationBenchSettings& settings) {
  const std::vector<View> views = room_views();
  const View added = view_of_room({0.8, -1.1, 1.45}, {-0.6, 1.4, 0.6}, 5);
  PointMap map(settings.tracker.point_map);
  int rooms = 0;
  std::printf("A view of a room in a growing map (medians [ms])\n");
  const char* columns = " select   align  insert     sum  to 1 ";
  std::printf("%33s  %-40s%s\n", "", "always the same room", "each time another room");
  std::printf("%6s %9s %7s %8s  %s  %s\n", "rooms", "points", "blocks", "visited", columns,
              columns);
  double first = 0.0, first_everywhere = 0.0;
  for (const int size : kSizes) {
    for (; rooms < size; ++rooms) {
      for (std::size_t i = 0; i < views.size(); ++i) {
        map.insert(static_cast<std::int64_t>(views.size()) * rooms + static_cast<std::int64_t>(i),
                   views[i].frame,
                   T_world_room(rooms, settings.tracker.point_map.voxels.voxel_size) *
                       views[i].T_room_camera);
      }
    }
    const Times same = run(map, added, size, false, settings);
    const Times other = run(map, added, size, true, settings);
    if (size == 1) first = median(same.total), first_everywhere = median(other.total);
    const auto print = [](const Times& times, double reference) {
      std::printf("  %7.3f %7.3f %7.3f %7.3f %5.2f x", median(times.select), median(times.align),
                  median(times.insert), median(times.total), median(times.total) / reference);
    };
    std::printf("%6d %9zu %7zu %8d", size, map.size(), map.voxels().blocks().size(),
                same.blocks_visited);
    print(same, first);
    print(other, first_everywhere);
    std::printf("\n");
  }
}

}  // namespace geomap::bench
