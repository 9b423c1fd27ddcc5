// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "drivers/frame_source.hpp"

namespace geomap::drivers {

/// @brief utime of frame file number `i` [us]: 10^15 + round(i 10^6 / 30), as 7-Scenes has no
/// stamps.
std::int64_t seven_scenes_utime(std::int64_t i);

/// @brief A 7-Scenes sequence (Shotton et al., CVPR 2013): a folder of frame-NNNNNN.depth.png
/// (16-bit, millimetres), .color.jpg or .color.png, and .pose.txt (4 x 4, T_world_camera).
///
/// Intrinsics come from camera-intrinsics.txt (3 x 3, for images of the size that is there), else
/// they are the published 585, 585, 320, 240 of 640 x 480. Colour and depth of this data set are
/// not registered, and the colour camera's calibration was never published: it is given depth's. A
/// frame without pose file has no truth. A folder without any colour image gives frames without
/// colour; one image missing among others is an error of that frame.
class SevenScenesSource : public FrameSource {
 public:
  /// @param range of the file numbers NNNNNN.
  /// @throws SourceError when the folder is missing, holds no such files, or none within `range`,
  /// or when its intrinsics cannot be used.
  explicit SevenScenesSource(std::filesystem::path folder, FrameRange range = {});

  std::optional<SourceFrame> next() override;
  std::size_t size() const override { return files_.size(); }
  bool has_truth() const override { return has_truth_; }

 private:
  struct Files {
    std::int64_t number = 0;
    std::string stem;   // frame-NNNNNN
    std::string color;  // file name, empty where there is none
    bool depth = false;
    bool pose = false;
  };
  static std::vector<Files> list(const std::filesystem::path& folder);  // by number
  geometry::CameraModel depth_camera(const geometry::DepthImage& depth) const;

  std::filesystem::path folder_;
  std::vector<Files> files_;        // by number
  std::vector<double> intrinsics_;  // 3 x 3, row by row; empty: the published ones
  bool has_color_ = false;
  bool has_truth_ = false;
  std::size_t at_ = 0;
  std::int64_t delivered_ = 0;
};

}  // namespace geomap::drivers
