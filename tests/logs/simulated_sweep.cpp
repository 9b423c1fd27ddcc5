// SPDX-License-Identifier: BSD-3-Clause
#include "logs/simulated_sweep.hpp"

#include "drivers/scene_file.hpp"
#include "drivers/sim_process.hpp"
#include "drivers/trajectory_file.hpp"
#include "messaging/config.hpp"

namespace geomap::testing {

logs::ReplayResult replay_sweep(const TemporaryFolder& folder, const std::string& scene,
                                double sigma, double rate) {
  const std::string config = GEOMAP_SOURCE_DIR "/config/";
  const drivers::CameraTrajectory sweep(
      drivers::read_robot_trajectory(config + "trajectories/sweep.yaml"));
  drivers::SimulationConfig simulation;
  simulation.rate = rate;
  simulation.sensor.sigma = sigma;
  drivers::SimProcess(drivers::read_scene(config + "scenes/" + scene + ".yaml"), sweep, simulation,
                      {})
      .record(folder / "sweep.lcmlog", [](std::size_t) { return true; });
  logs::ReplayOptions options;
  options.log = (folder / "sweep.lcmlog").string();
  options.output = folder / "out";
  options.threads = 2;
  return logs::replay(options, messaging::Config::load());
}

}  // namespace geomap::testing
