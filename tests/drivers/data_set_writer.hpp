// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "geometry/rgbd_frame.hpp"

namespace geomap::testing {

/// @brief A folder of its own, gone with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// @brief A PNG as libpng writes it from rows in the file's own form: `bytes` holds height rows of
/// (width · channels · bit_depth + 7) / 8 bytes, 16-bit samples high byte first.
struct PngImage {
  int width = 0;
  int height = 0;
  int bit_depth = 8;
  int color_type = 0;  // PNG_COLOR_TYPE_...
  std::vector<std::uint8_t> bytes;
  std::vector<std::uint8_t> palette = {};    // red, green, blue of each entry
  std::vector<std::uint8_t> opacities = {};  // of the palette's entries
  bool interlaced = false;
};
void write_png(const std::filesystem::path& path, const PngImage& image);

/// @brief 16-bit grey, the values as they are.
void write_depth_png(const std::filesystem::path& path, const geometry::DepthImage& depth);
void write_color_png(const std::filesystem::path& path, const geometry::ColorImage& color);
void write_jpeg(const std::filesystem::path& path, const geometry::ColorImage& color);
void write_bytes(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes);
void write_text(const std::filesystem::path& path, const std::string& text);
std::vector<std::uint8_t> file_bytes(const std::filesystem::path& path);

/// @brief Images that differ from number to number, with both kinds of "no reading" in the depth.
geometry::DepthImage some_depth(int number, int width = 20, int height = 14);
geometry::ColorImage some_color(int number, int width = 20, int height = 14);

/// @brief A pose that turns about all axes with its number.
Eigen::Isometry3d some_pose(int number);

/// @brief The 4 x 4 matrix as 7-Scenes writes it, `digits` behind the point.
std::string pose_text(const Eigen::Matrix4d& T_world_camera, int digits = 18);

/// @brief frame-NNNNNN with the name's rest, for example ".depth.png".
std::string frame_name(int number, const std::string& rest);

/// @brief depth.png, color.jpg and pose.txt of some_depth, some_color and some_pose.
void write_seven_scenes_frame(const std::filesystem::path& folder, int number);

}  // namespace geomap::testing
