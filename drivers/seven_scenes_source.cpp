// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/seven_scenes_source.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <charconv>
#include <map>
#include <utility>

#include "drivers/data_set_frame.hpp"
#include "drivers/image_file.hpp"
#include "drivers/input_file.hpp"

namespace geomap::drivers {
namespace {

namespace fs = std::filesystem;

constexpr geometry::CameraModel kPublished{640, 480, 585.0, 585.0, 320.0, 240.0};
constexpr const char* kIntrinsicsFile = "camera-intrinsics.txt";

// How far RᵀR may be from the identity (Frobenius): the recorded poses are within 1e-6.
constexpr double kMaxSkew = 1e-2;

struct FrameName {
  std::int64_t number = 0;
  std::string stem;  // frame-NNNNNN
  std::string kind;  // depth.png, color.jpg, ...
};

std::optional<FrameName> parse_name(const std::string& name) {
  constexpr std::string_view kPrefix = "frame-";
  constexpr std::ptrdiff_t kMaxDigits = 9;
  if (!name.starts_with(kPrefix)) return std::nullopt;
  FrameName result;
  const char* begin = name.data() + kPrefix.size();
  const char* end = name.data() + name.size();
  const auto [stopped, error] = std::from_chars(begin, end, result.number);
  if (error != std::errc() || *begin == '-' || stopped - begin > kMaxDigits) return std::nullopt;
  if (stopped == end || *stopped != '.') return std::nullopt;
  result.stem = name.substr(0, static_cast<std::size_t>(stopped - name.data()));
  result.kind.assign(stopped + 1, end);
  return result;
}

// A download holds one folder per sequence: the likely mistake is to name the folder above them.
std::string sequence_inside(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory() && name.starts_with("seq-")) names.push_back(name);
  }
  if (names.empty()) return {};
  return "; it holds " + *std::min_element(names.begin(), names.end()) +
         ": a sequence is what can be imported";
}

Eigen::Isometry3d read_pose(const fs::path& path) {
  const std::vector<double> numbers = read_matrix(path, 4, 4);
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> M(numbers.data());
  const Eigen::Matrix3d R = M.topLeftCorner<3, 3>();
  const bool rigid = M.row(3) == Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0) &&
                     (R.transpose() * R - Eigen::Matrix3d::Identity()).norm() <= kMaxSkew &&
                     R.determinant() > 0.0;
  if (!rigid) throw SourceError(path.string() + ": not a rigid transform");
  // The nearest rotation: products of poses that are orthonormal to 7 digits only drift away.
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  T_world_camera.linear() = svd.matrixU() * svd.matrixV().transpose();
  T_world_camera.translation() = M.topRightCorner<3, 1>();
  return T_world_camera;
}

std::vector<double> read_intrinsics(const fs::path& path) {
  std::vector<double> K = read_matrix(path, 3, 3);
  const bool pinhole = K[0] > 0.0 && K[4] > 0.0 && K[1] == 0.0 && K[3] == 0.0 && K[6] == 0.0 &&
                       K[7] == 0.0 && K[8] == 1.0;
  if (!pinhole) {
    throw SourceError(path.string() + ": not a camera matrix [fx 0 cx; 0 fy cy; 0 0 1]");
  }
  return K;
}

}  // namespace

std::int64_t seven_scenes_utime(std::int64_t i) {
  constexpr std::int64_t kStart = 1'000'000'000'000'000;
  return kStart + (2 * 100'000 * i + 3) / 6;
}

std::vector<SevenScenesSource::Files> SevenScenesSource::list(const fs::path& folder) {
  std::map<std::int64_t, Files> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::optional<FrameName> name = parse_name(entry.path().filename().string());
    if (!name) continue;
    Files& files = found[name->number];
    files.number = name->number;
    files.stem = name->stem;
    if (name->kind == "depth.png") files.depth = true;
    if (name->kind == "pose.txt") files.pose = true;
    const bool jpeg = name->kind == "color.jpg";
    const bool first_png = name->kind == "color.png" && files.color.empty();
    if (jpeg || first_png) files.color = name->stem + "." + name->kind;
  }
  std::vector<Files> result;
  for (const auto& [number, files] : found) {
    if (files.depth || !files.color.empty()) result.push_back(files);  // a frame is what has images
  }
  return result;
}

SevenScenesSource::SevenScenesSource(fs::path folder, FrameRange range)
    : folder_(std::move(folder)) {
  if (!fs::exists(folder_)) throw SourceError(folder_.string() + ": no such folder");
  if (!fs::is_directory(folder_)) throw SourceError(folder_.string() + ": not a folder");

  const std::vector<Files> all = list(folder_);
  if (std::none_of(all.begin(), all.end(), [](const Files& files) { return files.depth; })) {
    throw SourceError(folder_.string() +
                      ": not a 7-Scenes sequence: no frame-NNNNNN.depth.png in it" +
                      sequence_inside(folder_));
  }
  for (const Files& files : all) {
    has_color_ |= !files.color.empty();
    if (!range.contains(files.number)) continue;
    has_truth_ |= files.pose;
    files_.push_back(files);
  }
  if (files_.empty()) {
    throw SourceError(folder_.string() + ": no frame " + to_string(range) + ", there are frames " +
                      std::to_string(all.front().number) + " to " +
                      std::to_string(all.back().number));
  }
  if (fs::exists(folder_ / kIntrinsicsFile))
    intrinsics_ = read_intrinsics(folder_ / kIntrinsicsFile);
}

geometry::CameraModel SevenScenesSource::depth_camera(const geometry::DepthImage& depth) const {
  if (intrinsics_.empty()) return resized(kPublished, depth.width, depth.height);
  return {depth.width,    depth.height,   intrinsics_[0],
          intrinsics_[4], intrinsics_[2], intrinsics_[5]};
}

std::optional<SourceFrame> SevenScenesSource::next() {
  if (at_ == files_.size()) return std::nullopt;
  const Files& files = files_[at_++];

  SourceFrame out;
  geometry::RgbdFrame& frame = out.frame;
  frame.utime = seven_scenes_utime(files.number);
  frame.sensor = "7-Scenes";
  out.origin = (folder_ / files.stem).string();
  frame.depth = read_depth_png(out.origin + ".depth.png");
  frame.depth_camera = depth_camera(frame.depth);
  if (has_color_) {
    load_color(folder_ / (files.color.empty() ? files.stem + ".color.jpg" : files.color), out);
    const geometry::CameraModel& color = frame.color_camera;
    frame.color_camera = resized(frame.depth_camera, color.width, color.height);
  }
  if (files.pose) out.truth_T_world_camera = read_pose(out.origin + ".pose.txt");
  frame.sequence = delivered_++;
  return out;
}

}  // namespace geomap::drivers
