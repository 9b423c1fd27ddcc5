// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "geometry/angles.hpp"
#include "pcl_registration.hpp"
#include "perception/icp_registration.hpp"
#include "perception/rigid_transform.hpp"
#include "posed_frames.hpp"
#include "registration_bench.hpp"
#include "statistics.hpp"

namespace geomap::bench {
namespace {

constexpr double kDisturbance = 0.05, kDisturbanceDeg = 3.0;  // [m]
constexpr double kFailure = 0.10, kFailureDeg = 5.0;          // [m]

// Uniform on the sphere, from the generator's bits alone: the same on every machine.
Eigen::Vector3d random_direction(std::mt19937_64& random) {
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const double z = 2.0 * uniform() - 1.0, longitude = 2.0 * std::numbers::pi * uniform();
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(longitude), r * std::sin(longitude), z};
}

Eigen::Isometry3d disturbed(const Eigen::Isometry3d& T, std::size_t pair, int seed) {
  std::mt19937_64 random(static_cast<std::uint64_t>(seed) * 1'000'003U + pair);
  Eigen::Isometry3d off = Eigen::Isometry3d::Identity();
  off.translation() = kDisturbance * random_direction(random);
  off.linear() = Eigen::AngleAxisd(geometry::radians(kDisturbanceDeg), random_direction(random))
                     .toRotationMatrix();
  Eigen::Isometry3d result = T * off;
  result.linear() = Eigen::Quaterniond(result.linear()).normalized().toRotationMatrix();
  return result;
}

struct Outcome {
  std::optional<Eigen::Isometry3d> T_target_source;
  std::string remark;
  std::vector<double> stages;  // [ms]
  bool fully_observed = true;  // nothing of the pose is left to the guess
};

struct Method {
  const char* name;
  std::array<const char*, 4> stages;
  std::vector<double> centimetres = {}, degrees = {}, total = {};
  std::vector<std::vector<double>> times = {};  // of each stage
  std::vector<std::string> failures = {};
  std::size_t partly_observed = 0;

