// SPDX-License-Identifier: BSD-3-Clause
#include "logs/pipeline.hpp"

#include <stdexcept>

#include "messaging/convert_frame.hpp"
#include "perception/ransac_extractor.hpp"
#include "perception/trust_prior.hpp"

namespace geomap::logs {

Pipeline::Pipeline(const PipelineConfig& config, int threads)
    : config_(config),
      threads_(static_cast<std::size_t>(threads)),
      prior_(config.prior),
      selector_(config.keyframes),
      registration_(std::make_unique<perception::TrustPrior>(config.registration)),
      extractor_(std::make_unique<perception::RansacExtractor>(config.ransac)),
      point_map_(config.point_map),
      map_(config.merge, config.history) {
  if (threads < 1) throw std::invalid_argument("threads must be at least 1");
}

void Pipeline::add_pose(std::int64_t utime, const Eigen::Isometry3d& T_odom_body) {
  prior_.add_pose(utime, T_odom_body);
  process_ready();
}

void Pipeline::add_camera_to_body(std::int64_t utime, const Eigen::Isometry3d& T_body_camera) {
  prior_.add_camera_to_body(utime, T_body_camera);
  process_ready();
}

void Pipeline::add_frame(geomap::rgbd_frame_t message) {
  ++frames_;
  prior_.note_input(message.utime);
  waiting_.push_back(std::move(message));
  process_ready();
}

void Pipeline::finish() {
  while (!waiting_.empty()) process_next();
  while (!extractions_.empty()) merge_oldest();
}

void Pipeline::process_ready() {
  while (!waiting_.empty() && prior_.is_ready(waiting_.front().utime)) {
    process_next();
  }
}

void Pipeline::process_next() {
  const geomap::rgbd_frame_t message = std::move(waiting_.front());
  waiting_.pop_front();
  process(message);
}

// One frame, in the order of the paper's section III: prior, key frame?, registration, point map,
// planes; merging follows when the planes are there.
void Pipeline::process(const geomap::rgbd_frame_t& message) {
  const perception::Prior prior = prior_.prior_at(message.utime);
  if (!prior.T_world_camera) {
    ++rejected_[std::string(perception::to_string(prior.reason))];
    return;
  }
  tracked_.emplace_back(message.utime, *prior.T_world_camera);
  if (!selector_.is_due(*prior.T_world_camera)) return;
  if (accepted_.contains(message.utime)) {
    ++rejected_["repeated_utime"];
    return;
  }

  KeyframeRecord record;
  record.id = message.utime;
  const Stopwatch decoding;
  messaging::FrameResult decoded = messaging::to_frame(message);
  record.times.decode = decoding.seconds();
  if (!decoded.frame) {
    ++rejected_[messaging::to_string(decoded.fault)];
    return;
  }
  record.pixels = static_cast<std::int64_t>(decoded.frame->depth.millimetres.size());

  const Stopwatch registering;
  const perception::RegistrationResult registered =
      registration_->align(*decoded.frame, *prior.T_world_camera);
  if (!registered.accepted) {
    ++rejected_[std::string(perception::to_string(registered.reason))];
    return;
  }
  try {
    point_map_.insert(record.id, *decoded.frame, registered.T_world_camera);
  } catch (const std::invalid_argument&) {  // farther from the origin than its numbers reach
    ++rejected_["out_of_range"];
    return;
  }
  selector_.accept(registered.T_world_camera);
  accepted_.insert(record.id);
  record.T_world_camera = registered.T_world_camera;
  record.times.registration = registering.seconds();

  start_extraction(record, std::move(*decoded.frame));
}

void Pipeline::start_extraction(KeyframeRecord record, geometry::RgbdFrame frame) {
  const Eigen::Vector3d up_camera =
      record.T_world_camera.linear().transpose() * Eigen::Vector3d::UnitZ();
  const auto seed = static_cast<std::uint64_t>(record.id);
  const auto policy = threads_ > 1 ? std::launch::async : std::launch::deferred;
  extractions_.push_back(
      {record, std::async(policy, [this, frame = std::move(frame), seed, up_camera] {
         return extractor_->extract(frame, seed, up_camera);
       })});
  while (extractions_.size() >= threads_) merge_oldest();
}

void Pipeline::merge_oldest() {
  Extraction extraction = std::move(extractions_.front());
  extractions_.pop_front();
  perception::ExtractedPlanes extracted = extraction.planes.get();
  KeyframeRecord& record = extraction.record;

  auto observation = std::make_shared<mapping::Observation>();
  observation->keyframe = record.id;
  observation->T_world_camera = record.T_world_camera;
  observation->planes = std::move(extracted.planes);

  const Stopwatch merging;
  const mapping::ApplyResult applied = map_.apply(observation);
  record.times.merging = merging.seconds();
  record.times.extraction = extracted.extraction_seconds;
  record.times.hull = extracted.hull_seconds;
  record.noise_factor = extracted.noise.factor;
  record.planes = static_cast<int>(observation->planes.size());
  record.map_features = static_cast<int>(map_.features().size());
  if (applied.fault != mapping::EventFault::kNone) {
    ++rejected_[mapping::to_string(applied.fault)];
    point_map_.remove(record.id);
    return;
  }
  keyframes_.push_back(record);
  if (listener_) listener_(record, *observation, applied.change);
}

}  // namespace geomap::logs
