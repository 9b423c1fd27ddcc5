// SPDX-License-Identifier: BSD-3-Clause
#include "logs/import.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <utility>
#include <vector>

#include "drivers/frame_messages.hpp"
#include "messaging/convert_geometry.hpp"
#include "messaging/log_writer.hpp"
#include "messaging/part_file.hpp"

namespace geomap::logs {
namespace {

namespace fs = std::filesystem;

// The smallest rotation that turns `up` into +z.
Eigen::Isometry3d upright(const std::optional<Eigen::Vector3d>& up) {
  Eigen::Isometry3d T_world_dataset = Eigen::Isometry3d::Identity();
  if (!up) return T_world_dataset;
  if (!up->allFinite() || up->norm() < 1e-6) throw std::invalid_argument("up is no direction");
  T_world_dataset.linear() =
      Eigen::Quaterniond::FromTwoVectors(*up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return T_world_dataset;
}

ImportPrior choose_prior(const drivers::FrameSource& source, const ImportSettings& settings) {
  const bool has_truth = source.has_truth();
  if (!settings.prior) return has_truth ? ImportPrior::kTruth : ImportPrior::kNone;
  if (*settings.prior != ImportPrior::kNone && !has_truth) {
    throw std::runtime_error("the prior '" + to_string(*settings.prior) +
                             "' needs true poses, and there are none for these frames");
  }
  return *settings.prior;
}

// Writes frames one by one and keeps count.
class Importer {
 public:
  Importer(const drivers::FrameSource& source, const ImportSettings& settings,
           messaging::LogWriter& log)
      : has_truth_(source.has_truth()),
        T_world_dataset_(upright(settings.up)),
        drift_(settings.drift),
        log_(log) {
    summary_.prior = choose_prior(source, settings);
  }

  void add(drivers::SourceFrame source_frame) {
    if (source_frame.truth_T_world_camera) {
      source_frame.truth_T_world_camera = T_world_dataset_ * *source_frame.truth_T_world_camera;
    } else if (has_truth_ && summary_.frames == 0) {
      ++summary_.frames_before_truth;
      return;
    }
    drivers::FrameMessages messages = drivers::to_messages(source_frame, {});
    messages.frame.sequence =
        static_cast<std::int64_t>(summary_.frames);  // what is left out is no loss
    const std::int64_t utime = source_frame.frame.utime;
    if (const auto T_world_body = prior(source_frame)) {
      messages.pose = messaging::to_pose(utime, *T_world_body);
    }
    messages.send([&](const char* channel, std::int64_t stamp, const auto& message) {
      log_.write(channel, stamp, message);
    });
    count(utime, source_frame.truth_T_world_camera,
          static_cast<std::size_t>(messages.frame.getEncodedSize()));
  }

  void add_bad(const drivers::SourceError& error) {
    if (summary_.frames_bad++ == 0) summary_.first_bad = error.what();
  }

  ImportSummary summary() const {
    ImportSummary result = summary_;
    std::vector<std::size_t> sizes = message_sizes_;
    if (!sizes.empty()) {
      const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
      std::nth_element(sizes.begin(), middle, sizes.end());
      result.median_message = *middle;
      result.largest_message = *std::max_element(sizes.begin(), sizes.end());
    }
    result.duration = 1e-6 * static_cast<double>(last_utime_ - first_utime_);
    return result;
  }

 private:
  // What POSE says at this frame, if anything.
  std::optional<Eigen::Isometry3d> prior(const drivers::SourceFrame& source_frame) {
    const bool first = summary_.frames == 0;
    if (!source_frame.truth_T_world_camera) {
      return first ? std::optional(T_world_dataset_)
                   : std::nullopt;  // no poses: world = first body
    }
    const Eigen::Isometry3d T_world_body =
        *source_frame.truth_T_world_camera * drivers::camera_mount_of(source_frame).inverse();
    switch (summary_.prior) {
      case ImportPrior::kTruth:
        return T_world_body;
      case ImportPrior::kDrift:
        return drift_.next(T_world_body);
      case ImportPrior::kNone:
        break;
    }
    return first ? std::optional(T_world_body) : std::nullopt;
  }

  void count(std::int64_t utime, const std::optional<Eigen::Isometry3d>& T_world_camera,
             std::size_t message_size) {
    if (summary_.frames++ == 0) first_utime_ = utime;
    last_utime_ = utime;
    message_sizes_.push_back(message_size);
    if (!T_world_camera) {
      ++summary_.frames_without_truth;
      return;
    }
    const Eigen::Vector3d position = T_world_camera->translation();
    if (last_position_) summary_.path_length += (position - *last_position_).norm();
    last_position_ = position;
  }

  const bool has_truth_;
  const Eigen::Isometry3d T_world_dataset_;
  drivers::OdometryDrift drift_;
  messaging::LogWriter& log_;
  ImportSummary summary_;
  std::int64_t first_utime_ = 0;
  std::int64_t last_utime_ = 0;
  std::optional<Eigen::Vector3d> last_position_;
  std::vector<std::size_t> message_sizes_;
};

std::string counted(std::size_t count, const std::string& what) {
  return count == 0 ? "" : "; " + std::to_string(count) + " " + what;
}

}  // namespace

std::string to_string(ImportPrior prior) {
  switch (prior) {
    case ImportPrior::kNone:
      return "none";
    case ImportPrior::kTruth:
      return "truth";
    case ImportPrior::kDrift:
      return "drift";
  }
  throw std::invalid_argument("unknown ImportPrior");
}

ImportSummary import_frames(drivers::FrameSource& source, const ImportSettings& settings,
                            const std::string& out,
                            const std::function<bool(std::size_t done)>& proceed) {
  messaging::PartFile part(out);
  messaging::LogWriter log(part.name());
  Importer importer(source, settings, log);
  for (std::size_t done = 0;; ++done) {
    if (!proceed(done)) {
      ImportSummary summary = importer.summary();
      summary.stopped = true;
      return summary;
    }
    try {
      std::optional<drivers::SourceFrame> frame = source.next();
      if (!frame) break;
      importer.add(std::move(*frame));
    } catch (const drivers::SourceError& error) {
      if (!settings.skip_bad) throw;
      importer.add_bad(error);
    }
  }
  ImportSummary summary = importer.summary();
  if (summary.frames == 0) {
    throw std::runtime_error(
        "no frame to import" +
        (summary.first_bad.empty() ? std::string() : "; the first one: " + summary.first_bad));
  }
  log.close();
  summary.log_bytes = fs::file_size(part.name());
  part.keep();
  return summary;
}

std::string to_string(const ImportSummary& summary) {
  char text[256];
  std::snprintf(text, sizeof text,
                "%zu frames, %.2f s, %.1f MB (frame messages: median %.0f kB, largest %.0f kB), ",
                summary.frames, summary.duration, 1e-6 * static_cast<double>(summary.log_bytes),
                1e-3 * static_cast<double>(summary.median_message),
                1e-3 * static_cast<double>(summary.largest_message));
  std::string line = text;
  if (summary.frames_without_truth == summary.frames) {
    line += "no true poses";
  } else {
    std::snprintf(text, sizeof text, "path %.2f m", summary.path_length);
    line += text + counted(summary.frames_without_truth, "frames without a true pose");
  }
  line += "; prior: " + to_string(summary.prior);
  line += counted(summary.frames_before_truth, "frames before the first pose left out");
  line +=
      counted(summary.frames_bad, "unreadable frames left out, the first: " + summary.first_bad);
  return line;
}

}  // namespace geomap::logs
