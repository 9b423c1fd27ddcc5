// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/tum_source.hpp"

#include <algorithm>
#include <utility>

#include "drivers/data_set_frame.hpp"
#include "drivers/image_file.hpp"
#include "drivers/tum_files.hpp"

namespace geomap::drivers {
namespace {

namespace fs = std::filesystem;

constexpr int kUnitsPerMetre = 5000;
constexpr std::int64_t kMaxColorGap = 20'000;   // [us]
constexpr std::int64_t kMaxTruthGap = 100'000;  // [us]

void check_files(const fs::path& folder) {
  if (!fs::exists(folder)) throw SourceError(folder.string() + ": no such folder");
  if (!fs::is_directory(folder)) throw SourceError(folder.string() + ": not a folder");
  std::string missing;
  for (const char* name : {"depth.txt", "rgb.txt"}) {
    if (!fs::exists(folder / name))
      missing += (missing.empty() ? "" : " and no ") + std::string(name);
  }
  if (!missing.empty()) {
    throw SourceError(folder.string() + ": not a TUM RGB-D sequence: no " + missing + " in it");
  }
}

}  // namespace

geometry::CameraModel tum_camera(const fs::path& folder) {
  std::error_code error;
  fs::path name = fs::canonical(folder, error);  // "." has a name, too
  if (error) name = folder;
  for (; name.has_relative_path(); name = name.parent_path()) {
    const std::string part = name.filename().string();
    const auto says = [&](const char* word) { return part.find(word) != std::string::npos; };
    if (says("freiburg1")) return {640, 480, 517.3, 516.5, 318.6, 255.3};
    if (says("freiburg2")) return {640, 480, 520.9, 521.0, 325.1, 249.7};
    if (says("freiburg3")) return {640, 480, 535.4, 539.2, 320.1, 247.6};
  }
  return {640, 480, 525.0, 525.0, 319.5, 239.5};
}

TumSource::TumSource(fs::path folder, FrameRange range)
    : folder_(std::move(folder)), published_(tum_camera(folder_)) {
  check_files(folder_);
  const std::vector<StampedFile> depth = read_file_list(folder_ / "depth.txt");
  const std::vector<StampedFile> color = read_file_list(folder_ / "rgb.txt");
  const auto pairs = associate(depth, color, kMaxColorGap);
  without_color_ = depth.size() - pairs.size();
  if (pairs.empty()) {
    throw SourceError(folder_.string() + ": none of the " + std::to_string(depth.size()) +
                      " depth images has a colour image within 20 ms");
  }

  std::vector<StampedPose> trajectory;
  const fs::path truth_file = folder_ / "groundtruth.txt";
  if (fs::exists(truth_file)) trajectory = read_trajectory(truth_file);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!range.contains(static_cast<std::int64_t>(i))) continue;
    const StampedFile& d = depth[pairs[i].first];
    const StampedFile& c = color[pairs[i].second];
    entries_.push_back({d.utime, d.name, c.name, pose_at(trajectory, d.utime, kMaxTruthGap)});
    has_truth_ |= entries_.back().truth_T_world_camera.has_value();
  }
  if (entries_.empty()) {
    throw SourceError(folder_.string() + ": no frame " + to_string(range) +
                      ", there are frames 0 to " + std::to_string(pairs.size() - 1));
  }
}

std::string TumSource::remark() const {
  if (without_color_ == 0) return {};
  return std::to_string(without_color_) +
         " depth images without a colour image within 20 ms left out";
}

std::optional<SourceFrame> TumSource::next() {
  if (at_ == entries_.size()) return std::nullopt;
  const Entry& entry = entries_[at_++];

  SourceFrame out;
  geometry::RgbdFrame& frame = out.frame;
  frame.utime = entry.utime;
  frame.sensor = "TUM RGB-D";
  out.origin = (folder_ / entry.depth).string();
  frame.depth = read_depth_png(out.origin, kUnitsPerMetre);
  frame.depth_camera = resized(published_, frame.depth.width, frame.depth.height);
  load_color(folder_ / entry.color, out);
  frame.color_camera = resized(published_, frame.color_camera.width, frame.color_camera.height);
  out.truth_T_world_camera = entry.truth_T_world_camera;
  frame.sequence = delivered_++;
  return out;
}

}  // namespace geomap::drivers
