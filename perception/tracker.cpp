// SPDX-License-Identifier: BSD-3-Clause
#include "perception/tracker.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "geometry/angles.hpp"
#include "perception/rigid_transform.hpp"

namespace geomap::perception {
namespace {

constexpr double kLongestGuess = 0.5;  // constant velocity is continued for this long [s]
// A new key frame is compared with those 1, 2 and 4 before it: the farther apart, the more a point
// has moved over the image, and the less they share.
constexpr std::array<std::size_t, 3> kBefore = {1, 2, 4};
constexpr std::size_t kLeastKeyframes = 3;  // before a depth correction is estimated

std::unique_ptr<Registration> make_registration(const RegistrationConfig& config) {
  const auto errors = config.validate();
  if (!errors.empty()) throw std::invalid_argument("registration: " + errors.front());
  if (config.method == "icp") return std::make_unique<IcpRegistration>(config.icp);
  return std::make_unique<TrustPrior>(TrustPriorConfig{config.min_readings});
}

}  // namespace

std::vector<std::string> RegistrationConfig::validate() const {
  std::vector<std::string> errors = icp.validate();
  if (method != "icp" && method != "prior") {
    errors.push_back("method must be icp or prior, not '" + method + "'");
  }
  if (min_readings < 1) errors.push_back("min_readings must be at least 1");
  if (lost_after < 1) errors.push_back("lost_after must be at least 1");
  if (places < 1) errors.push_back("places must be at least 1");
  if (!(found_overlap >= 0.0) || !(found_overlap <= 1.0)) {
    errors.push_back("found_overlap must be between 0 and 1");
  }
  if (!(unknown_step >= 0.0)) errors.push_back("unknown_step must be 0 m or more");
  if (!(unknown_turn_deg >= 0.0)) errors.push_back("unknown_turn_deg must be 0 or more");
  return errors;
}

Tracker::Tracker(const TrackerConfig& config)
    : config_(config),
      prior_(config.prior),
      selector_(config.keyframes),
      registration_(make_registration(config.registration)),
      correction_(config.depth_correction),
      point_map_(config.point_map) {}

// One frame, in the order of the paper's section on registration.
Tracked Tracker::track(std::int64_t utime, const Image& image) {
  note_time(utime);
  const Prior prior = prior_.prior_at(utime);
  const auto start = start_of(prior, utime);
  if (!start) return {TrackStatus::kNoPrior, std::string(to_string(prior.reason)), {}, {}};
  if (start->source == PriorSource::kMeasured && !lost_ &&
      !selector_.is_due(start->T_world_camera)) {
    note_pose(utime, start->T_world_camera);
    return {TrackStatus::kTracked, {}, start->T_world_camera, {}};
  }
  if (point_map_.pose_of(utime)) return {TrackStatus::kRepeated, "repeated_utime", {}, {}};
  const geometry::RgbdFrame* frame = image();
  if (frame == nullptr) return {TrackStatus::kNoImage, {}, {}, {}};

  std::optional<FrameView> view;
  try {
    view = point_map_.view(*frame);
  } catch (const std::invalid_argument&) {  // sizes of images and camera disagree
    return {TrackStatus::kRejected, "invalid_image", {}, {}};
  }
  RegistrationResult result = register_view(*view, *start);
  if (!result.accepted) return reject(utime, *start, std::move(result));
  return take(utime, prior, std::move(*view), std::move(result));
}

std::optional<Tracker::Start> Tracker::start_of(const Prior& prior, std::int64_t utime) const {
  const bool first = keyframes_.empty();
  const bool absolute = config_.prior.kind == "localisation";
  const bool holds = absolute || first || (linked_ && breaks_ == odometry_breaks());
  // A single pose that is merely held says nothing of the motion since.
  const bool follows = first || prior.reason != PriorReason::kHeld;
  if (prior.T_world_camera && ((holds && follows) || !aligns())) {
    return Start{orthonormal(*prior.T_world_camera), PriorSource::kMeasured};
  }
  if (!aligns()) return std::nullopt;
  if (!recent_.empty()) return Start{continued_motion(utime), PriorSource::kGuessed};
  if (first && prior.reason == PriorReason::kNoPose) {
    return Start{prior_.T_body_camera_at(utime), PriorSource::kMeasured};
  }
  return std::nullopt;
}

Eigen::Isometry3d Tracker::continued_motion(std::int64_t utime) const {
  const Pose& last = recent_.back();
  if (recent_.size() < 2) return last.T_world_camera;
  const Pose& before = recent_.front();
  const auto step = static_cast<double>(last.utime - before.utime);
  const double ahead = std::min(static_cast<double>(utime - last.utime), 1e6 * kLongestGuess);
  if (step <= 0.0 || step > 1e6 * kLongestGuess || ahead <= 0.0) return last.T_world_camera;
  return orthonormal(interpolate(before.T_world_camera, last.T_world_camera, 1.0 + ahead / step));
}

RegistrationResult Tracker::register_view(const FrameView& view, const Start& start) const {
  if (lost_) return relocalise(view, start);
  RegistrationResult result =
      registration_->align(view, point_map_.voxels(), start.T_world_camera, start.source);
  if (is_new_ground(result, start)) {
    result.accepted = true;
    result.reason = RegistrationReason::kUnknownView;
  }
  return result;
}

// The map knows too little of the view to align it, and nothing speaks against the odometry.
bool Tracker::is_new_ground(const RegistrationResult& result, const Start& start) const {
  if (result.reason != RegistrationReason::kOverlapTooSmall || !result.alignment ||
      start.source != PriorSource::kMeasured || keyframes_.empty()) {
    return false;
  }
  const RegistrationConfig& limits = config_.registration;
  const Alignment& found = *result.alignment;
  if (found.partners > 0 && found.agreement < limits.icp.min_agreement) return false;
  const Eigen::Isometry3d& T_world_last = keyframes_.back().T_world_camera;
  const double step = (start.T_world_camera.translation() - T_world_last.translation()).norm();
  return step <= limits.unknown_step && angle_between(start.T_world_camera, T_world_last) <=
                                            geometry::radians(limits.unknown_turn_deg);
}

// From the start and from the poses of key frames, a few for each frame in turn, newest first. The
// best of what fits well wins.
RegistrationResult Tracker::relocalise(const FrameView& view, const Start& start) const {
  std::vector<Eigen::Isometry3d> starts = {start.T_world_camera};
  const std::size_t count = keyframes_.size();
  const auto places = std::min(static_cast<std::size_t>(config_.registration.places), count);
  const std::size_t offset = static_cast<std::size_t>(rejections_) * places;
  for (std::size_t i = 0; i < places; ++i) {
    starts.push_back(keyframes_[count - 1 - (offset + i) % count].T_world_camera);
  }
  RegistrationResult best;
  for (const Eigen::Isometry3d& T : starts) {
    RegistrationResult result =
        registration_->align(view, point_map_.voxels(), T, PriorSource::kGuessed);
    if (result.alignment && result.accepted &&
        result.alignment->overlap < config_.registration.found_overlap) {
      result.accepted = false;
      result.reason = RegistrationReason::kOverlapTooSmall;
    }
    const auto fit = [](const RegistrationResult& r) {
      return r.alignment ? r.alignment->overlap * r.alignment->agreement : -1.0;
    };
    const bool better =
        result.accepted != best.accepted ? result.accepted : fit(result) > fit(best);
    if (better) best = std::move(result);
  }
  return best;
}

Tracked Tracker::reject(std::int64_t utime, const Start& start, RegistrationResult result) {
  // A blind camera on sound odometry is not lost.
  const bool blind = result.reason == RegistrationReason::kTooFewReadings;
  if (!(blind && start.source == PriorSource::kMeasured)) ++rejections_;
  const bool lose = aligns() && !lost_ && rejections_ >= config_.registration.lost_after;
  if (lose) {
    lost_ = true;
    ++counts_.lost;
  }
  Tracked tracked{lost_ ? TrackStatus::kLost : TrackStatus::kRejected,
                  lost_ && !lose ? "lost" : std::string(to_string(result.reason)),
                  {},
                  std::move(result)};
  if (lost_) return tracked;
  const RegistrationResult& found = *tracked.registration;
  if (found.reason == RegistrationReason::kUnderconstrained && found.alignment) {
    // Constant velocity in the open directions will do for a while, but not for the map.
    tracked.T_world_camera = orthonormal(found.alignment->T_world_camera);
    note_pose(utime, *tracked.T_world_camera);
  } else if (found.reason != RegistrationReason::kInvalidPrior) {
    tracked.T_world_camera = start.T_world_camera;
  }
  return tracked;
}

Tracked Tracker::take(std::int64_t utime, const Prior& prior, FrameView view,
                      RegistrationResult result) {
  const Eigen::Isometry3d T_world_camera = orthonormal(result.T_world_camera);
  result.T_world_camera = T_world_camera;  // the one pose, also of what is published
  const bool is_keyframe = selector_.is_due(T_world_camera);
  if (is_keyframe) {
    try {
      insert(utime, std::move(view), T_world_camera);
    } catch (const std::invalid_argument&) {  // farther from the origin than its numbers reach
      return {TrackStatus::kRejected, "out_of_range", {}, std::move(result)};
    }
    selector_.accept(T_world_camera);
  }
  if (is_keyframe || lost_ || !linked_ || breaks_ != odometry_breaks()) {
    link_odometry(prior, T_world_camera);
  }
  counts_.relocalised += lost_;
  lost_ = false;
  rejections_ = 0;
  note_pose(utime, T_world_camera);
  return {is_keyframe ? TrackStatus::kKeyframe : TrackStatus::kTracked,
          {},
          T_world_camera,
          std::move(result)};
}

void Tracker::insert(std::int64_t utime, FrameView view, const Eigen::Isometry3d& T_world_camera) {
  point_map_.insert(utime, view, T_world_camera);
  keyframes_.push_back({utime, T_world_camera});
  surfaces_.push_front(
      {utime, T_world_camera, std::move(view.surfaces), point_map_.depth_correction()});
  if (surfaces_.size() > kBefore.back() + 1) surfaces_.pop_back();
  if (aligns() && config_.depth_correction.enabled) improve_depth_correction();
}

void Tracker::improve_depth_correction() {
  const auto view_of = [](const KeyframeSurfaces& kept) {
    return DepthCorrectionEstimator::View{kept.surfaces, kept.T_world_camera, kept.correction};
  };
  const KeyframeSurfaces& newest = surfaces_.front();
  for (const std::size_t before : kBefore) {
    if (before >= surfaces_.size()) break;
    correction_.add(view_of(newest), view_of(surfaces_[before]));
  }
  if (keyframes_.size() < kLeastKeyframes) return;
  const geometry::DepthCorrection estimate = correction_.estimate();
  if (geometry::DepthCorrection::largest_difference(estimate, point_map_.depth_correction(),
                                                    newest.surfaces.camera()) >=
      config_.depth_correction.least_change) {
    point_map_.set_depth_correction(estimate);
    ++counts_.corrections;
  }
  counts_.refreshed += static_cast<std::int64_t>(
      point_map_.refresh(static_cast<std::size_t>(config_.depth_correction.refresh_count),
                         config_.depth_correction.refresh_change));
}

bool Tracker::remove(std::int64_t keyframe) {
  const geometry::RgbdFrame* thin = point_map_.thin_frame_of(keyframe);
  if (thin == nullptr) return false;
  removed_.insert_or_assign(keyframe, RemovedKeyframe{*thin, *point_map_.pose_of(keyframe)});
  const auto is_it = [&](const auto& entry) { return entry.id == keyframe; };
  std::erase_if(surfaces_, is_it);
  std::erase_if(keyframes_, [&](const Pose& pose) { return pose.utime == keyframe; });
  return point_map_.remove(keyframe);
}

bool Tracker::put_back(std::int64_t keyframe) {
  const auto found = removed_.find(keyframe);
  if (found == removed_.end()) return false;
  const auto& [thin, T_world_camera] = found->second;
  point_map_.insert(keyframe, thin, T_world_camera);
  const auto later = std::find_if(keyframes_.begin(), keyframes_.end(),
                                  [&](const Pose& pose) { return pose.utime > keyframe; });
  keyframes_.insert(later, {keyframe, T_world_camera});
  removed_.erase(found);
  return true;
}

void Tracker::restore(std::int64_t keyframe, const geometry::RgbdFrame& thin,
                      const Eigen::Isometry3d& T_world_camera) {
  insert(keyframe, point_map_.view(thin), T_world_camera);
  selector_.accept(T_world_camera);
  note_time(keyframe);
  note_pose(keyframe, T_world_camera);
}

void Tracker::restore_odometry(const Eigen::Isometry3d& T_world_odom) {
  prior_.set_T_world_odom(T_world_odom);
  linked_ = true;
}

void Tracker::clear() {
  surfaces_.clear();
  keyframes_.clear();
  removed_.clear();
  point_map_.clear();
  selector_.reset();
  lost_ = false;
  rejections_ = 0;
}

void Tracker::note_time(std::int64_t utime) {
  if (last_utime_ && utime < *last_utime_) ++counts_.time_went_back;
  last_utime_ = utime;
}

void Tracker::note_pose(std::int64_t utime, const Eigen::Isometry3d& T_world_camera) {
  if (!recent_.empty() && utime <= recent_.back().utime) recent_.clear();
  recent_.push_back({utime, T_world_camera});
  if (recent_.size() > 2) recent_.pop_front();
}

std::int64_t Tracker::odometry_breaks() const {
  return prior_.pose_counts().jumps + prior_.pose_counts().restarts;
}

void Tracker::link_odometry(const Prior& prior, const Eigen::Isometry3d& T_world_camera) {
  if (!prior.T_odom_camera) return;
  const bool is_new = !linked_ || breaks_ != odometry_breaks();
  if (is_new && keyframes_.size() > 1) ++counts_.relinked;
  prior_.set_T_world_odom(orthonormal(T_world_camera * prior.T_odom_camera->inverse()));
  linked_ = true;
  breaks_ = odometry_breaks();
}

}  // namespace geomap::perception
