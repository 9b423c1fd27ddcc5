// SPDX-License-Identifier: BSD-3-Clause
#include "simulated_frames.hpp"

#include <utility>

#include "drivers/scene_file.hpp"
#include "drivers/simulated_source.hpp"
#include "drivers/trajectory_file.hpp"

namespace geomap::bench {

void visit_simulation(const std::string& scene_file, const std::string& trajectory_file,
                      const FrameVisitor& visitor) {
  const drivers::Scene scene = drivers::read_scene(scene_file);
  const drivers::RayCaster caster(scene);
  const drivers::CameraTrajectory trajectory(drivers::read_robot_trajectory(trajectory_file));
  drivers::SimulationConfig config;
  config.rate = 10.0;
  config.sensor.noise = drivers::SensorNoise::kKinect;
  drivers::SimulatedSource source(scene, caster, trajectory, config);
  while (auto frame = source.next()) visitor(*std::move(frame));
}

}  // namespace geomap::bench
