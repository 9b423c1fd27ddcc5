// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "drivers/frame_source.hpp"

namespace geomap::drivers {

/// @brief A sequence of the TUM RGB-D benchmark (Sturm et al., IROS 2012): a folder with depth.txt
/// and rgb.txt (lines `seconds file`), their images, and groundtruth.txt where it was recorded.
///
/// Depth (16-bit PNG, 5000 = 1 m) is rounded to millimetres. A frame is a depth image and the
/// colour image nearest in time, at most 20 ms away, each used once; its utime is the depth
/// image's. The truth is interpolated to that moment where the poses around it are at most 100 ms
/// apart. Intrinsics are the published ones of freiburg1, 2 and 3, known by the folder's name (the
/// innermost part of the path that holds one of these words), else ROS' default 525, 525, 319.5,
/// 239.5. Depth is registered to colour, so both cameras are one; the published lens distortion
/// (freiburg1 and 2) is not undone, and the published depth factors are in the images already.
class TumSource : public FrameSource {
 public:
  /// @param range of positions among the associated frames, from 0.
  /// @throws SourceError when the folder or one of the two lists is missing or cannot be read, or
  /// when nothing is left to deliver.
  explicit TumSource(std::filesystem::path folder, FrameRange range = {});

  std::optional<SourceFrame> next() override;
  std::size_t size() const override { return entries_.size(); }
  bool has_truth() const override { return has_truth_; }
  std::string remark() const override;

 private:
  struct Entry {
    std::int64_t utime = 0;
    std::string depth;  // file names within the folder
    std::string color;
    std::optional<Eigen::Isometry3d> truth_T_world_camera;
  };

  std::filesystem::path folder_;
  geometry::CameraModel published_;
  std::vector<Entry> entries_;
  std::size_t without_color_ = 0;  // depth images
  bool has_truth_ = false;
  std::size_t at_ = 0;
  std::int64_t delivered_ = 0;
};

/// @brief Published intrinsics [pixel, 640 x 480] of the camera that a TUM RGB-D folder's name
/// tells.
geometry::CameraModel tum_camera(const std::filesystem::path& folder);

}  // namespace geomap::drivers
