// SPDX-License-Identifier: BSD-3-Clause
#include "room_costs.hpp"

#include <malloc.h>

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

#include "messaging/log_reader.hpp"
#include "messaging/program.hpp"
#include "messaging/progress_bar.hpp"
#include "perception/sensor_messages.hpp"
#include "statistics.hpp"

namespace geomap::bench {
namespace {

using logs::KeyframeRecord;

constexpr double kDoorAfterMiddle = 20.0 / 26.0;  // of a room's time: it turns, then drives out

// What is allocated, not what the allocator holds of the system: the same in each run.
double heap_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

template <typename Copy>
double bytes_of(const Copy& copy) {
  const double before = heap_bytes();
  const auto copied = copy();
  return heap_bytes() - before;
}

double bytes_of_features(const mapping::GeometricMap& map) {
  return bytes_of([&] {
    std::vector<mapping::MapFeature> copies;
    copies.reserve(map.features().size());
    for (const auto& [id, feature] : map.features()) copies.push_back(*feature);
    return copies;
  });
}

double bytes_of_observations(const mapping::GeometricMap& map) {
  return bytes_of([&] {
    std::vector<mapping::Observation> copies;
    copies.reserve(map.history().keyframes().size());
    for (const auto& [id, seen] : map.history().keyframes()) copies.push_back(*seen);
    return copies;
  });
}

std::vector<MemoryShare> memory_of(const logs::Pipeline& pipeline, double heap) {
  const auto voxels = static_cast<double>(pipeline.point_map().voxels().memory_bytes());
  const double frames = static_cast<double>(pipeline.point_map().memory_bytes()) - voxels;
  const double features = bytes_of_features(pipeline.map());
  const double observations = bytes_of_observations(pipeline.map());
  return {{"point map: voxels", voxels},
          {"point map: thin frames", frames},
          {"map: features", features},
          {"map: observations, to fold again from", observations},
          {"the rest: tables, index, copies of the state",
           heap - voxels - frames - features - observations},
          {"all", heap}};
}

// Processor time of the parts of a key frame, told apart by when the pipeline calls back.
class Meter {
 public:
  void start() { mark_ = processor_milliseconds(); }
  void note_tracked() { tracking_ = lap(); }
  void note_merged(RoomCost& sum) {
    const double planes_time = lap();
    sum.tracking += tracking_;
    sum.planes_time += planes_time;
    sum.total += tracking_ + planes_time;
  }

 private:
  double lap() {
    const double before = mark_;
    start();
    return mark_ - before;
  }
  double mark_ = 0.0;
  double tracking_ = 0.0;
};

void add(RoomCost& sum, const KeyframeRecord& record) {
  ++sum.keyframes;
  sum.planes_extracted += record.planes;
  sum.blocks += record.registration.blocks_visited;
  sum.candidates += static_cast<double>(record.candidates);
}

constexpr std::array kMeans = {&RoomCost::planes_extracted, &RoomCost::blocks,
                               &RoomCost::candidates,       &RoomCost::tracking,
                               &RoomCost::planes_time,      &RoomCost::total};

}  // namespace

int RoomsWay::room_at(double seconds) const {
  return static_cast<int>(std::floor(seconds / room_seconds - kDoorAfterMiddle + 1e-9)) + 1;
}

bool RoomsWay::is_comparable(int room) const {
  const int step = room % side;
  return step >= 2 && step < side - 2;
}

RoomsRun run_rooms(const std::string& log, const RoomsWay& way, const messaging::Config& config) {
  const logs::PipelineConfig settings = logs::read_pipeline_config(config);
  logs::Pipeline pipeline(settings, 1);
  perception::SensorMessages input(
      pipeline.tracking(), {settings.driver_depth.camera(), settings.driver_color.camera()});
  const double heap_before = heap_bytes();
  RoomsRun run;
  std::optional<std::int64_t> start;
  std::map<int, std::vector<double>> merging;  // [ms], by room
  Meter meter;
  pipeline.on_tracked([&](const perception::TrackedFrame&) { meter.note_tracked(); });
  pipeline.on_keyframe(
      [&](const KeyframeRecord& record, const mapping::Observation&, const mapping::MapChange&) {
        if (!start) start = record.id;
        const int room = way.room_at(1e-6 * static_cast<double>(record.id - *start));
        if (run.rooms.empty() || run.rooms.back().room != room) {
          run.rooms.emplace_back().room = room;
        }
        RoomCost& cost = run.rooms.back();
        meter.note_merged(cost);
        add(cost, record);
        merging[room].push_back(1e3 * record.times.merging);
        cost.planes = record.map_features;
        cost.heap_bytes = heap_bytes() - heap_before;
        meter.start();
      });
  messaging::LogReader reader(log);
  messaging::ProgressBar progress("frames", 0);
  while (const auto event = reader.next()) {
    if (messaging::stop_requested()) throw std::runtime_error("stopped");
    meter.start();
    input.handle(event->channel, event->data);
    progress.update(pipeline.frames(), pipeline.frames() * reader.size() / reader.position());
  }
  pipeline.finish();
  for (RoomCost& cost : run.rooms) {
    for (const auto figure : kMeans) cost.*figure /= cost.keyframes;
    cost.merging = median(merging[cost.room]);
  }
  run.keyframes = static_cast<int>(pipeline.keyframes().size());
  run.planes = static_cast<int>(pipeline.map().features().size());
  run.memory = memory_of(pipeline, heap_bytes() - heap_before);
  return run;
}

std::vector<RoomCost> medians_by_row(const RoomsRun& run, const RoomsWay& way) {
  std::map<int, std::vector<RoomCost>> rows;
  for (const RoomCost& cost : run.rooms) {
    if (way.is_comparable(cost.room)) rows[way.row_of(cost.room)].push_back(cost);
  }
  std::vector<RoomCost> medians;
  for (const auto& entry : rows) {
    const std::vector<RoomCost>& rooms = entry.second;
    RoomCost middle = rooms[rooms.size() / 2];
    const auto take_median = [&](double RoomCost::*figure) {
      std::vector<double> values;
      for (const RoomCost& room : rooms) values.push_back(room.*figure);
      middle.*figure = median(values);
    };
    for (const auto figure : kMeans) take_median(figure);
    take_median(&RoomCost::merging);
    medians.push_back(middle);
  }
  return medians;
}

}  // namespace geomap::bench
