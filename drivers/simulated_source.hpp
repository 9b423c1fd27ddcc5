// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "drivers/camera_trajectory.hpp"
#include "drivers/depth_sensor_model.hpp"
#include "drivers/frame_source.hpp"
#include "drivers/ray_caster.hpp"
#include "drivers/scene.hpp"
#include "drivers/simulated_kinect.hpp"

namespace geomap::drivers {

struct SimulationConfig {
  double rate = 30.0;  // [Hz]
  DepthSensorConfig sensor;
  int seed = 1;  // of the noise

  std::vector<std::string> validate() const;
};

/// @brief Frames of a robot that drives through a scene. The same arguments give the same bytes.
class SimulatedSource : public FrameSource {
 public:
  /// @param scene and caster must outlive this object.
  /// @throws std::invalid_argument with the first message of config.validate().
  SimulatedSource(const Scene& scene, const RayCaster& caster, const CameraTrajectory& trajectory,
                  const SimulationConfig& config);

  std::optional<SourceFrame> next() override;
  std::size_t size() const override { return size_; }
  bool has_truth() const override { return true; }

  /// @brief Where the robot is when the frame is taken that next() gives.
  RobotPose pose() const;
  /// @brief How many frames were given or skipped.
  std::size_t position() const { return position_; }
  /// @brief Leaves the next frame out.
  void skip() { ++position_; }

 private:
  geometry::ColorImage shade() const;

  const Scene& scene_;
  const RayCaster& caster_;
  CameraTrajectory trajectory_;
  SimulationConfig config_;
  geometry::CameraModel camera_ = simulated_kinect();
  DepthSensorModel sensor_;
  std::size_t size_;
  std::size_t position_ = 0;
  SceneView view_;
};

}  // namespace geomap::drivers
