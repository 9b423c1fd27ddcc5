// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "drivers/frame_source.hpp"
#include "drivers/odometry_drift.hpp"

namespace geomap::logs {

/// @brief What an imported log says on POSE.
enum class ImportPrior {
  kNone,   // one pose at the first frame: the map is in the data set's world
  kTruth,  // the data set's own poses
  kDrift   // an odometry made from them, exact at the first frame
};

std::string to_string(ImportPrior prior);

struct ImportSettings {
  std::optional<ImportPrior> prior;    // default: truth where the source has it, else none
  drivers::OdometryDriftConfig drift;  // used by kDrift
  std::optional<Eigen::Vector3d> up;   // direction in the data set's world that becomes +z
  bool skip_bad = false;               // leave out and count frames that cannot be read
};

/// @brief What went into the log.
struct ImportSummary {
  bool stopped = false;  // by `proceed`: nothing was written
  ImportPrior prior = ImportPrior::kNone;
  std::size_t frames = 0;
  std::size_t frames_bad = 0;            // skipped, as ImportSettings::skip_bad says
  std::string first_bad;                 // why the first of them was
  std::size_t frames_before_truth = 0;   // left out: no pose tells where they are
  std::size_t frames_without_truth = 0;  // kept, later, without POSE and TRUTH_POSE
  double duration = 0.0;                 // from the first frame to the last [s]
  double path_length = 0.0;              // of the true positions [m]
  std::uintmax_t log_bytes = 0;
  std::size_t largest_message = 0;  // RGBD_FRAME [byte]
  std::size_t median_message = 0;   // RGBD_FRAME [byte]
};

/// @brief Writes a source's frames as an LCM log: for each frame CAMERA_TO_BODY, TRUTH_POSE, POSE
/// and RGBD_FRAME with the frame's utime as time stamp, in this order.
///
/// The body is the camera's position with the axes x forward, z up (drivers::forward_camera_mount),
/// so POSE = T_world_camera T_camera_body. Frames before the first one with a pose are left out
/// where the source has poses: they would start the map at a place nobody knows. A source without
/// poses has the first body frame as its world.
///
/// `out` is replaced only when all is written: until then there is `out`.part, removed on failure.
///
/// @param proceed called before each frame with the number of frames done; false stops the import.
/// @throws drivers::SourceError for a frame that cannot be read (unless settings.skip_bad);
/// std::runtime_error, one line, when the prior needs poses that the source lacks, no frame is
/// left, or the log cannot be written; std::invalid_argument for an `up` that is no direction, or a
/// bad drift.
ImportSummary import_frames(drivers::FrameSource& source, const ImportSettings& settings,
                            const std::string& out,
                            const std::function<bool(std::size_t done)>& proceed);

/// @brief The summary in one line for people.
std::string to_string(const ImportSummary& summary);

}  // namespace geomap::logs
