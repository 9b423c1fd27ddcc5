// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/fakenect_folder.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "drivers/frame_source.hpp"
#include "drivers/kinect_disparity.hpp"
#include "drivers/tick_clock.hpp"

namespace geomap::drivers {
namespace {

constexpr int kWidth = 640, kHeight = 480;
constexpr double kCountsPerG = 819.0;  // of the accelerometer

void append(std::string& bytes, std::uint16_t value) {
  bytes.push_back(static_cast<char>(value & 0xff));
  bytes.push_back(static_cast<char>(value >> 8));
}

std::string depth_file(const geometry::DepthImage& depth) {
  std::string bytes = fmt::format("P5 {} {} 65535\n", kWidth, kHeight);
  for (const std::uint16_t millimetres : depth.millimetres) {
    append(bytes, disparity_of_millimetres(millimetres));
  }
  return bytes;
}

std::string color_file(const geometry::ColorImage& color) {
  return fmt::format("P6 {} {} 255\n", kWidth, kHeight) +
         std::string(color.rgb.begin(), color.rgb.end());
}

// libfreenect's freenect_raw_tilt_state: its axes are left, up and forward.
std::string attitude_file(const Eigen::Vector3d& up) {
  std::string bytes;
  for (const double axis : {-up.x(), -up.y(), up.z()}) {
    append(bytes, static_cast<std::uint16_t>(std::lround(kCountsPerG * axis)));
  }
  bytes.resize(12);  // the motor: level, at rest
  return bytes;
}

}  // namespace

FakenectFolder::FakenectFolder(const std::filesystem::path& folder) : folder_(folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw SourceError(folder.string() + ": " + error.message());
  const std::filesystem::path index = folder / "INDEX.txt";
  if (std::filesystem::exists(index)) throw SourceError(folder.string() + " holds a recording");
  index_.open(index);
  if (!index_) throw SourceError(index.string() + " cannot be written");
}

void FakenectFolder::add(const geometry::RgbdFrame& frame, std::int64_t utime,
                         const Eigen::Vector3d& up) {
  constexpr std::size_t kPixels = std::size_t{kWidth} * kHeight;
  if (frame.depth.width != kWidth || frame.depth.millimetres.size() != kPixels ||
      frame.color.width != kWidth || frame.color.rgb.size() != 3 * kPixels) {
    throw std::invalid_argument("a Kinect's images are 640x480");
  }
  write('a', utime, "dump", attitude_file(up));
  write('d', utime, "pgm", depth_file(frame.depth));
  write('r', utime, "ppm", color_file(frame.color));
}

void FakenectFolder::write(char kind, std::int64_t utime, const std::string& extension,
                           const std::string& content) {
  const std::string name =
      fmt::format("{}-{:.6f}-{}.{}", kind, 1e-6 * static_cast<double>(utime),
                  static_cast<std::uint32_t>(utime * kTicksPerMicrosecond), extension);
  std::ofstream file(folder_ / name, std::ios::binary);
  file << content;
  file.close();
  index_ << name << '\n' << std::flush;
  if (!file || !index_) throw SourceError((folder_ / name).string() + " cannot be written");
}

}  // namespace geomap::drivers
