// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/exact_map_messages.hpp"

#include <exception>
#include <utility>

#include "mapping/clean_text.hpp"
#include "mapping/edit_messages.hpp"
#include "mapping/map_journal.hpp"
#include "viewer/edit_record_messages.hpp"

namespace geomap::viewer {
namespace {

constexpr std::int64_t kEpoch = 1;  // there is no mapper that could be started anew

}  // namespace

void show(const mapping::GeometricMap& map, MapLayer& layer) {
  layer.features.clear();
  for (const auto& [id, feature] : map.features()) {
    mapping::ViewFeature view = mapping::quantised(*feature);
    view.label = mapping::clean_text(view.label);
    layer.features.emplace_hint(layer.features.end(), id, std::move(view));
  }
  layer.vetoes.clear();
  for (const auto& [key, veto] : map.vetoes()) layer.vetoes.push_back(*veto);
  layer.utime = map.history().newest();
  layer.epoch = kEpoch;
  layer.revision = map.revision();
  layer.is_current = true;
  ++layer.stamp;
  ++layer.veto_stamp;
}

void show_keyframes(const mapping::GeometricMap& map, TrackLayer& layer) {
  layer.keyframes.clear();
  for (const auto& [keyframe, observation] : map.history().keyframes()) {
    if (map.history().edits().is_dropped(keyframe)) continue;
    layer.keyframes.emplace(keyframe,
                            map.history().pose_of(keyframe).value_or(observation->T_world_camera));
  }
  ++layer.stamp;
}

std::vector<HistoryEntry> history_of(const mapping::GeometricMap& map) {
  std::vector<HistoryEntry> history;
  for (const auto& [number, entry] : map.history().edits().entries()) {
    history.push_back(entry_of(mapping::record_of(entry, map)));
  }
  return history;
}

Outcome edit(const mapping::EditCommand& command, mapping::GeometricMap& map) {
  const mapping::EditResult result = map.edit(command);
  return {.command = command.command,
          .is_done = result.edit != nullptr,
          .text = mapping::describe(result),
          .edit = result.edit ? result.edit->number : 0,
          .revision = map.revision()};
}

Outcome save(const mapping::GeometricMap& map, const std::filesystem::path& file,
             std::int64_t number) {
  try {
    mapping::save_map(file, map);
    return {.command = number, .is_done = true, .text = "map saved as " + file.string()};
  } catch (const std::exception& error) {
    return {.command = number, .is_done = false, .text = error.what()};
  }
}

}  // namespace geomap::viewer
