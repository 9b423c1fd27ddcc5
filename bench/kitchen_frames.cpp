// SPDX-License-Identifier: BSD-3-Clause
#include "kitchen_frames.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "drivers/image_file.hpp"

namespace geomap::bench {

std::vector<geometry::RgbdFrame> load_kitchen_frames(int step) {
  std::vector<geometry::RgbdFrame> frames;
  const char* root = std::getenv("GEOMAP_DATA");
  if (root == nullptr) return frames;
  const std::filesystem::path folder = std::filesystem::path(root) / "redkitchen";
  for (int number = 0;; number += step) {
    char name[64];
    std::snprintf(name, sizeof name, "frame-%06d.depth.png", number);
    if (!std::filesystem::exists(folder / name)) return frames;
    geometry::RgbdFrame& frame = frames.emplace_back();
    frame.utime = number;
    frame.depth = drivers::read_depth_png(folder / name);
    frame.depth_camera = {640, 480, 585.0, 585.0, 320.0, 240.0};
  }
}

}  // namespace geomap::bench
