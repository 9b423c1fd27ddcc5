// SPDX-License-Identifier: BSD-3-Clause
#include "posed_frames.hpp"

#include <cstdlib>
#include <filesystem>
#include <utility>

#include "drivers/seven_scenes_source.hpp"

namespace geomap::bench {

void visit_kitchen(int step, const FrameVisitor& visitor) {
  constexpr int kLast = 499;
  const char* root = std::getenv("GEOMAP_DATA");
  if (root == nullptr) return;
  const std::filesystem::path folder = std::filesystem::path(root) / "redkitchen";
  if (!std::filesystem::exists(folder)) return;
  for (int number = 0; number <= kLast; number += step) {
    auto read = drivers::SevenScenesSource(folder, {number, number}).next();
    Eigen::Isometry3d& T = read->truth_T_world_camera.value();
    T.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
    read->frame.utime = drivers::seven_scenes_utime(number);
    visitor(*std::move(read));
  }
}

std::vector<PosedFrame> load_posed_kitchen(int step) {
  std::vector<PosedFrame> frames;
  visit_kitchen(step, [&frames](drivers::SourceFrame read) {
    read.frame.color = {};
    frames.push_back({std::move(read.frame), *read.truth_T_world_camera});
  });
  return frames;
}

}  // namespace geomap::bench
