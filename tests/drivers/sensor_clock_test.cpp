// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/sensor_clock.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

namespace geomap::drivers {
namespace {

constexpr std::int64_t kPeriod = 33'333;                // between two images [us]
constexpr std::int64_t kEpoch = 1'700'000'000'000'000;  // host's clock at the start [us]

/// A camera whose images arrive 5 ms late, or up to 25 ms later still.
class Camera {
 public:
  explicit Camera(double drift = 0.0) : drift_(drift) {}

  /// The next image's error [us] against the earliest that it could arrive.
  std::int64_t next_error() {
    true_time_ += kPeriod;
    const auto sensor =
        static_cast<std::int64_t>(static_cast<double>(true_time_) * (1.0 + drift_)) + sensor_step_;
    const std::int64_t earliest = kEpoch + host_step_ + true_time_ + 5'000;
    const std::int64_t host = clock_.to_host(sensor, earliest + jitter_(random_));
    EXPECT_GT(host, last_);
    last_ = host;
    return host - earliest;
  }
  /// The largest error of some images.
  std::int64_t greatest_error(int images) {
    std::int64_t greatest = 0;
    for (int i = 0; i < images; ++i) greatest = std::max(greatest, std::abs(next_error()));
    return greatest;
  }
  void step_sensor(std::int64_t step) { sensor_step_ += step; }
  void step_host(std::int64_t step) { host_step_ += step; }
  std::int64_t restarts() const { return clock_.restarts(); }

 private:
  SensorClock clock_;
  double drift_;
  std::mt19937 random_{7};
  std::uniform_int_distribution<std::int64_t> jitter_{0, 25'000};
  std::int64_t true_time_ = 0, sensor_step_ = 0, host_step_ = 0, last_ = 0;
};

TEST(SensorClock, TheJitterOfArrivalsDoesNotShow) {
  Camera camera;
  camera.greatest_error(60);
  EXPECT_LT(camera.greatest_error(3000), 3'000);
}

TEST(SensorClock, ADriftOf100PpmIsFollowedForTenMinutes) {
  for (const double drift : {1e-4, -1e-4}) {
    Camera camera(drift);
    camera.greatest_error(60);
    EXPECT_LT(camera.greatest_error(18'000), 4'000) << drift;
  }
}

TEST(SensorClock, ASensorClockThatWrapsIsAnchoredAnew) {
  Camera camera;
  camera.greatest_error(300);
  camera.step_sensor(-8'000'000);
  EXPECT_LT(camera.greatest_error(60), 40'000);
  EXPECT_EQ(camera.restarts(), 1);
  EXPECT_LT(camera.greatest_error(300), 3'000);
}

TEST(SensorClock, ASensorClockThatJumpsAheadIsCaughtAtOnce) {
  Camera camera;
  camera.greatest_error(300);
  camera.step_sensor(60'000'000);
  camera.next_error();
  camera.greatest_error(200);
  EXPECT_LT(camera.greatest_error(300), 3'000);
}

TEST(SensorClock, AHostClockThatIsSetForwardIsFollowedWithinFourSeconds) {
  Camera camera;
  camera.greatest_error(300);
  camera.step_host(3'600'000'000);
  camera.greatest_error(130);
  EXPECT_LT(camera.greatest_error(300), 3'000);
}

TEST(SensorClock, AHostClockThatIsSetBackIsCaughtUpWithAndTimeNeverGoesBack) {
  Camera camera;
  camera.greatest_error(300);
  camera.step_host(-1'000'000);
  EXPECT_GT(camera.next_error(), 900'000);
  camera.greatest_error(70);
  EXPECT_LT(camera.greatest_error(300), 3'000);
}

}  // namespace
}  // namespace geomap::drivers
