// SPDX-License-Identifier: BSD-3-Clause
#include "logs/pipeline.hpp"

#include <stdexcept>

#include "messaging/convert_frame.hpp"
#include "perception/extractor_choice.hpp"

namespace geomap::logs {

Pipeline::Pipeline(const PipelineConfig& config, int threads)
    : config_(config),
      threads_(static_cast<std::size_t>(threads)),
      tracker_(config.tracker),
      extractor_(perception::make_extractor(config.extraction)),
      map_(config.merge, config.history) {
  if (threads < 1) throw std::invalid_argument("threads must be at least 1");
}

void Pipeline::add_pose(std::int64_t utime, const Eigen::Isometry3d& T_odom_body) {
  tracker_.prior().add_pose(utime, T_odom_body);
  process_ready();
}

void Pipeline::add_camera_to_body(std::int64_t utime, const Eigen::Isometry3d& T_body_camera) {
  tracker_.prior().add_camera_to_body(utime, T_body_camera);
  process_ready();
}

void Pipeline::add_frame(geomap::rgbd_frame_t message) {
  ++frames_;
  tracker_.prior().note_input(message.utime);
  waiting_.push_back(std::move(message));
  process_ready();
}

void Pipeline::finish() {
  while (!waiting_.empty()) process_next();
  while (!extractions_.empty()) merge_oldest();
}

void Pipeline::process_ready() {
  while (!waiting_.empty() && tracker_.prior().is_ready(waiting_.front().utime)) {
    process_next();
  }
}

void Pipeline::process_next() {
  const geomap::rgbd_frame_t message = std::move(waiting_.front());
  waiting_.pop_front();
  process(message);
}

// One frame, in the order of the paper's section III: tracking, which ends in the point map, then
// planes; merging follows when the planes are there.
void Pipeline::process(const geomap::rgbd_frame_t& message) {
  KeyframeRecord record;
  record.id = message.utime;
  messaging::FrameResult decoded;
  const auto image = [&]() -> const geometry::RgbdFrame* {
    const Stopwatch decoding;
    decoded = messaging::to_frame(message);
    record.times.decode = decoding.seconds();
    return decoded.frame ? &*decoded.frame : nullptr;
  };
  const Stopwatch tracking;
  perception::Tracked tracked = tracker_.track(message.utime, image);
  record.times.registration = tracking.seconds() - record.times.decode;
  if (tracked.status == perception::TrackStatus::kNoImage) {
    tracked.reason = messaging::to_string(decoded.fault);
  }
  if (track_listener_) track_listener_(message, tracked, tracker_.prior().T_world_odom());
  if (!tracked.reason.empty()) ++rejected_[tracked.reason];
  if (tracked.T_world_camera) tracked_.emplace_back(message.utime, *tracked.T_world_camera);
  if (tracked.status != perception::TrackStatus::kKeyframe) return;
  record.T_world_camera = *tracked.T_world_camera;
  record.pixels = static_cast<std::int64_t>(decoded.frame->depth.millimetres.size());
  record.registration = *tracked.registration;
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
  record.candidates = applied.candidates;
  record.map_features = static_cast<int>(map_.features().size());
  if (applied.fault != mapping::EventFault::kNone) {
    ++rejected_[mapping::to_string(applied.fault)];
    tracker_.remove(record.id);
    return;
  }
  keyframes_.push_back(record);
  if (listener_) listener_(record, *observation, applied.change);
}

}  // namespace geomap::logs
