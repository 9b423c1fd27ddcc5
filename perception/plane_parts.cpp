// SPDX-License-Identifier: BSD-3-Clause
#include "perception/plane_parts.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "geometry/polygon_clip.hpp"
#include "perception/alpha_hull.hpp"

namespace geomap::perception {
namespace {

constexpr int kSide = DepthCells::kSide;
constexpr double kBorderSpacing = 0.015;  // of border points, where pixels are closer [m]
constexpr double kHullPixels = 6.0;      // least alpha: this many pixel lengths
constexpr int kWidestGap = 24;           // [pixel]
constexpr double kLeastSlope = 0.02;     // |n·ray| below which a ray does not meet the plane

// Area on the plane that a pixel covers [m²]: z³/(fx fy d).
double pixel_area(const geometry::CameraModel& camera, const geometry::Plane& plane,
                  const Eigen::Vector2d& pixel) {
  const double z = intersect(camera, plane, pixel).z();
  return z * z * z / (camera.fx * camera.fy * plane.d);
}

// The points of one plane that are triangulated.
struct Samples {
  std::vector<Eigen::Vector2d> pixel;     // image point
  std::vector<Eigen::Vector2d> on_plane;  // [m], in a frame on the plane
  std::vector<double> radius;             // alpha at the point [m]
};

class Sampler {
 public:
  Sampler(const geometry::CameraModel& camera, int width, const geometry::Plane& plane,
          std::int16_t index, const PlanePixels& pixels, const PartSettings& settings)
      : camera_(camera),
        width_(width),
        height_(width > 0 ? static_cast<int>(pixels.label.size()) / width : 0),
        columns_((width + kSide - 1) / kSide),
        plane_(plane),
        index_(index),
        pixels_(pixels),
        settings_(settings) {
    const Eigen::Vector3d foot = -plane.d * plane.normal;
    const auto frame = geometry::PlaneFrame::on(plane, foot, Eigen::Vector3d::UnitX(),
                                                Eigen::Vector3d::UnitY());
    x_ = frame.x_axis;
    y_ = frame.y_axis();
  }

  // Points inside, thinned, one per cell; returns the sample that stands for each of the plane's cells,
  // -1 for cells whose ray does not meet the plane.
  std::vector<int> sample_cells() {
    const auto& cells = pixels_.cells[static_cast<std::size_t>(index_)];
    std::vector<int> sample_of_cell;
    sample_of_cell.reserve(cells.size());
    std::unordered_map<std::uint64_t, int> sample_at;  // looked up, never walked
    sample_at.reserve(cells.size());
    for (const PlaneCell& cell : cells) {
      const Eigen::Vector2d pixel(cell.cell % columns_ * kSide + 0.5 * (kSide - 1),
                                  cell.cell / columns_ * kSide + 0.5 * (kSide - 1));
      if (!is_met(pixel)) {
        sample_of_cell.push_back(-1);
        continue;
      }
      const Eigen::Vector2d at = on_plane(pixel);
      const auto [entry, is_new] =
          sample_at.try_emplace(grid_key(at), static_cast<int>(samples_.pixel.size()));
      if (is_new) add(pixel, at);
      sample_of_cell.push_back(entry->second);
    }
    return sample_of_cell;
  }

  // Points on the outer edges of pixels beside something wider than a gap that alpha closes anyway.
  void sample_border() {
    for (const PlaneCell& cell : pixels_.cells[static_cast<std::size_t>(index_)]) {
      const int column = cell.cell % columns_, row = cell.cell / columns_;
      if (is_inner(column, row)) continue;
      const int u_end = std::min((column + 1) * kSide, width_);
      const int v_end = std::min((row + 1) * kSide, height_);
      const BorderSteps steps = border_steps(column, row);
      for (int v = row * kSide; v < v_end; ++v) {
        for (int u = column * kSide; u < u_end; ++u) {
          if (is_own(u, v)) sample_edges(u, v, steps);
        }
      }
    }
  }

  const Samples& samples() const { return samples_; }

 private:
  bool is_own(int u, int v) const {
    return u >= 0 && v >= 0 && u < width_ && v < height_ &&
           pixels_.label[static_cast<std::size_t>(v * width_ + u)] == index_;
  }

  // All pixels of the cell and of its four neighbours' adjoining rows belong to the plane.
  bool is_inner(int column, int row) const {
    const int u0 = column * kSide, v0 = row * kSide;
    for (int v = v0 - 1; v <= v0 + kSide; ++v) {
      for (int u = u0 - 1; u <= u0 + kSide; ++u) {
        if (!is_own(u, v)) return false;
      }
    }
    return true;
  }

  // How far border points and the pixels that open a border are apart [pixel].
  struct BorderSteps {
    int along = 1;
    int across = 2;
  };

  BorderSteps border_steps(int column, int row) const {
    const Eigen::Vector2d pixel(column * kSide + 0.5 * kSide, row * kSide + 0.5 * kSide);
    if (!is_met(pixel)) return {};
    const double length = pixel_length(camera_, plane_, pixel);
    return {std::clamp(static_cast<int>(kBorderSpacing / length), 1, kSide),
            std::clamp(static_cast<int>(0.5 * settings_.alpha / length), 2, kWidestGap)};
  }

