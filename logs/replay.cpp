// SPDX-License-Identifier: BSD-3-Clause
#include "logs/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "drivers/camera_file.hpp"
#include "geometry/polygon.hpp"
#include "logs/git_revision.hpp"
#include "logs/growth_pictures.hpp"
#include "logs/other_file.hpp"
#include "logs/trajectory_file.hpp"
#include "mapping/export_file.hpp"
#include "mapping/export_svg.hpp"
#include "mapping/map_journal.hpp"
#include "messaging/channels.hpp"
#include "messaging/convert_geometry.hpp"
#include "messaging/log_reader.hpp"
#include "messaging/log_writer.hpp"
#include "messaging/program.hpp"
#include "messaging/progress_bar.hpp"
#include "messaging/safe_decode.hpp"
#include "messaging/stopwatch.hpp"
#include "perception/keyframe_messages.hpp"
#include "perception/point_map_messages.hpp"
#include "perception/point_map_ply.hpp"
#include "perception/sensor_messages.hpp"

namespace geomap::logs {
namespace {

namespace channels = messaging::channels;

constexpr std::int64_t kRawBytesPerPixel = 12;  // as the paper counts: three floats a point
constexpr std::int64_t kBytesPerPoint = 12;
constexpr std::int64_t kBytesPerPolygon = 16;  // four plane coefficients

void check(const ReplayOptions& options) {
  if (options.threads < 1 || options.threads > 256) {
    throw messaging::ConfigError("--threads must be between 1 and 256");
  }
  if (options.passes < 1) throw messaging::ConfigError("--loop must be at least 1");
  if (options.pictures_every < 0) {
    throw messaging::ConfigError("--pictures-every must not be negative");
  }
}

// One reading of the log from front to back.
struct Pass {
  Pass(const PipelineConfig& config, int threads, const geometry::DepthCorrection& correction)
      : pipeline(config, threads),
        input(pipeline.tracking(), {config.driver_depth.camera(), config.driver_color.camera()},
              correction) {}

  Pipeline pipeline;
  perception::SensorMessages input;
  Trajectory reference;  // TRUTH_POSE, where the log has it: for evaluation, not for the pipeline
  bool log_damaged = false;
  bool stopped = false;
  double seconds = 0.0;
};

void note_reference(const messaging::LogEvent& event, Trajectory& reference) {
  if (event.channel != channels::kTruthPose) return;
  const auto pose =
      messaging::safe_decode<bot_core::rigid_transform_t>(event.data.data(), event.data.size());
  const bool later =
      reference.empty() || (pose.message && pose.message->utime > reference.back().first);
  if (pose.message && pose.message->utime >= 0 && later) {
    reference.emplace_back(pose.message->utime, messaging::from_message(*pose.message));
  }
}

// What operators have done to the map while the log was recorded.
void replay_edits(const messaging::LogEvent& event, Pipeline& pipeline) {
  if (event.channel == channels::kMapEdit) {
    const auto edit =
        messaging::safe_decode<geomap::map_edit_t>(event.data.data(), event.data.size());
    if (edit.message) pipeline.add_edit(*edit.message);
  } else if (event.channel == channels::kMapEditReply) {
    const auto reply =
        messaging::safe_decode<geomap::map_edit_reply_t>(event.data.data(), event.data.size());
    if (reply.message) pipeline.add_edit_reply(*reply.message);
  }
}

void run(Pass& pass, const std::string& log) {
  const messaging::Stopwatch stopwatch;
  messaging::LogReader reader(log);
  messaging::ProgressBar progress("frames", 0);
  while (const auto event = reader.next()) {
    pass.input.handle(event->channel, event->data);
    replay_edits(*event, pass.pipeline);
    note_reference(*event, pass.reference);
    progress.update(pass.pipeline.frames(),
                    pass.pipeline.frames() * reader.size() / reader.position());
    if (messaging::stop_requested()) {
      pass.stopped = true;
      break;
    }
  }
  pass.pipeline.finish();
  if (!pass.stopped) progress.update(pass.pipeline.frames(), pass.pipeline.frames());
  pass.log_damaged = !reader.damages().empty();
  pass.seconds = stopwatch.seconds();
}

// Writes what registration and extraction publish, as a log that the separate mapper can be fed
// with.
class DerivedLog {
 public:
  explicit DerivedLog(const std::string& path) {
    if (!path.empty()) writer_.emplace(path);
  }
  void write(const perception::TrackedFrame& frame) {
    if (!writer_) return;
    messages_.send(frame, [this](const char* channel, std::int64_t utime, const auto& message) {
      writer_->write(channel, utime, message);
    });
  }
  // What the newest key frame has changed in the point map.
  void write_points(const perception::TrackedFrame& frame, perception::Tracker& tracker) {
    if (!writer_ || frame.tracked.status != perception::TrackStatus::kKeyframe) return;
    const perception::VoxelMap& voxels = tracker.point_map().voxels();
    for (geomap::point_map_update_t& update :
         perception::to_messages(voxels, tracker.take_changed_blocks(), false)) {
      update.utime = frame.message.utime;
      update.session = *messages_.session();
      update.sequence = ++points_sequence_;
      writer_->write(channels::kPointMap, update.utime, update);
    }
  }
  void write(const KeyframeRecord& record, const mapping::Observation& observation) {
    if (!writer_) return;
    const messaging::PlaneSet planes{record.id,           *messages_.session(),
                                     planes_sequence_++,  record.T_world_camera,
                                     record.noise_factor, observation.planes};
    writer_->write(channels::kPlanes, record.id, messaging::to_message(planes));
  }
  void close() {
    if (writer_) writer_->close();
  }

