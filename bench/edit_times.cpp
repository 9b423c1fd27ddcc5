// SPDX-License-Identifier: BSD-3-Clause
// What an edit, its undo and the drop of a key frame take in a map of many key frames.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "mapping/geometric_map.hpp"
#include "mapping/map_journal.hpp"
#include "messaging/program.hpp"
#include "messaging/stopwatch.hpp"

namespace {

using namespace geomap;
using mapping::EditKind;
using mapping::GeometricMap;
using mapping::Observation;

// The key frames of saved maps, one after the other.
std::vector<std::shared_ptr<const Observation>> keyframes_of(const std::vector<std::string>& maps) {
  std::vector<std::shared_ptr<const Observation>> all;
  for (const std::string& file : maps) {
    for (const mapping::MapEvent& event : mapping::load_map(file).events) {
      const auto* seen = std::get_if<std::shared_ptr<const Observation>>(&event);
      if (seen == nullptr) continue;
      auto copy = std::make_shared<Observation>(**seen);
      copy->keyframe = 1'000'000 + 33'333 * static_cast<std::int64_t>(all.size());
      all.push_back(std::move(copy));
    }
  }
  return all;
}

void report(const char* what, const std::function<void()>& action) {
  const messaging::Stopwatch stopwatch;
  action();
  std::printf("%-52s %8.1f ms\n", what, 1e3 * stopwatch.seconds());
  std::fflush(stdout);
}

int run(const std::vector<std::string>& maps) {
  const auto keyframes = keyframes_of(maps);
  if (keyframes.size() < 10) throw std::runtime_error("these maps have fewer than 10 key frames");
  GeometricMap map(mapping::MergeConfig{}, mapping::HistoryConfig{});
  std::vector<std::int64_t> edits;  // behind every tenth of the key frames
  report("mapping all key frames, with ten label edits", [&] {
    for (std::size_t i = 0; i < keyframes.size(); ++i) {
      map.apply(keyframes[i]);
      if (i % (keyframes.size() / 10) != 0) continue;
      const auto result = map.edit({.kind = EditKind::kLabel,
                                    .targets = {map.features().begin()->first},
                                    .label = std::to_string(i)});
      edits.push_back(result.edit->number);
    }
  });
  std::printf("%zu key frames, %zu features\n", keyframes.size(), map.features().size());
  const auto edit = [&](mapping::EditCommand command) { map.edit(command); };
  const mapping::FeatureId first = map.features().begin()->first;
  report("delete a feature", [&] { edit({.kind = EditKind::kDelete, .targets = {first}}); });
  report("undo of the newest edit", [&] { edit({.kind = EditKind::kUndo}); });
  for (const std::size_t at : {9U, 5U, 0U}) {
    std::printf("behind key frame %zu:\n", at * keyframes.size() / 10);
    report("  undo of an edit", [&] { edit({.kind = EditKind::kUndo, .edits = {edits[at]}}); });
    report("  redo of it", [&] { edit({.kind = EditKind::kRedo, .edits = {edits[at]}}); });
    const std::int64_t keyframe = keyframes[at * keyframes.size() / 10 + 1]->keyframe;
    report("  drop of a key frame",
           [&] { edit({.kind = EditKind::kDropKeyframe, .keyframe = keyframe}); });
    report("  undo of the drop", [&] { edit({.kind = EditKind::kUndo}); });
  }
  report("drop of the newest key frame",
         [&] { edit({.kind = EditKind::kDropKeyframe, .keyframe = keyframes.back()->keyframe}); });
  std::vector<double> drops, undos;
  constexpr std::size_t kDrops = 50;
  for (std::size_t i = 0; i < kDrops; ++i) {
    const std::int64_t keyframe = keyframes[i * keyframes.size() / kDrops]->keyframe;
    const messaging::Stopwatch dropping;
    edit({.kind = EditKind::kDropKeyframe, .keyframe = keyframe});
    drops.push_back(dropping.seconds());
    const messaging::Stopwatch undoing;
    edit({.kind = EditKind::kUndo});
    undos.push_back(undoing.seconds());
  }
  std::sort(drops.begin(), drops.end());
  std::sort(undos.begin(), undos.end());
  const auto print = [](const char* what, const std::vector<double>& sorted) {
    std::printf("%s of %zu key frames over the whole time: median %.1f, 90 %% %.1f, most %.1f ms\n",
                what, sorted.size(), 1e3 * sorted[sorted.size() / 2],
                1e3 * sorted[sorted.size() * 9 / 10], 1e3 * sorted.back());
  };
  print("drop", drops);
  print("undo of the drop", undos);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> maps;
  return messaging::run_program(
      argc, argv,
      {.name = "edit_times",
       .description = "Times edits, undo and dropped key frames in a map of many key frames.",
       .uses_config = false},
      [&](messaging::OptionParser& parser) {
        parser.positionals("MAP", maps,
                           "saved maps of one place, for example of drives with other noise");
      },
      [&](const messaging::CommonOptions&) { return run(maps); });
}
