// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/status_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace geomap::viewer {
namespace {

constexpr double kStale = 3.0;        // without any message [s]
constexpr double kStaleCamera = 5.0;  // without a camera pose, where there was one [s]

double seconds_since(Clock::time_point then, Clock::time_point now) {
  return std::max(0.0, std::chrono::duration<double>(now - then).count());
}

StatusItem link_item(const SceneModel& scene, Clock::time_point now) {
  if (!scene.heard) return {Level::kFailing, "link: nothing heard yet", ""};
  const double age = seconds_since(*scene.heard, now);
  StatusItem item{age > kStale ? Level::kFailing : Level::kGood,
                  fmt::format("link: {} ago", age_text(age)), ""};
  for (const auto& [name, channel] : scene.channels) {
    item.detail +=
        fmt::format("{:<16} {:>5.1f}/s  {:>8}  last {} ago{}{}\n", name,
                    seconds_since(channel.last, now) > kStale ? 0.0 : channel.rate,
                    bytes_text(channel.bytes), age_text(seconds_since(channel.last, now)),
                    channel.missing > 0 ? fmt::format("  {} missing", channel.missing) : "",
                    channel.refused > 0 ? fmt::format("  {} refused", channel.refused) : "");
    if (channel.missing > 0 || channel.refused > 0) {
      item.level = std::max(item.level, Level::kDegraded);
    }
  }
  return item;
}

StatusItem registration_item(const SceneModel& scene) {
  const RegistrationState& registration = scene.registration;
  if (registration.text.empty()) return {Level::kGood, "registration: -", "no key frame yet"};
  return {registration.level, "registration: " + registration.text, ""};
}

StatusItem map_item(const SceneModel& scene) {
  const MapLayer& map = scene.map;
  const std::size_t locked = static_cast<std::size_t>(
      std::count_if(map.features.begin(), map.features.end(),
                    [](const auto& feature) { return feature.second.locked; }));
  StatusItem item{Level::kGood,
                  fmt::format("map: {} polygons{}", map.features.size(),
                              map.bytes > 0 ? ", " + bytes_text(map.bytes) : ""),
                  fmt::format("revision {}\n{} held by an operator\n{} surfaces kept out\n{} key "
                              "frames\n{} points in the point map",
                              map.revision, locked, map.vetoes.size(), scene.track.keyframes.size(),
                              scene.points.points)};
  if (!map.is_current && scene.heard) {
    item.level = Level::kDegraded;
    item.text += ", waiting for the rest";
  }
  return item;
}

std::optional<StatusItem> frames_item(const SceneModel& scene, Clock::time_point now) {
  const auto found = scene.channels.find("RGBD_FRAME");
  if (found == scene.channels.end()) return std::nullopt;
  const bool is_flowing = seconds_since(found->second.last, now) < kStale;
  return StatusItem{Level::kGood,
                    fmt::format("frames: {:.1f}/s", is_flowing ? found->second.rate : 0.0),
                    fmt::format("{} missing by their numbers", found->second.missing)};
}

StatusItem process_item(const std::string& name, const ProcessState& process,
                        Clock::time_point now) {
  const double age = seconds_since(process.heard, now);
  const std::string short_name = name.starts_with("geomap-") ? name.substr(7) : name;
  StatusItem item{process.level, short_name, ""};
  if (age > kStale) {
    item.level = Level::kFailing;
    item.text += fmt::format(": silent for {}", age_text(age));
  } else if (process.level != Level::kGood) {
    item.text += ": " + process.message;
  }
  double slowest = 0.0;
  for (const ProcessState::Stage& stage : process.stages) {
    slowest = std::max(slowest, stage.p95);
    item.detail += fmt::format("{}: median {:.1f} ms, 95 % {:.1f} ms, longest {:.1f} ms\n",
                               stage.name, 1e3 * stage.p50, 1e3 * stage.p95, 1e3 * stage.max);
  }
  const bool is_well = item.level == Level::kGood;
  if (is_well && slowest > 0.0) item.text += fmt::format(" {:.0f} ms", 1e3 * slowest);
  for (const auto& [counter, value] : process.counters) {
    item.detail += fmt::format("{} {}\n", counter, value);
  }
  return item;
}

}  // namespace

std::vector<StatusItem> status_items(const SceneModel& scene, const MapSource& source,
                                     Clock::time_point now) {
  std::vector<StatusItem> items;
  if (source.is_live()) items.push_back(link_item(scene, now));
  items.push_back(registration_item(scene));
  items.push_back(map_item(scene));
  if (const auto frames = frames_item(scene, now)) items.push_back(*frames);
  if (!source.is_live()) return items;
  for (const auto& [name, process] : scene.processes) {
    items.push_back(process_item(name, process, now));
  }
  return items;
}

std::optional<std::string> stale_warning(const SceneModel& scene, const MapSource& source,
                                         Clock::time_point now) {
  if (!source.is_live()) return std::nullopt;
  if (!scene.heard)
    return "Nothing heard yet: are the processes running? geomap-doctor looks at the network";
  const double age = seconds_since(*scene.heard, now);
  if (age > kStale) return fmt::format("NO DATA for {}: what you see is old", age_text(age));
  const auto camera = scene.channels.find("CAMERA_POSE");
  if (camera == scene.channels.end()) return std::nullopt;
  const double still = seconds_since(camera->second.last, now);
  if (still <= kStaleCamera) return std::nullopt;
  return fmt::format("No camera pose for {}: the robot may be elsewhere", age_text(still));
}

std::string age_text(double seconds) {
  if (seconds < 10.0) return fmt::format("{:.1f} s", seconds);
  if (seconds < 120.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 7200.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.0f} h", seconds / 3600.0);
}

std::string bytes_text(std::int64_t bytes) {
  const auto size = static_cast<double>(bytes);
  if (bytes < 1000) return fmt::format("{} B", bytes);
  if (bytes < 1'000'000) return fmt::format("{:.1f} kB", size / 1e3);
  if (bytes < 1'000'000'000) return fmt::format("{:.1f} MB", size / 1e6);
  return fmt::format("{:.1f} GB", size / 1e9);
}

}  // namespace geomap::viewer