 private:
  std::optional<messaging::LogWriter> writer_;
  perception::TrackingMessages messages_;
  std::int64_t planes_sequence_ = 0;
  std::int64_t points_sequence_ = 0;
};

DataReduction reduction_of(const Pipeline& pipeline, const std::filesystem::path& map_file) {
  DataReduction reduction;
  for (const KeyframeRecord& keyframe : pipeline.keyframes()) {
    reduction.raw_bytes += kRawBytesPerPixel * keyframe.pixels;
  }
  reduction.point_map_points = static_cast<std::int64_t>(pipeline.point_map().size());
  reduction.point_map_bytes = kBytesPerPoint * reduction.point_map_points;
  for (const auto& [id, feature] : pipeline.map().features()) {
    reduction.map_vertices +=
        static_cast<std::int64_t>(geometry::vertex_count(feature->surface.polygon));
    reduction.map_bytes += kBytesPerPolygon;
  }
  reduction.map_bytes += kBytesPerPoint * reduction.map_vertices;
  reduction.map_bytes_serialised = static_cast<std::int64_t>(std::filesystem::file_size(map_file));
  return reduction;
}

std::vector<TimedPose> keyframe_poses(const Pipeline& pipeline) {
  std::vector<TimedPose> poses;
  for (const KeyframeRecord& keyframe : pipeline.keyframes()) {
    poses.emplace_back(keyframe.id, keyframe.T_world_camera);
  }
  return poses;
}

void write_results(const Pipeline& pipeline, const mapping::MapSnapshot& map,
                   const std::filesystem::path& folder) {
  mapping::save_map(folder / "map.lcmlog", pipeline.map());
  mapping::write_file(folder / "map.svg", mapping::to_svg(map));
  perception::write_ply(folder / "point_map.ply", pipeline.point_map().points());
  write_trajectory(folder / "trajectory.tum", keyframe_poses(pipeline));
  write_trajectory(folder / "trajectory_all.tum", pipeline.tracked());
}

void append_times(const Pipeline& pipeline, std::vector<StageTimes>& times) {
  for (const KeyframeRecord& keyframe : pipeline.keyframes()) times.push_back(keyframe.times);
}

}  // namespace

ReplayResult replay(const ReplayOptions& options, const messaging::Config& config) {
  check(options);
  const PipelineConfig settings = read_pipeline_config(config);
  const geometry::DepthCorrection correction =
      options.camera.empty() ? geometry::DepthCorrection()
                             : drivers::read_camera_file(options.camera).correction;
  messaging::LogReader(options.log);  // a wrong name shall not leave an empty folder behind
  require_other_file(options.log, options.log_out);
  require_other_file(options.log, options.output / "map.lcmlog");
  std::filesystem::create_directories(options.output);
  mapping::write_file(options.output / "config_used.yaml", config.to_yaml());

  Pass first(settings, options.threads, correction);
  DerivedLog derived(options.log_out);
  GrowthPictures pictures(options.pictures_every);
  first.pipeline.on_tracked([&](const perception::TrackedFrame& frame) {
    derived.write(frame);
    derived.write_points(frame, first.pipeline.tracking().tracker());
  });
  first.pipeline.on_keyframe([&](const KeyframeRecord& record,
                                 const mapping::Observation& observation,
                                 const mapping::MapChange& change) {
    derived.write(record, observation);
    pictures.note(first.pipeline.map(), change);
  });
  run(first, options.log);
  derived.close();
  const Pipeline& pipeline = first.pipeline;
  if (pipeline.frames() == 0 && !first.stopped) {
    throw std::runtime_error(options.log + " holds no readable " + channels::kRgbdFrame);
  }

  ReplayResult result;
  Report& report = result.report;
  result.stopped = first.stopped;
  report.map = mapping::snapshot_of(pipeline.map());
  report.wall_seconds = first.seconds;
  append_times(pipeline, report.times);
  for (int pass = 1; pass < options.passes && !result.stopped; ++pass) {
    Pass again(settings, options.threads, correction);
    run(again, options.log);
    if (again.stopped) break;  // the results of the first pass are whole
    append_times(again.pipeline, report.times);
    if (mapping::snapshot_of(again.pipeline.map()).hash != report.map.hash) {
      throw std::runtime_error(fmt::format("pass {} over the log gave another map", pass + 1));
    }
  }

  write_results(pipeline, report.map, options.output);
  if (!first.reference.empty()) {
    write_trajectory(options.output / "reference.tum", first.reference);
  }
  pictures.write(options.output / "pictures");
  report.log = options.log;
  report.camera = options.camera;
  report.extractor = settings.extraction.choice.extractor;
  report.merge_mode = settings.merge.mode;
  report.git_revision = kGitRevision;
  report.config_hash = config.hash();
  report.frames = pipeline.frames();
  report.edits = pipeline.edits();
  report.rejected = pipeline.rejected();
  report.refused = first.input.refused();
  report.sequence_gaps = first.input.missing_frames();
  report.log_damaged = first.log_damaged;
  report.keyframes = pipeline.keyframes();
  report.tracking = pipeline.tracker().counts();
  report.lost_at_end = pipeline.tracker().is_lost();
  report.poses = pipeline.tracker().prior().pose_counts();
  report.reduction = reduction_of(pipeline, options.output / "map.lcmlog");
  write_report(report, options.output);
  return result;
}

}  // namespace geomap::logs