  void add(const Outcome& outcome, const Eigen::Isometry3d& truth, const std::string& which) {
    double sum = 0.0;
    times.resize(outcome.stages.size());
    for (std::size_t i = 0; i < outcome.stages.size(); ++i) {
      times[i].push_back(outcome.stages[i]);
      sum += outcome.stages[i];
    }
    total.push_back(sum);
    partly_observed += outcome.fully_observed ? 0 : 1;
    if (!outcome.T_target_source) {
      failures.push_back(which + outcome.remark);
      return;
    }
    const double off = (outcome.T_target_source->translation() - truth.translation()).norm();
    const double turned =
        geometry::degrees(perception::angle_between(*outcome.T_target_source, truth));
    centimetres.push_back(100.0 * off);
    degrees.push_back(turned);
    if (off > kFailure || turned > kFailureDeg) {
      char error[64];
      std::snprintf(error, sizeof error, ": off by %.1f cm, %.1f deg; ", 100.0 * off, turned);
      failures.push_back(which + error + outcome.remark);
    }
  }
};

// The map holds the target frame; what is timed is all that a key frame costs.
Outcome run_ours(const RegistrationBenchSettings& settings, const PosedFrame& target,
                 const PosedFrame& source, const Eigen::Isometry3d& guess,
                 const geometry::DepthCorrection& correction) {
  using namespace perception;
  const IcpRegistration registration(settings.tracker.registration.icp);
  PointMap map(settings.tracker.point_map);
  map.set_depth_correction(correction);
  map.insert(target.frame.utime, target.frame, Eigen::Isometry3d::Identity());
  std::optional<FrameView> view;
  RegistrationResult result;
  Outcome outcome;
  outcome.stages.push_back(milliseconds([&] { view = map.view(source.frame); }));
  outcome.stages.push_back(milliseconds(
      [&] { result = registration.align(*view, map.voxels(), guess, PriorSource::kMeasured); }));
  outcome.stages.push_back(milliseconds(
      [&] { map.insert(source.frame.utime, std::move(*view), result.T_world_camera); }));
  outcome.remark = std::string(to_string(result.reason));
  if (result.alignment) {
    char fit[128];
    std::snprintf(fit, sizeof fit,
                  ": rms %.1f mm, overlap %.2f, agreement %.2f, %d directions, %d iterations",
                  1e3 * result.alignment->rms, result.alignment->overlap,
                  result.alignment->agreement, result.alignment->observed_directions,
                  result.alignment->iterations);
    outcome.remark += fit;
  }
  outcome.fully_observed = result.alignment && result.alignment->observed_directions == 6;
  if (result.accepted) outcome.T_target_source = result.T_world_camera;
  return outcome;
}

// What the tracker learns of the camera on its own, from the frames alone.
geometry::DepthCorrection learnt_correction(const RegistrationBenchSettings& settings) {
  perception::Tracker tracker(settings.tracker);
  for (const PosedFrame& posed : load_posed_kitchen(1)) {
    tracker.track(posed.frame.utime, [&] { return &posed.frame; });
  }
  return tracker.point_map().depth_correction();
}

// As in a stream, where the target was made ready when it was the source.
Outcome run_pcl(PclMethod method, const PosedFrame& target, const PosedFrame& source,
                const Eigen::Isometry3d& guess) {
  const PclFrame onto(target.frame, method);
  std::optional<PclFrame> from;
  Outcome outcome;
  outcome.stages.push_back(milliseconds([&] { from.emplace(source.frame, method); }));
  outcome.stages.push_back(
      milliseconds([&] { outcome.T_target_source = pcl_align(*from, onto, guess); }));
  if (!outcome.T_target_source) outcome.remark = "not converged";
  return outcome;
}

void print(const std::vector<Method>& methods) {
  std::printf("%-20s %5s  %11s  %11s  %5s  %13s  %s\n", "", "runs", "error [cm]", "error [deg]",
              "fail", "time [ms]", "median time by stage [ms]");
  for (const Method& method : methods) {
    if (method.total.empty()) continue;
    std::printf("%-20s %5zu  %5.2f %5.2f  %5.3f %5.2f  %5zu  %6.2f %6.2f ", method.name,
                method.total.size(), median(method.centimetres), quantile(method.centimetres, 0.95),
                median(method.degrees), quantile(method.degrees, 0.95), method.failures.size(),
                median(method.total), quantile(method.total, 0.95));
    for (std::size_t i = 0; i < method.times.size(); ++i) {
      std::printf(" %s %.2f", method.stages[i], median(method.times[i]));
    }
    if (&method != &methods.front()) {
      std::printf("  (%.1f x ours)", median(method.total) / median(methods.front().total));
    }
    std::printf("\n");
  }
  for (const Method& method : methods) {
    if (method.partly_observed > 0) {
      std::printf("%s: in %zu runs a part of the pose is left to the start\n", method.name,
                  method.partly_observed);
    }
    for (const std::string& failure : method.failures) {
      std::printf("failed: %s %s\n", method.name, failure.c_str());
    }
  }
}

}  // namespace

void bench_pairs(const RegistrationBenchSettings& settings) {
  const std::vector<PosedFrame> frames = load_posed_kitchen(settings.step);
  if (frames.empty()) {
    std::printf("skipped: no recording 'redkitchen' under GEOMAP_DATA\n");
    return;
  }
  constexpr std::array kPcl = {PclMethod::kGicp, PclMethod::kPointToPlane,
                               PclMethod::kPointToPoint};
  std::vector<Method> methods = {{"ours", {"view", "align", "insert", ""}},
                                 {"ours, depth learnt", {"view", "align", "insert", ""}},
                                 {"PCL GICP", {"prepare", "align", "", ""}},
                                 {"PCL point to plane", {"prepare", "align", "", ""}},
                                 {"PCL point to point", {"prepare", "align", "", ""}}};
  const geometry::DepthCorrection correction = learnt_correction(settings);
  for (int seed = 1; seed <= settings.seeds; ++seed) {
    for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
      const PosedFrame &target = frames[i], &source = frames[i + 1];
      const Eigen::Isometry3d truth = target.T_world_camera.inverse() * source.T_world_camera;
      const Eigen::Isometry3d guess = disturbed(truth, i, seed);
      const std::string which =
          "seed " + std::to_string(seed) + ", pair " + std::to_string(i) + ": ";
      methods[0].add(run_ours(settings, target, source, guess, {}), truth, which);
      methods[1].add(run_ours(settings, target, source, guess, correction), truth, which);
      for (std::size_t k = 0; seed <= settings.pcl_seeds && k < kPcl.size(); ++k) {
        methods[k + 2].add(run_pcl(kPcl[k], target, source, guess), truth, which);
      }
    }
  }
  std::printf("Pairs of kitchen frames %d apart, start 5 cm and 3 degrees off (median, p95)\n",
              settings.step);
  print(methods);
}

}  // namespace geomap::bench
