// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/simulated_source.hpp"

#include <cmath>
#include <stdexcept>

namespace geomap::drivers {
namespace {

constexpr std::int64_t kStart = 1'000'000'000'000'000;  // [us]

double time_of(std::size_t frame, double rate) { return static_cast<double>(frame) / rate; }

const SimulationConfig& checked(const SimulationConfig& config) {
  const std::vector<std::string> messages = config.validate();
  if (!messages.empty()) throw std::invalid_argument(messages.front());
  return config;
}

}  // namespace

std::vector<std::string> SimulationConfig::validate() const {
  std::vector<std::string> messages = sensor.validate();
  if (!(rate > 0.0 && rate <= 1000.0)) messages.push_back("rate must be above 0, at most 1000 Hz");
  if (seed < 0) messages.push_back("seed must be 0 or more");
  return messages;
}

SimulatedSource::SimulatedSource(const Scene& scene, const RayCaster& caster,
                                 const CameraTrajectory& trajectory, const SimulationConfig& config)
    : scene_(scene),
      caster_(caster),
      trajectory_(trajectory),
      config_(checked(config)),
      sensor_(camera_, config.sensor),
      size_(static_cast<std::size_t>(std::floor(trajectory.duration() * config.rate + 1e-9)) + 1) {}

RobotPose SimulatedSource::pose() const { return trajectory_.at(time_of(position_, config_.rate)); }

std::optional<SourceFrame> SimulatedSource::next() {
  if (position_ >= size_) return std::nullopt;
  const RobotPose pose_now = pose();
  const double time = time_of(position_, config_.rate);
  SourceFrame result;
  result.origin = scene_.name + " at " + std::to_string(time) + " s";
  result.T_body_camera = pose_now.T_body_camera;
  result.truth_T_world_camera = pose_now.T_world_body * pose_now.T_body_camera;
  caster_.cast(camera_, *result.truth_T_world_camera, view_);

  geometry::RgbdFrame& frame = result.frame;
  frame.utime = kStart + std::llround(1e6 * time);
  frame.sequence = static_cast<std::int64_t>(position_);
  frame.sensor = "simulated-kinect";
  const std::uint64_t noise_seed =
      (static_cast<std::uint64_t>(config_.seed) << 32U) + static_cast<std::uint64_t>(position_);
  frame.depth = sensor_.read(view_.depth, noise_seed);
  frame.color = shade();
  frame.depth_camera = camera_;
  frame.color_camera = camera_;
  ++position_;
  return result;
}

// As if a lamp stood beside the camera.
geometry::ColorImage SimulatedSource::shade() const {
  geometry::ColorImage image;
  image.width = camera_.width;
  image.height = camera_.height;
  image.rgb.resize(3 * view_.triangle.size());
  for (std::size_t i = 0; i < view_.triangle.size(); ++i) {
    if (view_.triangle[i] < 0) continue;
    const auto& triangle = scene_.triangles[static_cast<std::size_t>(view_.triangle[i])];
    const Rgb& color = scene_.surfaces[triangle.surface].color;
    const float light = 0.4F + 0.6F * view_.depth.cosine[i];
    for (std::size_t c = 0; c < 3; ++c) {
      image.rgb[3 * i + c] = static_cast<std::uint8_t>(light * static_cast<float>(color[c]));
    }
  }
  return image;
}

}  // namespace geomap::drivers
