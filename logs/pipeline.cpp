// SPDX-License-Identifier: BSD-3-Clause
#include "logs/pipeline.hpp"

#include <stdexcept>

#include "mapping/edit_messages.hpp"
#include "messaging/stopwatch.hpp"
#include "perception/extractor_choice.hpp"

namespace geomap::logs {

Pipeline::Pipeline(const PipelineConfig& config, int threads)
    : config_(config),
      threads_(static_cast<std::size_t>(threads)),
      tracking_(config.tracker, [this](perception::TrackedFrame frame) { take(std::move(frame)); }),
      extractor_(perception::make_extractor(config.extraction)),
      map_(config.merge, config.history) {
  if (threads < 1) throw std::invalid_argument("threads must be at least 1");
}

void Pipeline::finish() {
  tracking_.finish();
  while (!extractions_.empty()) merge_oldest();
  while (const auto placed = logged_edits_.next_at_end()) edit(*placed);
}

void Pipeline::add_edit(const geomap::map_edit_t& message) {
  auto command = mapping::from_message(message);
  if (command && message.dry_run == 0) logged_edits_.add(std::move(*command), message.seen_utime);
}

void Pipeline::add_edit_reply(const geomap::map_edit_reply_t& message) {
  perception::Tracker& tracker = tracking_.tracker();
  for (const std::int64_t keyframe : message.dropped) tracker.remove(keyframe);
  for (const std::int64_t keyframe : message.restored) tracker.put_back(keyframe);
  logged_edits_.take_reply(message.author, message.command, message.done != 0, message.utime);
  while (const auto placed = logged_edits_.next(map_.history().newest())) edit(*placed);
}

void Pipeline::edit(const mapping::LoggedEdits::Placed& placed) {
  if (map_.edit(placed.command, placed.after).edit) ++edits_;
}

// A frame after tracking, which ends in the point map: its planes are next; merging follows when
// they are there.
void Pipeline::take(perception::TrackedFrame frame) {
  const perception::Tracked& tracked = frame.tracked;
  if (track_listener_) track_listener_(frame);
  if (!tracked.reason.empty()) ++rejected_[tracked.reason];
  if (tracked.T_world_camera) tracked_.emplace_back(frame.message.utime, *tracked.T_world_camera);
  if (tracked.status != perception::TrackStatus::kKeyframe) return;
  KeyframeRecord record{
      .id = frame.message.utime,
      .T_world_camera = *tracked.T_world_camera,
      .pixels = static_cast<std::int64_t>(frame.image->depth.millimetres.size()),
      .times = {.decode = frame.decode_seconds, .registration = frame.registration_seconds},
      .registration = *tracked.registration};
  start_extraction(std::move(record), std::move(*frame.image));
}

void Pipeline::start_extraction(KeyframeRecord record, geometry::RgbdFrame frame) {
  const std::int64_t id = record.id;
  const Eigen::Isometry3d T_world_camera = record.T_world_camera;
  const auto policy = threads_ > 1 ? std::launch::async : std::launch::deferred;
  extractions_.push_back(
      {std::move(record), std::async(policy, [this, frame = std::move(frame), id, T_world_camera] {
         return extractor_->extract_keyframe(frame, id, T_world_camera);
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

  const messaging::Stopwatch merging;
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
    tracking_.tracker().remove(record.id);
    return;
  }
  keyframes_.push_back(record);
  if (listener_) listener_(record, *observation, applied.change);
  while (const auto placed = logged_edits_.next(map_.history().newest())) edit(*placed);
}

}  // namespace geomap::logs
