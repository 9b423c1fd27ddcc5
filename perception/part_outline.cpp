// SPDX-License-Identifier: BSD-3-Clause
#include "perception/part_outline.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "geometry/polygon_clip.hpp"
#include "perception/alpha_hull.hpp"
#include "perception/plane_rays.hpp"

namespace geomap::perception {
namespace {

constexpr double kBorderSpacing = 0.015;  // of border points, where pixels are closer [m]
constexpr double kInnerSpacing = 0.55;    // of points inside, over alpha
constexpr double kHullPixels = 6.0;       // least alpha: this many pixel lengths
// Pixels up to so far off, of which so many are the plane's: as at a right angle.
constexpr int kSolidReach = 2;
constexpr int kSolidPixels = 9;
constexpr int kWidestGap = 24;  // looked across at a border [pixel]

// Collects the points of one part.
class Sampler {
 public:
  Sampler(const geometry::CameraModel& camera, const geometry::Plane& plane,
          const geometry::PlaneFrame& frame, const LabelImage& image, std::int16_t index,
          double alpha)
      : camera_(camera),
        plane_(plane),
        frame_(frame),
        y_axis_(frame.y_axis()),
        image_(image),
        height_(static_cast<int>(image.label.size()) / image.width),
        index_(index),
        alpha_(alpha) {}

  void sample(const PlanePart& part) {
    std::unordered_set<std::uint64_t> taken;  // grid squares that have a point inside
    taken.reserve(part.size());
    for (const PlaneCell* cell : part) {
      const Eigen::Vector2d center = cell->box.cast<double>().center();
      if (!meets(camera_, plane_, center)) continue;
      const Eigen::Vector2d at = on_plane(center);
      const double length = pixel_length(camera_, plane_, center);
      const Eigen::Vector2i middle = (cell->box.min() + cell->box.max()) / 2;
      if (is_solid(middle.x(), middle.y()) && taken.insert(grid_key(at)).second) add(at, length);
      if (!is_inner(cell->box)) sample_border(cell->box, length);
    }
  }

  const std::vector<Eigen::Vector2d>& points() const { return points_; }
  const std::vector<double>& radius() const { return radius_; }

 private:
  bool is_own(int u, int v) const {
    return u >= 0 && v >= 0 && u < image_.width && v < height_ &&
           image_.label[static_cast<std::size_t>(v * image_.width + u)] == index_;
  }

  // A pixel that sticks out is no border: where a plane is seen at a flat angle, a single one that
  // belongs to the wall behind reaches far.
  bool is_solid(int u, int v) const {
    int own = 0;
    for (int j = -kSolidReach; j <= kSolidReach; ++j) {
      for (int i = -kSolidReach; i <= kSolidReach; ++i) own += is_own(u + i, v + j) ? 1 : 0;
    }
    return own >= kSolidPixels;
  }

  // A whole cell whose every neighbouring pixel is the plane's has no border.
  bool is_inner(const Eigen::AlignedBox2i& box) const {
    if (box.sizes() != Eigen::Vector2i(DepthCells::kSide - 1, DepthCells::kSide - 1)) return false;
    for (int v = box.min().y() - 1; v <= box.max().y() + 1; ++v) {
      for (int u = box.min().x() - 1; u <= box.max().x() + 1; ++u) {
        if (!is_own(u, v)) return false;
      }
    }
    return true;
  }

  // Points on the outer edges of pixels beside something wider than a gap that alpha closes anyway.
  void sample_border(const Eigen::AlignedBox2i& box, double length) {
    const int along = std::clamp(static_cast<int>(kBorderSpacing / length), 1, DepthCells::kSide);
    const int across = std::clamp(static_cast<int>(0.5 * alpha_ / length), 2, kWidestGap);
    for (int v = box.min().y(); v <= box.max().y(); ++v) {
      for (int u = box.min().x(); u <= box.max().x(); ++u) {
        if (!is_own(u, v) || !is_solid(u, v)) continue;
        for (const int side : {-1, 1}) {
          if (v % along == 0 && is_open(u, v, side, 0, across)) add_border({u + 0.5 * side, v});
          if (u % along == 0 && is_open(u, v, 0, side, across)) add_border({u, v + 0.5 * side});
        }
      }
    }
  }

  bool is_open(int u, int v, int du, int dv, int across) const {
    for (const int step : {1, 2, (across + 1) / 2, across}) {
      if (is_own(u + step * du, v + step * dv)) return false;
    }
    return true;
  }

  void add_border(const Eigen::Vector2d& pixel) {
    if (meets(camera_, plane_, pixel)) add(on_plane(pixel), pixel_length(camera_, plane_, pixel));
  }

  void add(const Eigen::Vector2d& at, double length) {
    points_.push_back(at);
    radius_.push_back(std::max(alpha_, kHullPixels * length));
  }

  Eigen::Vector2d on_plane(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector3d p = intersect(camera_, plane_, pixel) - frame_.origin;
    return {frame_.x_axis.dot(p), y_axis_.dot(p)};
  }

  std::uint64_t grid_key(const Eigen::Vector2d& at) const {
    const double spacing = kInnerSpacing * alpha_;
    const auto x = static_cast<std::int64_t>(std::floor(at.x() / spacing));
    const auto y = static_cast<std::int64_t>(std::floor(at.y() / spacing));
    return (static_cast<std::uint64_t>(x) << 32) ^ (static_cast<std::uint64_t>(y) & 0xffffffffU);
  }

  const geometry::CameraModel& camera_;
  const geometry::Plane& plane_;
  const geometry::PlaneFrame& frame_;
  Eigen::Vector3d y_axis_;
  const LabelImage& image_;
  int height_;
  std::int16_t index_;
  double alpha_;
  std::vector<Eigen::Vector2d> points_;
  std::vector<double> radius_;
};

}  // namespace

geometry::Polygon part_outline(const geometry::CameraModel& camera, const geometry::Plane& plane,
                               const geometry::PlaneFrame& frame, const LabelImage& image,
                               std::int16_t index, const PlanePart& part, double alpha) {
  Sampler sampler(camera, plane, frame, image, index, alpha);
  sampler.sample(part);
  std::vector<geometry::Ring> rings;
  for (const std::vector<std::uint32_t>& indices : alpha_hull(sampler.points(), sampler.radius())) {
    geometry::Ring ring;
    ring.reserve(indices.size());
    for (const std::uint32_t i : indices) ring.push_back(geometry::to_grid(sampler.points()[i]));
    rings.push_back(std::move(ring));
  }
  return geometry::from_rings(rings, geometry::FillRule::kNonZero);
}

}  // namespace geomap::perception
