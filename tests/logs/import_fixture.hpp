// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "drivers/data_set_writer.hpp"
#include "geometry/rgbd_frame.hpp"
#include "logs/import.hpp"

namespace geomap::logs {

/// @brief A decoded log of an import: what each channel says, by utime.
struct ImportedLog {
  std::vector<std::string> order;  // channel of each event
  std::vector<geometry::RgbdFrame> frames;
  std::vector<std::vector<std::uint8_t>> color_bytes;
  std::map<std::int64_t, Eigen::Isometry3d> pose, truth, camera_to_body;
};

/// @brief Reads it, and expects it to be whole and its events to carry the messages' utimes.
ImportedLog read_log(const std::filesystem::path& path);

/// @brief The same rigid transform to 1e-9.
void expect_near(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b);

/// @brief A 7-Scenes folder of five frames, and its import.
class ImportTest : public ::testing::Test {
 protected:
  testing::TemporaryFolder folder_;
  const std::filesystem::path out_ = folder_ / "out.lcmlog";
  static constexpr int kFrames = 5;

  void SetUp() override {
    for (int i = 0; i < kFrames; ++i) testing::write_seven_scenes_frame(folder_.path(), i);
  }
  std::filesystem::path file(int number, const std::string& rest) const {
    return folder_ / testing::frame_name(number, rest);
  }
  ImportSummary import_with(const ImportSettings& settings);
  ImportedLog imported(const ImportSettings& settings);
  static Eigen::Isometry3d true_body_pose(int number);
};

}  // namespace geomap::logs
