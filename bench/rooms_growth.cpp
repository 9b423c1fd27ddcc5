// SPDX-License-Identifier: BSD-3-Clause
// What a key frame visits, takes and leaves behind, against the planes in the map (scripts/scale).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "mapping/export_file.hpp"
#include "messaging/program.hpp"
#include "rooms_plot.hpp"

namespace {

using namespace geomap;
using bench::RoomCost;

void print_rows(const std::vector<RoomCost>& rows) {
  std::printf("%7s %11s %8s %11s %9s | %9s %7s %9s %9s %6s\n", "planes", "planes seen", "blocks",
              "candidates", "per plane", "tracking", "planes", "(merging)", "all [ms]", "to 1");
  for (const RoomCost& row : rows) {
    std::printf("%7d %11.1f %8.0f %11.1f %9.2f | %9.2f %7.2f %9.2f %9.2f %5.2fx\n", row.planes,
                row.planes_extracted, row.blocks, row.candidates,
                row.candidates / row.planes_extracted, row.tracking, row.planes_time, row.merging,
                row.total, row.total / rows.front().total);
  }
}

// Largest ratio, either way, of a row to the first.
double spread(const std::vector<RoomCost>& rows, double RoomCost::*figure) {
  double largest = 1.0;
  for (const RoomCost& row : rows) {
    const double ratio = row.*figure / (rows.front().*figure);
    largest = std::max({largest, ratio, 1.0 / ratio});
  }
  return largest;
}

struct Line {
  double bytes_per_plane = 0.0;
  double worst = 0.0;  // distance of a room from it, as a share of the memory at the end
};

// Least squares over all rooms.
Line fit_memory(const std::vector<RoomCost>& rooms) {
  const auto n = static_cast<double>(rooms.size());
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const RoomCost& room : rooms) {
    x += room.planes / n;
    y += room.heap_bytes / n;
  }
  for (const RoomCost& room : rooms) {
    xx += (room.planes - x) * (room.planes - x);
    xy += (room.planes - x) * (room.heap_bytes - y);
  }
  Line line;
  line.bytes_per_plane = xy / xx;
  for (const RoomCost& room : rooms) {
    const double on_line = y + line.bytes_per_plane * (room.planes - x);
    line.worst =
        std::max(line.worst, std::abs(room.heap_bytes - on_line) / rooms.back().heap_bytes);
  }
  return line;
}

void print_verdicts(const std::vector<RoomCost>& rows, const bench::RoomsRun& run) {
  const auto verdict = [](const char* what, double found, double allowed) {
    std::printf("%-36s %.3f, at most %.2f: %s\n", what, found, allowed,
                found <= allowed ? "yes" : "NO");
  };
  std::printf("\n");
  verdict("blocks visited, largest ratio", spread(rows, &RoomCost::blocks), 1.05);
  verdict("candidates visited, largest ratio", spread(rows, &RoomCost::candidates), 1.05);
  double slowest = 1.0;
  for (const RoomCost& row : rows) slowest = std::max(slowest, row.total / rows.front().total);
  verdict("time, largest ratio to the first", slowest, 1.3);
  const Line memory = fit_memory(run.rooms);
  std::printf("memory: %.1f kB a plane, off a line by at most %.1f %%\n",
              1e-3 * memory.bytes_per_plane, 1e2 * memory.worst);
  std::printf("\n%-46s %8s %12s %16s\n", "held at the end by", "MB", "kB a plane",
              "kB a key frame");
  for (const bench::MemoryShare& share : run.memory) {
    std::printf("%-46s %8.1f %12.2f %16.2f\n", share.holder.c_str(), 1e-6 * share.bytes,
                1e-3 * share.bytes / run.planes, 1e-3 * share.bytes / run.keyframes);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::string log, picture;
  bench::RoomsWay way;
  return messaging::run_program(
      argc, argv,
      {.name = "rooms_growth", .description = "Cost of a key frame against the size of the map."},
      [&](messaging::OptionParser& parser) {
        parser.positional("LOG", log, "of geomap-sim in the rooms of scripts/make_rooms");
        parser.option("--rooms", way.side, "rooms of a row, at least 5");
        parser.option("--room-seconds", way.room_seconds, "as scripts/make_rooms has it");
        parser.option("-o,--output", picture, "SVG picture to write; empty: none");
      },
      [&](const messaging::CommonOptions& common) {
        if (way.side < 5) throw messaging::ConfigError("--rooms must be at least 5");
        const bench::RoomsRun run = bench::run_rooms(log, way, common.config);
        const std::vector<RoomCost> rows = bench::medians_by_row(run, way);
        if (rows.empty()) throw std::runtime_error(log + " ends before the third room");
        std::printf(
            "%zu rooms, %d key frames, %d planes; by row of the grid, medians of equal "
            "rooms, a key frame:\n",
            run.rooms.size(), run.keyframes, run.planes);
        print_rows(rows);
        print_verdicts(rows, run);
        if (!picture.empty()) mapping::write_file(picture, bench::plot_rooms(run, way));
        return 0;
      });
}
