// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "viewer/map_source.hpp"

namespace geomap::viewer::testing {

/// @brief A rectangle of the map. Axes unit and at right angles, origin its centre; world frame.
inline mapping::ViewFeature rectangle_feature(std::int64_t number, const Eigen::Vector3d& center,
                                              const Eigen::Vector3d& normal,
                                              const Eigen::Vector3d& x_axis, double width,
                                              double height) {
  mapping::MapFeature feature;
  feature.id = {1'000'000 + number, 0};
  feature.observations = {feature.id};
  feature.surface.frame = {center, x_axis, normal};
  feature.surface.plane = feature.surface.frame.plane();
  feature.surface.polygon = geometry::canonical(
      {{{geometry::rectangle({-0.5 * width, -0.5 * height}, {0.5 * width, 0.5 * height}), {}}}});
  return mapping::quantised(feature);
}

/// @brief What a test puts in is what the scene shows; what is asked for is kept.
class FakeSource : public MapSource {
 public:
  std::string title() const override { return "fake"; }
  bool update(SceneModel& scene, Clock::time_point) override {
    if (!is_changed) return false;
    is_changed = false;
    scene.map.features = features;
    scene.map.revision = revision;
    scene.map.is_current = true;
    ++scene.map.stamp;
    scene.frame.newest = newest;
    ++scene.frame.stamp;
    return true;
  }
  void edit(const mapping::EditCommand& command) override { commands.push_back(command); }
  std::vector<Outcome> take_outcomes() override { return std::exchange(outcomes, {}); }
  const std::vector<HistoryEntry>& history() const override { return entries; }
  std::int64_t save(const std::string& where) override {
    saved.push_back(where);
    return 77;
  }
  std::string default_save_name() const override { return "map"; }
  std::string save_prompt() const override { return "file"; }
  mapping::MapSnapshot snapshot(const SceneModel&) const override {
    throw std::runtime_error("a fake has nothing to export");
  }
  bool is_live() const override { return live; }

  void put(const mapping::ViewFeature& feature) {
    features[feature.id] = feature;
    is_changed = true;
  }

  Features features;
  std::int64_t revision = 1;
  std::shared_ptr<const geometry::RgbdFrame> newest;
  bool is_changed = true, live = false;
  std::vector<mapping::EditCommand> commands;
  std::vector<Outcome> outcomes;
  std::vector<HistoryEntry> entries;
  std::vector<std::string> saved;
};

}  // namespace geomap::viewer::testing
