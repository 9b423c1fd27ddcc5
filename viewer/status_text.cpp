// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/status_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace geomap::viewer {
namespace {

constexpr double kStale = 3.0;         // without any message [s]
constexpr double kStaleProcess = 4.0;  // of which HEALTH comes every second [s]
constexpr double kStaleCamera = 5.0;   // without a camera pose, where there was one [s]

double seconds_since(Clock::time_point then, Clock::time_point now) {
  return std::max(0.0, std::chrono::duration<double>(now - then).count());
}

std::string count_text(std::int64_t count, const char* what) {
  return count > 0 ? fmt::format("  {} {}", count, what) : "";
}

// Losses of the last minute count, older ones are told to who asks.
StatusItem link_item(const SceneModel& scene, Clock::time_point now) {
  if (!scene.heard) return {Level::kFailing, "link: nothing heard yet", "", false};
  const double age = seconds_since(*scene.heard, now);
  StatusItem item;
  std::int64_t missing = 0, refused = 0;
  for (const auto& [name, channel] : scene.channels) {
    const double silent = seconds_since(channel.last, now);
    item.detail += fmt::format("{:<16} {:>5.1f}/s  {:>8}  last {} ago{}{}\n", name,
                               silent > kStale ? 0.0 : channel.rate, bytes_text(channel.bytes),
                               age_text(silent), count_text(channel.missing, "missing"),
                               count_text(channel.refused, "refused"));
    missing += channel.recent_missing;
    refused += channel.recent_refused;
  }
  if (scene.overflowed > 0) {
    item.detail += fmt::format("{} messages found no room here\n", scene.overflowed);
  }
  item.text = fmt::format("link: {} ago", age_text(age));
  if (missing > 0) item.text += fmt::format(", {} messages lost in a minute", missing);
  if (refused > 0) item.text += fmt::format(", {} refused", refused);
  if (missing + refused > 0) item.level = Level::kDegraded;
  if (age > kStale) item.level = Level::kFailing;
  return item;
}

StatusItem registration_item(const SceneModel& scene) {
  const RegistrationState& registration = scene.registration;
  if (registration.text.empty()) {
    return {Level::kGood, "registration: nothing yet", "no key frame has come", false};
  }
  return {registration.level, "registration: " + registration.text, ""};
}

StatusItem map_item(const SceneModel& scene) {
  const MapLayer& map = scene.map;
  const std::size_t locked = static_cast<std::size_t>(
      std::count_if(map.features.begin(), map.features.end(),
                    [](const auto& feature) { return feature.second.locked; }));
  StatusItem item{
      Level::kGood,
      fmt::format("map: {} polygons{}", map.features.size(),
                  map.bytes > 0 ? fmt::format(", {} received", bytes_text(map.bytes)) : ""),
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
  if (!is_flowing) {
    const double age = seconds_since(found->second.last, now);
    return StatusItem{Level::kDegraded, fmt::format("frames: none for {}", age_text(age)), ""};
  }
  return StatusItem{Level::kGood, fmt::format("frames: {:.1f}/s", found->second.rate),
                    fmt::format("{} missing by their numbers", found->second.missing)};
}

StatusItem process_item(const std::string& name, const ProcessState& process,
                        Clock::time_point now) {
  const double age = seconds_since(process.heard, now);
  const std::string short_name = name.starts_with("geomap-") ? name.substr(7) : name;
  StatusItem item{process.level, short_name, ""};
  if (age > kStaleProcess) {
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
  const auto mapper = scene.processes.find("geomap-mapper");
  if (mapper == scene.processes.end()) {
    return "No geomap-mapper has been heard: nothing can be edited";
  }
  const double silent = seconds_since(mapper->second.heard, now);
  if (silent > kStaleProcess) {
    return fmt::format("The mapper has been silent for {}: the map is old, edits are not possible",
                       age_text(silent));
  }
  const auto camera = scene.channels.find("CAMERA_POSE");
  if (camera == scene.channels.end()) return "No robot has been heard since this window opened";
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
