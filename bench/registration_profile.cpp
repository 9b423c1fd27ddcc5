// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cstdio>
#include <deque>
#include <utility>
#include <vector>

#include "perception/thin_frame.hpp"
#include "posed_frames.hpp"
#include "registration_bench.hpp"
#include "registration_stages.hpp"
#include "statistics.hpp"

namespace geomap::bench {
namespace {

using namespace perception;

enum Stage {
  kThinning,
  kCorrecting,
  kSurfaces,
  kSelection,
  kAlignment,
  kInsertion,
  kLearning,
  kRefreshing
};
constexpr std::array kStageNames = {"thinning",
                                    "applying the depth correction",
                                    "surfaces",
                                    "selection",
                                    "alignment",
                                    "insertion",
                                    "learning the depth correction",
                                    "refreshing old key frames"};

// The tracker's way with a key frame, step by step, its recorded pose as the prior.
class ProfiledMapping {
 public:
  explicit ProfiledMapping(const RegistrationBenchSettings& settings)
      : config_(settings.tracker),
        estimator_(config_.depth_correction),
        map_(config_.point_map),
        selector_(config_.keyframes) {}

  void add(const geometry::RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera_prior) {
    if (!selector_.is_due(T_world_camera_prior)) return;
    std::array<double, kStageNames.size()> stage{};
    FrameView view = make_view(frame, stage);
    const Eigen::Isometry3d T = align(view, T_world_camera_prior, stage);
    stage[kInsertion] = milliseconds([&] {
      SurfaceImage surfaces = view.surfaces;
      map_.insert(frame.utime, std::move(view), T);
      kept_.push_front({T, std::move(surfaces), map_.depth_correction()});
    });
    if (kept_.size() > 5) kept_.pop_back();
    selector_.accept(T);
    ++keyframes_;
    stage[kLearning] = milliseconds([&] { learn(); });
    stage[kRefreshing] = milliseconds([&] {
      refreshed_ += map_.refresh(static_cast<std::size_t>(config_.depth_correction.refresh_count),
                                 config_.depth_correction.refresh_change);
    });
    double sum = 0.0;
    for (std::size_t i = 0; i < stage.size(); ++i) {
      times_[i].push_back(stage[i]);
      sum += stage[i];
    }
    total_.push_back(sum);
  }

  void print() const {
    for (std::size_t i = 0; i < times_.size(); ++i) {
      std::printf("  %-32s %6.3f %6.3f\n", kStageNames[i], median(times_[i]),
                  quantile(times_[i], 0.95));
    }
    std::printf("  %-32s %6.3f %6.3f\n", "all of these", median(total_), quantile(total_, 0.95));
    double sum = 0.0;
    for (const double time : total_) sum += time;
    std::printf("  mean %.3f; %zu better depth corrections, %zu key frames refreshed\n",
                sum / static_cast<double>(keyframes_), corrections_, refreshed_);
    std::printf("  %zu key frames; %.0f blocks visited, %.0f surfels, %.0f iterations (medians)\n",
                keyframes_, median(blocks_), median(surfels_), median(iterations_));
  }

 private:
  struct Kept {
    Eigen::Isometry3d T_world_camera;
    SurfaceImage surfaces;
    geometry::DepthCorrection correction;
    DepthCorrectionEstimator::View view() const { return {surfaces, T_world_camera, correction}; }
  };
  using Times = std::array<double, kStageNames.size()>;

  // As PointMap::view().
  FrameView make_view(const geometry::RgbdFrame& frame, Times& stage) const {
    const auto& voxels = config_.point_map.voxels;
    const auto bytes = static_cast<std::size_t>(config_.point_map.max_keyframe_bytes);
    geometry::RgbdFrame thin, better;
    stage[kThinning] = milliseconds(
        [&] { thin = thin_frame(frame, frame.color.empty() ? bytes * 2 / 5 : bytes); });
    stage[kCorrecting] = milliseconds([&] { better = corrected(thin, map_.depth_correction()); });
    std::optional<SurfaceImage> surfaces;
    stage[kSurfaces] =
        milliseconds([&] { surfaces.emplace(better, voxels.min_depth, voxels.max_depth); });
    return {std::move(thin), std::move(better), std::move(*surfaces)};
  }

  // As IcpRegistration::align().
  Eigen::Isometry3d align(const FrameView& view, const Eigen::Isometry3d& prior, Times& stage) {
    if (map_.size() == 0) return prior;
    const IcpRegistrationConfig& config = config_.registration.icp;
    SurfelSelection selection;
    stage[kSelection] = milliseconds(
        [&] { selection = select_surfels(map_.voxels(), view, prior, config.margin); });
    Alignment found;
    stage[kAlignment] = milliseconds(
        [&] { found = perception::align(selection.surfels, view.surfaces, prior, config.icp); });
    blocks_.push_back(selection.blocks_visited);
    surfels_.push_back(static_cast<double>(selection.surfels.size()));
    iterations_.push_back(found.iterations);
    return found.T_world_camera;
  }

  // As Tracker::improve_depth_correction().
  void learn() {
    for (const std::size_t before : {1U, 2U, 4U}) {
      if (before >= kept_.size()) break;
      estimator_.add(kept_[0].view(), kept_[before].view());
    }
    if (keyframes_ < 3 || !config_.depth_correction.enabled) return;
    const geometry::DepthCorrection estimate = estimator_.estimate();
    if (geometry::DepthCorrection::largest_difference(estimate, map_.depth_correction(),
                                                      kept_[0].surfaces.camera()) <
        config_.depth_correction.least_change) {
      return;
    }
    map_.set_depth_correction(estimate);
    ++corrections_;
  }

  TrackerConfig config_;
  DepthCorrectionEstimator estimator_;
  PointMap map_;
  KeyframeSelector selector_;
  std::deque<Kept> kept_;  // newest first
  std::size_t keyframes_ = 0;
  std::size_t corrections_ = 0, refreshed_ = 0;
  std::array<std::vector<double>, kStageNames.size()> times_;
  std::vector<double> total_, blocks_, surfels_, iterations_;
};

}  // namespace

void bench_profile(const RegistrationBenchSettings& settings) {
  std::vector<PosedFrame> frames = load_posed_kitchen(1);
  if (frames.empty()) {
    std::printf("skipped: no recording 'redkitchen' under GEOMAP_DATA\n");
    return;
  }
  for (const bool colored : {false, true}) {
    ProfiledMapping mapping(settings);
    for (PosedFrame& posed : frames) {
      geometry::RgbdFrame& frame = posed.frame;
      if (colored) {
        frame.color = {frame.depth.width, frame.depth.height, {}};
        frame.color.rgb.assign(3 * frame.depth.millimetres.size(), 128);
        frame.color_camera = frame.depth_camera;
      }
      mapping.add(frame, posed.T_world_camera);
      frame.color = {};
    }
    std::printf("Key frames of the kitchen%s, by stage [ms] (median, p95)\n",
                colored ? " with a (grey) colour image" : ", depth alone");
    mapping.print();
  }
}

}  // namespace geomap::bench
