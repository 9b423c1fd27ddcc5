// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/camera_model.hpp"
#include "geometry/depth_noise.hpp"
#include "geometry/rgbd_frame.hpp"

namespace geomap::drivers {

enum class SensorNoise {
  kWhite,   // the same normal noise everywhere
  kKinect,  // the known faults of a structured-light camera
};

/// @brief What a simulated depth camera does to exact depths. Defaults of kKinect: Kinect v1;
/// Nguyen, Izadi, Lovell (3DIMPVT 2012) for jitter and noise, Khoshelham, Elberink (Sensors 2012)
/// for the disparity.
struct DepthSensorConfig {
  SensorNoise noise = SensorNoise::kWhite;
  double sigma = 0.0;      // of kWhite [m]; 0: exact but for whole millimetres
  double min_range = 0.5;  // along the optical axis [m]; no reading below
  double max_range = 5.0;  // along the optical axis [m]; no reading beyond

  // Of kKinect alone:
  double lateral_sigma = 0.8;          // of the direction in which a pixel looks [pixel]
  double disparity_step = 0.125;       // [pixel]
  double focal_times_baseline = 43.9;  // disparity times depth [pixel m]
  double baseline = 0.075;             // from camera to projector, along the camera's x [m]
  double bias_at_corner = 0.01;        // share of the depth at the image's farthest corner
  double grazing_cosine = 0.1;         // incidence at which no pattern is found any more
  geometry::DepthNoise axial;          // along the optical axis

  std::vector<std::string> validate() const;
};

/// @brief What a camera without faults would measure, row by row without padding.
struct ExactDepth {
  int width = 0;
  int height = 0;
  std::vector<double> depth;  // along the optical axis [m]; 0 where nothing is hit
  std::vector<float> cosine;  // |cosine| between ray and surface normal; kWhite does not need it
};

/// @brief Turns exact depths into the readings of a depth camera.
///
/// kWhite: z + sigma N(0, 1), in whole millimetres; the exact depth decides about the range.
/// kKinect, in the order in which light and electronics do it:
///  1. lateral jitter: a pixel reads what the pixel at a normal offset of lateral_sigma sees;
///  2. shadow: nothing where a nearer surface of the same row hides the point from the projector,
///     which stands at +baseline on the camera's x axis: the shadow of an object lies at its left,
///     fx baseline (1/z_near - 1/z_far) pixels wide. What is outside the image casts none;
///  3. grazing incidence: a reading is lost with a probability that rises from 0 at twice the
///     grazing cosine to 1 at it;
///  4. a smooth bias of bias_at_corner (r / r_corner)² z, r the distance to the principal point;
///  5. normal noise of axial.sigma(z);
///  6. the disparity focal_times_baseline / z becomes a multiple of disparity_step, the depth a
///     whole millimetre; the reading decides about the range.
///
/// The same image, configuration and seed give the same bytes on every machine.
class DepthSensorModel {
 public:
  /// @throws std::invalid_argument when the camera is not valid() or config.validate() complains.
  DepthSensorModel(const geometry::CameraModel& camera, const DepthSensorConfig& config);

  /// @brief Reads one frame. The noise of a pixel depends on `seed` and on where it is, not on what
  /// other pixels see; frames of one sequence need different seeds.
  /// @throws std::invalid_argument when the image has not the camera's size.
  geometry::DepthImage read(const ExactDepth& exact, std::uint64_t seed) const;

 private:
  void read_white(const ExactDepth& exact, std::uint64_t seed,
                  std::vector<std::uint16_t>& millimetres) const;
  void read_kinect(const ExactDepth& exact, std::uint64_t seed,
                   std::vector<std::uint16_t>& millimetres) const;
  bool in_range(double z) const { return config_.min_range <= z && z <= config_.max_range; }
  double quantised(double z) const;

  geometry::CameraModel camera_;
  DepthSensorConfig config_;
  std::vector<int> jitter_;             // equally likely offsets of a pixel's line of sight [pixel]
  double bias_per_square_pixel_ = 0.0;  // share of the depth
};

}  // namespace geomap::drivers
