// SPDX-License-Identifier: BSD-3-Clause
#include "perception/perception_digest.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <span>

#include "drivers/image_file.hpp"
#include "geometry/frustum.hpp"
#include "perception/frustum_icp.hpp"
#include "perception/organized_extractor.hpp"
#include "perception/point_map.hpp"
#include "perception/ransac_extractor.hpp"
#include "support/plane_renderer.hpp"
#include "support/recordings.hpp"

namespace geomap::testing {
namespace {

struct NamedFrame {
  std::string name;
  geometry::RgbdFrame frame;
};

// A ball before everything else, rough by some millimetres: surfaces that are no planes.
void add_ball(const Eigen::Vector3d& center, double radius, geometry::RgbdFrame& frame) {
  for (int v = 0; v < frame.depth.height; ++v) {
    for (int u = 0; u < frame.depth.width; ++u) {
      const Eigen::Vector3d ray = frame.depth_camera.ray(u, v);
      const double along = ray.dot(center), square = ray.squaredNorm();
      const double beyond = along * along - square * (center.squaredNorm() - radius * radius);
      if (beyond < 0.0) continue;
      const double z = (along - std::sqrt(beyond)) / square;
      const auto pixel = static_cast<std::size_t>(v * frame.depth.width + u);
      const auto roughness = static_cast<double>((pixel * 2654435761U >> 16) % 5);
      frame.depth.millimetres[pixel] = static_cast<std::uint16_t>(1000.0 * z + roughness);
    }
  }
}

// A whole image, and one whose rows fill no vector register.
void add_rendered(std::vector<NamedFrame>& frames) {
  const Eigen::Isometry3d view = look_at({1.2, -1.2, 1.5}, {-0.4, 1.2, 0.6});
  for (const int divisor : {1, 3}) {
    for (const double sigma : {0.0, 0.005, 0.02}) {
      NamedFrame named{"room/" + std::to_string(divisor) + " noise " + std::to_string(sigma),
                       render(small_room(), kinect_camera(divisor), view, sigma).frame};
      add_ball({0.3, 0.1, 1.5}, 0.2, named.frame);
      frames.push_back(std::move(named));
    }
  }
}

void add_recorded(std::vector<NamedFrame>& frames) {
  const auto folder = recording("redkitchen");
  if (!folder) return;
  for (int number = 0; number < 500; number += 50) {
    char name[32];
    std::snprintf(name, sizeof name, "frame-%06d.depth.png", number);
    NamedFrame named{name, {}};
    named.frame.depth = drivers::read_depth_png(*folder / name);
    named.frame.depth_camera = kinect_camera();
    frames.push_back(std::move(named));
  }
}

// FNV-1a over the bytes of plain values.
class Checksum {
 public:
  template <typename Values>
  void add(const Values& values) {
    for (const std::byte byte : std::as_bytes(std::span(values))) {
      hash_ = (hash_ ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3ULL;
    }
  }

  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

void add(const geometry::PlanarPolygon& surface, Checksum& sum) {
  sum.add(std::array{surface.plane.d});
  for (const Eigen::Vector3d& vector :
       {surface.plane.normal, surface.frame.origin, surface.frame.x_axis, surface.frame.normal}) {
    sum.add(std::span(vector.data(), 3));
  }
  for (const geometry::PolygonPart& part : surface.polygon.parts) {
    sum.add(part.outer);
    for (const geometry::Ring& hole : part.holes) sum.add(hole);
  }
}

std::uint64_t checksum(const perception::ExtractedPlanes& found) {
  Checksum sum;
  sum.add(found.label);
  sum.add(std::array{found.noise.factor});
  for (const geometry::PlaneObservation& plane : found.planes) {
    add(plane.surface, sum);
    sum.add(plane.moments.to_array());
    sum.add(std::array{plane.rms});
  }
  return sum.value();
}

// A frame in a map with some correction of depth, then aligned to that map from beside its pose.
std::uint64_t registration_checksum(const geometry::RgbdFrame& frame) {
  perception::PointMap map;
  map.set_depth_correction(
      geometry::DepthCorrection(geometry::DepthCorrection::Terms::Constant(0.002)));
  map.insert(1, frame, Eigen::Isometry3d::Identity());
  const perception::FrameView view = map.view(frame);
  const Eigen::Isometry3d beside(Eigen::Translation3d(0.02, -0.01, 0.015) *
                                 Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitY()));
  const geometry::Frustum seen(frame.depth_camera, 0.4, 5.0, beside);
  const auto found =
      perception::align(map.voxels().surfels_in(seen).surfels, view.surfaces, beside);
  Checksum sum;
  sum.add(view.corrected.depth.millimetres);
  for (const perception::MapPoint& point : map.points()) {
    sum.add(std::span(point.position.data(), 3));
    sum.add(std::span(point.covariance.data(), 9));
  }
  sum.add(std::span(found.T_world_camera.data(), 16));
  sum.add(std::array{found.rms, found.overlap, found.agreement, found.conditioning});
  return sum.value();
}

std::string line(const std::string& what, const std::string& frame, std::uint64_t checksum) {
  char hexadecimal[17];
  std::snprintf(hexadecimal, sizeof hexadecimal, "%016llx",
                static_cast<unsigned long long>(checksum));
  return what + ", " + frame + ": " + hexadecimal;
}

}  // namespace

std::vector<std::string> perception_digest() {
  std::vector<NamedFrame> frames;
  add_rendered(frames);
  add_recorded(frames);
  const perception::OrganizedExtractor organized;
  const perception::RansacExtractor ransac;
  std::vector<std::string> lines;
  for (const auto& [name, frame] : frames) {
    lines.push_back(line("organized", name, checksum(organized.extract(frame, 1, {}))));
    lines.push_back(line("ransac", name, checksum(ransac.extract(frame, 1, {}))));
    lines.push_back(line("registration", name, registration_checksum(frame)));
  }
  return lines;
}

}  // namespace geomap::testing
