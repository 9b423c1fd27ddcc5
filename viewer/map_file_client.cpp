// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/map_file_client.hpp"

#include <utility>

#include "mapping/map_journal.hpp"
#include "mapping/operator_name.hpp"
#include "viewer/exact_map_messages.hpp"

namespace geomap::viewer {
namespace {

class MapFile : public MapSource {
 public:
  explicit MapFile(std::filesystem::path file)
      : file_(std::move(file)), map_(mapping::load_map(file_)), history_(history_of(map_)) {}

  std::string title() const override { return file_.filename().string(); }

  bool update(SceneModel& scene, Clock::time_point) override {
    if (!std::exchange(is_changed_, false)) return false;
    show(map_, scene.map);
    show_keyframes(map_, scene.track);
    return true;
  }

  void edit(const mapping::EditCommand& command) override {
    outcomes_.push_back(viewer::edit(command, map_));
    if (!outcomes_.back().is_done) return;
    history_ = history_of(map_);
    is_changed_ = true;
  }

  std::vector<Outcome> take_outcomes() override { return std::exchange(outcomes_, {}); }
  const std::vector<HistoryEntry>& history() const override { return history_; }

  std::int64_t save(const std::string& where) override {
    const std::int64_t number = numbers_.next();
    outcomes_.push_back(viewer::save(map_, where, number));
    return number;
  }
  std::string default_save_name() const override { return file_.string(); }
  std::string save_prompt() const override { return "file"; }

  mapping::MapSnapshot snapshot(const SceneModel&) const override {
    return mapping::snapshot_of(map_);
  }

 private:
  std::filesystem::path file_;
  mapping::GeometricMap map_;
  std::vector<HistoryEntry> history_;
  std::vector<Outcome> outcomes_;
  mapping::CommandNumbers numbers_;
  bool is_changed_ = true;
};

}  // namespace

std::unique_ptr<MapSource> open_map_file(const std::filesystem::path& file) {
  return std::make_unique<MapFile>(file);
}

}  // namespace geomap::viewer
