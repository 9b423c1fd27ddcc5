// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <optional>
#include <string>

#include "drivers/frame_messages.hpp"
#include "drivers/odometry_drift.hpp"
#include "drivers/simulated_source.hpp"
#include "drivers/true_visibility.hpp"

namespace geomap::drivers {

/// @brief What a simulation put out.
struct SimulationSummary {
  bool stopped = false;  // by `proceed`
  std::size_t frames = 0;
  std::size_t dropped = 0;  // live only: those that there was no time for
  double simulated = 0.0;   // [s]
  double wall = 0.0;        // that it took [s]
  std::uintmax_t log_bytes = 0;
  std::size_t planes_seen = 0;
  std::size_t planes = 0;
};

/// @brief A robot in a scene that says what the real one would: CAMERA_TO_BODY, POSE of an odometry
/// that drifts, RGBD_FRAME, and TRUTH_POSE beside.
class SimProcess {
 public:
  /// @brief Called before each frame with its number; false ends the simulation.
  using Proceed = std::function<bool(std::size_t frame)>;

  /// @param scene must outlive this object.
  SimProcess(const Scene& scene, const CameraTrajectory& trajectory, const SimulationConfig& config,
             const OdometryDriftConfig& drift);

  std::size_t size() const { return source_.size(); }

  /// @brief Writes a log, and the true planes as `log` with .truth.yaml in place of its extension.
  /// Both appear when they are whole, or not at all.
  SimulationSummary record(const std::filesystem::path& log, const Proceed& proceed);

  /// @brief Writes what a Kinect in the camera's place would send, for fakenect.
  /// @throws as FakenectFolder.
  SimulationSummary record_kinect(const std::filesystem::path& folder, const Proceed& proceed);

  /// @brief Publishes each frame when its time has come, and leaves out those that it would be late
  /// for by more than one.
  SimulationSummary publish(lcm::LCM& lcm, const std::string& channel_prefix,
                            const Proceed& proceed);

 private:
  FrameMessages take();
  void skip();

  RayCaster caster_;
  SimulatedSource source_;
  OdometryDrift drift_;
  TrueVisibility visibility_;
  double rate_;
};

/// @brief The truth beside a log: the same name with .truth.yaml in place of the extension.
std::filesystem::path truth_path(const std::filesystem::path& log);

/// @brief The summary in one line for people.
std::string to_string(const SimulationSummary& summary);

}  // namespace geomap::drivers
