// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map_journal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "mapping/map_hash.hpp"
#include "mapping/map_messages.hpp"
#include "messaging/channels.hpp"
#include "messaging/config.hpp"
#include "messaging/log_reader.hpp"
#include "messaging/log_writer.hpp"
#include "messaging/part_file.hpp"
#include "messaging/safe_decode.hpp"

namespace geomap::mapping {
namespace {

namespace channels = messaging::channels;

constexpr std::int64_t kNoKeyframe = -1;

// A section of YAML that reads back to the same numbers.
template <class Settings>
std::string to_yaml(const std::string& section, const Settings& settings) {
  std::string text = section + ":\n";
  Settings::visit(settings, [&](const char* name, const auto& value) {
    text += fmt::format("  {}: {}\n", name, value);
  });
  return text;
}

std::string to_yaml(const MergeConfig& merge, const HistoryConfig& history) {
  return to_yaml("merge", merge) + to_yaml("history", history);
}

// Reads one map file; every failure names it.
class MapFile {
 public:
  explicit MapFile(const std::filesystem::path& path) : path_(path) {}

  LoadedJournal load() {
    messaging::LogReader reader(path_.string());
    while (const auto event = reader.next()) {
      take(*event);
      if (state_ && journal_.begin == 0) journal_.begin = reader.position();
    }
    if (!state_) fail("holds no map (no MAP_STATE)");
    take_damages(reader);
    take_state();
    return std::move(journal_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(path_.string() + " " + what);
  }

  template <class Message>
  Message decode(const messaging::LogEvent& event) const {
    auto decoded = messaging::safe_decode<Message>(event.data.data(), event.data.size());
    if (!decoded.message) {
      fail("holds a " + event.channel +
           " that cannot be read: " + messaging::to_string(decoded.reason));
    }
    return std::move(*decoded.message);
  }

  void take(const messaging::LogEvent& event) {
    if (event.channel == channels::kMapEvent) {
      auto map_event = from_message(decode<geomap::map_event_t>(event));
      if (!map_event) fail("holds an event that is no map event");
      journal_.later.push_back(std::move(*map_event));
    } else if (event.channel == channels::kMapState) {
      state_ = decode<geomap::map_state_t>(event);
      std::move(journal_.later.begin(), journal_.later.end(),
                std::back_inserter(journal_.saved.events));
      journal_.later.clear();
    }
  }

  void take_damages(const messaging::LogReader& reader) {
    journal_.end = reader.size();
    for (const messaging::LogDamage& damage : reader.damages()) {
      if (damage.offset < journal_.begin) fail("is damaged");
      const bool is_tail = damage.offset + damage.size == reader.size();
      (is_tail ? journal_.torn : journal_.damaged) += damage.size;
      if (is_tail) journal_.end = damage.offset;
    }
  }

  MapContents contents(const geomap::map_contents_t& message) const {
    auto contents = from_message(message, journal_.saved.merge);
    if (!contents) fail("holds a feature that is not valid");
    return std::move(*contents);
  }

  void take_state() {
    SavedMap& saved = journal_.saved;
    try {
      const auto config = messaging::Config::from_text(to_yaml(MergeConfig{}, HistoryConfig{}),
                                                       state_->config, path_.string());
      saved.merge = config.read<MergeConfig>("merge");
      saved.history = config.read<HistoryConfig>("history");
    } catch (const messaging::ConfigError& error) {
      fail(std::string("was made with settings of another version: ") + error.what());
    }
    saved.revision = state_->revision;
    saved.contents = contents(state_->contents);
    saved.base = contents(state_->base);
    saved.last_edit = state_->last_edit;
    if (state_->base_keyframe != kNoKeyframe) saved.base_keyframe = state_->base_keyframe;
    if (map_hash(saved.contents.features, saved.contents.vetoes) != state_->hash) {
      fail("is damaged: its hash does not match");
    }
  }

  std::filesystem::path path_;
  std::optional<geomap::map_state_t> state_;
  LoadedJournal journal_;
};

}  // namespace

geomap::map_state_t state_of(const SavedMap& saved) {
  geomap::map_state_t state{};
  state.revision = saved.revision;
  state.config = to_yaml(saved.merge, saved.history);
  state.hash = map_hash(saved.contents.features, saved.contents.vetoes);
  state.contents = to_message(saved.contents);
  for (const auto& [id, feature] : saved.contents.features) {
    state.utime = std::max(state.utime, feature->last_utime());
  }
  state.base = to_message(saved.base);
  state.last_edit = saved.last_edit;
  state.base_keyframe = saved.base_keyframe.value_or(kNoKeyframe);
  return state;
}

void save_map(const std::filesystem::path& path, const GeometricMap& map) {
  const SavedMap saved = map.saved();
  messaging::PartFile file(path.string());
  messaging::LogWriter writer(file.name());
  for (const MapEvent& event : saved.events) {
    const geomap::map_event_t message = to_message(event);
    writer.write(channels::kMapEvent, message.utime, message);
  }
  const geomap::map_state_t state = state_of(saved);
  writer.write(channels::kMapState, state.utime, state);
  writer.sync();
  writer.close();
  file.keep();
}

SavedMap load_map(const std::filesystem::path& path) {
  LoadedJournal journal = load_journal(path);
  if (journal.torn + journal.damaged > 0) {
    throw std::runtime_error(path.string() + " is damaged");
  }
  if (journal.later.empty()) return std::move(journal.saved);
  GeometricMap map(journal.saved);
  for (const MapEvent& event : journal.later) map.apply(event);
  return map.saved();
}

LoadedJournal load_journal(const std::filesystem::path& path) { return MapFile(path).load(); }

bool is_same_merging(const MergeConfig& a, const MergeConfig& b) {
  return to_yaml("merge", a) == to_yaml("merge", b);
}

GeometricMap reopen(SavedMap saved, const MergeConfig& merge, const HistoryConfig& history) {
  const bool is_same = is_same_merging(saved.merge, merge);
  saved.merge = merge;
  saved.history = history;
  if (is_same) return GeometricMap(saved);
  GeometricMap map(saved);
  map.fold_anew();
  return map;
}

MapSnapshot snapshot_of(std::int64_t revision, const FeatureSet& features, const VetoSet& vetoes) {
  MapSnapshot snapshot{revision, map_hash(features, vetoes), {}, {}};
  for (const auto& [id, feature] : features) snapshot.features.push_back(*feature);
  for (const auto& [key, veto] : vetoes) snapshot.vetoes.push_back(*veto);
  return snapshot;
}

MapSnapshot snapshot_of(const SavedMap& saved) {
  return snapshot_of(saved.revision, saved.contents.features, saved.contents.vetoes);
}

MapSnapshot snapshot_of(const GeometricMap& map) {
  return snapshot_of(map.revision(), map.features(), map.vetoes());
}

}  // namespace geomap::mapping