  void sample_edges(int u, int v, const BorderSteps& steps) {
    const bool takes_row = v % steps.along == 0, takes_column = u % steps.along == 0;
    const auto is_open = [&](int du, int dv) {
      for (const int gap : {1, 2, (steps.across + 1) / 2, steps.across}) {
        if (is_own(u + gap * du, v + gap * dv)) return false;
      }
      return true;
    };
    for (const int side : {-1, 1}) {
      if (takes_row && is_open(side, 0)) add_border({u + 0.5 * side, v});
      if (takes_column && is_open(0, side)) add_border({u, v + 0.5 * side});
    }
  }

  void add_border(const Eigen::Vector2d& pixel) {
    if (is_met(pixel)) add(pixel, on_plane(pixel));
  }

  void add(const Eigen::Vector2d& pixel, const Eigen::Vector2d& at) {
    samples_.pixel.push_back(pixel);
    samples_.on_plane.push_back(at);
    samples_.radius.push_back(
        std::max(settings_.alpha, kHullPixels * pixel_length(camera_, plane_, pixel)));
  }

  bool is_met(const Eigen::Vector2d& pixel) const {
    return -plane_.normal.dot(camera_.ray(pixel.x(), pixel.y())) > kLeastSlope;
  }

  Eigen::Vector2d on_plane(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector3d p = intersect(camera_, plane_, pixel);
    return {x_.dot(p), y_.dot(p)};
  }

  std::uint64_t grid_key(const Eigen::Vector2d& at) const {
    const auto x = static_cast<std::int64_t>(std::floor(at.x() / settings_.spacing));
    const auto y = static_cast<std::int64_t>(std::floor(at.y() / settings_.spacing));
    return (static_cast<std::uint64_t>(x) << 32) ^ (static_cast<std::uint64_t>(y) & 0xffffffffU);
  }

  const geometry::CameraModel& camera_;
  int width_;
  int height_;
  int columns_;
  const geometry::Plane& plane_;
  std::int16_t index_;
  const PlanePixels& pixels_;
  const PartSettings& settings_;
  Eigen::Vector3d x_, y_;
  Samples samples_;
};

}  // namespace

Eigen::Vector3d intersect(const geometry::CameraModel& camera, const geometry::Plane& plane,
                          const Eigen::Vector2d& pixel) {
  const Eigen::Vector3d ray = camera.ray(pixel.x(), pixel.y());
  return -plane.d / plane.normal.dot(ray) * ray;
}

double pixel_length(const geometry::CameraModel& camera, const geometry::Plane& plane,
                    const Eigen::Vector2d& pixel) {
  const Eigen::Vector3d ray = camera.ray(pixel.x(), pixel.y());
  const double slope = -plane.normal.dot(ray);
  const double z = plane.d / slope;
  return z * ray.norm() / (slope * std::min(camera.fx, camera.fy));
}

std::vector<PlanePart> split_into_parts(const geometry::CameraModel& camera, int width,
                                        const geometry::Plane& plane, std::int16_t index,
                                        const PlanePixels& pixels, const PartSettings& settings) {
  Sampler sampler(camera, width, plane, index, pixels, settings);
  const std::vector<int> sample_of_cell = sampler.sample_cells();
  sampler.sample_border();
  const Samples& samples = sampler.samples();
  const AlphaHull hull =
      alpha_hull(samples.on_plane, samples.radius, settings.tolerance / settings.alpha);

  std::vector<PlanePart> parts(static_cast<std::size_t>(hull.groups));
  const auto& cells = pixels.cells[static_cast<std::size_t>(index)];
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (sample_of_cell[i] < 0) continue;
    const auto sample = static_cast<std::size_t>(sample_of_cell[i]);
    PlanePart& part = parts[static_cast<std::size_t>(hull.group[sample])];
    part.sums += cells[i].sums;
    part.covered += cells[i].sums.pixels * pixel_area(camera, plane, samples.pixel[sample]);
  }
  for (std::size_t i = 0; i < hull.rings.size(); ++i) {
    std::vector<Eigen::Vector2d> ring;
    ring.reserve(hull.rings[i].size());
    for (const std::uint32_t sample : hull.rings[i]) ring.push_back(samples.pixel[sample]);
    parts[static_cast<std::size_t>(hull.ring_group[i])].rings.push_back(std::move(ring));
  }
  std::erase_if(parts, [](const PlanePart& part) { return part.sums.pixels == 0 || part.rings.empty(); });
  return parts;
}

geometry::Polygon part_polygon(const geometry::CameraModel& camera, const geometry::Plane& plane,
                               const geometry::PlaneFrame& frame, const PlanePart& part) {
  const Eigen::Isometry3d T_plane_camera = frame.T_plane_parent();
  std::vector<geometry::Ring> rings;
  rings.reserve(part.rings.size());
  for (const auto& pixels : part.rings) {
    geometry::Ring ring;
    ring.reserve(pixels.size());
    for (const Eigen::Vector2d& pixel : pixels) {
      ring.push_back(
          geometry::to_grid((T_plane_camera * intersect(camera, plane, pixel)).head<2>()));
    }
    rings.push_back(std::move(ring));
  }
  return geometry::from_rings(rings, geometry::FillRule::kNonZero);
}

}  // namespace geomap::perception
