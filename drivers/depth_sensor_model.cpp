// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/depth_sensor_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>

#include "drivers/portable_random.hpp"
#include "drivers/projector_shadow.hpp"

namespace geomap::drivers {
namespace {

using geometry::DepthImage;

constexpr double kMaxRange = 65.0;          // [m], so that readings are not mistaken for "invalid"
constexpr double kMaxLateralSigma = 100.0;  // [pixel]

bool at_least_zero(double value) { return std::isfinite(value) && value >= 0.0; }

bool positive(double value) { return std::isfinite(value) && value > 0.0; }

// Conversion truncates in one instruction, std::round is a call: half a unit is added instead.
std::uint16_t to_millimetres(double z) {
  const double rounded = 1000.0 * z + 0.5;
  return rounded >= 1.0 && rounded < DepthImage::kInvalid ? static_cast<std::uint16_t>(rounded)
                                                          : DepthImage::kNoReading;
}

constexpr unsigned kJitterBits = 12;
constexpr std::uint64_t kJitters = std::uint64_t{1} << kJitterBits;

// Offsets in whole pixels of which each is as likely as the next: the normal distribution in equal
// parts, out to 3.7 sigma. A pixel needs two, and two quantiles a pixel would take half the time.
std::vector<int> jitter_table(double sigma) {
  std::vector<int> offsets;
  for (std::uint64_t i = 0; i < kJitters; ++i) {
    const double p = (static_cast<double>(i) + 0.5) / static_cast<double>(kJitters);
    offsets.push_back(static_cast<int>(std::floor(sigma * normal_quantile(p) + 0.5)));
  }
  return offsets;
}

double largest_square(double centre, int size) {
  const double distance = std::max(std::abs(centre), std::abs(size - 1 - centre));
  return distance * distance;
}

std::vector<std::uint8_t> find_shadows(const ExactDepth& exact, double focal_times_baseline) {
  std::vector<std::uint8_t> shadowed(exact.depth.size());
  const auto width = static_cast<std::size_t>(exact.width);
  ProjectorShadow shadow(exact.width, focal_times_baseline);
  for (std::size_t first = 0; first < shadowed.size(); first += width) {
    shadow.find(std::span(exact.depth).subspan(first, width),
                std::span(shadowed).subspan(first, width));
  }
  return shadowed;
}

}  // namespace

std::vector<std::string> DepthSensorConfig::validate() const {
  std::vector<std::string> messages;
  const auto require = [&](bool holds, const char* message) {
    if (!holds) messages.emplace_back(message);
  };
  require(at_least_zero(sigma), "sigma must be 0 or more");
  require(at_least_zero(min_range), "min_range must be 0 or more");
  require(max_range > min_range && max_range <= kMaxRange,
          "max_range must be more than min_range and at most 65 m");
  require(lateral_sigma >= 0.0 && lateral_sigma <= kMaxLateralSigma,
          "lateral_sigma must be between 0 and 100");
  require(positive(disparity_step), "disparity_step must be more than 0");
  require(positive(focal_times_baseline), "focal_times_baseline must be more than 0");
  require(at_least_zero(baseline), "baseline must be 0 or more");
  require(bias_at_corner > -1.0 && bias_at_corner < 1.0, "bias_at_corner must be within -1 and 1");
  require(at_least_zero(grazing_cosine) && grazing_cosine <= 0.5,
          "grazing_cosine must be between 0 and 0.5");
  require(at_least_zero(axial.sigma(0.0)) && at_least_zero(axial.sigma(kMaxRange)),
          "axial noise must be 0 or more");
  return messages;
}

DepthSensorModel::DepthSensorModel(const geometry::CameraModel& camera,
                                   const DepthSensorConfig& config)
    : camera_(camera), config_(config) {
  if (!camera.valid()) throw std::invalid_argument("a depth sensor needs a valid camera");
  const std::vector<std::string> messages = config.validate();
  if (!messages.empty()) throw std::invalid_argument(messages.front());
  const double corner =
      largest_square(camera.cx, camera.width) + largest_square(camera.cy, camera.height);
  jitter_ = jitter_table(config.lateral_sigma);
  bias_per_square_pixel_ = corner > 0.0 ? config.bias_at_corner / corner : 0.0;
}

DepthImage DepthSensorModel::read(const ExactDepth& exact, std::uint64_t seed) const {
  const auto pixels =
      static_cast<std::size_t>(camera_.width) * static_cast<std::size_t>(camera_.height);
  const bool kinect = config_.noise == SensorNoise::kKinect;
  if (exact.width != camera_.width || exact.height != camera_.height ||
      exact.depth.size() != pixels || (kinect && exact.cosine.size() != pixels)) {
    throw std::invalid_argument("the exact depths do not have the size of the camera's image");
  }
  DepthImage image{exact.width, exact.height,
                   std::vector<std::uint16_t>(pixels, DepthImage::kNoReading)};
  if (kinect) {
    read_kinect(exact, seed, image.millimetres);
  } else {
    read_white(exact, seed, image.millimetres);
  }
  return image;
}

void DepthSensorModel::read_white(const ExactDepth& exact, std::uint64_t seed,
                                  std::vector<std::uint16_t>& millimetres) const {
  PortableRandom random(seed);
  const bool noisy = config_.sigma > 0.0;
  for (std::size_t i = 0; i < millimetres.size(); ++i) {
    const double error = noisy ? config_.sigma * random.normal() : 0.0;
    if (in_range(exact.depth[i])) millimetres[i] = to_millimetres(exact.depth[i] + error);
  }
}

void DepthSensorModel::read_kinect(const ExactDepth& exact, std::uint64_t seed,
                                   std::vector<std::uint16_t>& millimetres) const {
  const std::vector<std::uint8_t> shadowed = find_shadows(exact, camera_.fx * config_.baseline);
  const double grazing = config_.grazing_cosine;
  PortableRandom random(seed);
  std::size_t i = 0;
  for (int v = 0; v < camera_.height; ++v) {
    for (int u = 0; u < camera_.width; ++u, ++i) {
      // Two draws a pixel, wanted or not.
      const double ahead = random.normal();
      const std::uint64_t bits = random.next();
      const int right = jitter_[bits % kJitters];
      const int down = jitter_[(bits >> kJitterBits) % kJitters];
      const double chance = static_cast<double>(bits >> (2 * kJitterBits)) * 0x1p-40;

      const int seen_u = std::clamp(u + right, 0, camera_.width - 1);
      const int seen_v = std::clamp(v + down, 0, camera_.height - 1);
      const auto seen = static_cast<std::size_t>(seen_v * camera_.width + seen_u);
      const double z = exact.depth[seen];
      if (!(z > 0.0) || shadowed[seen] != 0) continue;
      const double lost = 2.0 * grazing - static_cast<double>(exact.cosine[seen]);
      if (chance * grazing < lost) continue;

      const double x = u - camera_.cx;
      const double y = v - camera_.cy;
      const double bias = bias_per_square_pixel_ * (x * x + y * y) * z;
      const double reading = quantised(z + bias + ahead * config_.axial.sigma(z));
      if (in_range(reading)) millimetres[i] = to_millimetres(reading);
    }
  }
}

double DepthSensorModel::quantised(double z) const {
  const double unit = config_.focal_times_baseline / config_.disparity_step;  // depth of one step
  const double steps = unit / z + 0.5;
  constexpr double kMost = 1e9;  // the disparity of no distance at all
  return steps >= 1.0 && steps < kMost ? unit / static_cast<int>(steps) : 0.0;
}

}  // namespace geomap::drivers
