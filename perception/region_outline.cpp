// SPDX-License-Identifier: BSD-3-Clause
#include "perception/region_outline.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "geometry/polygon_clip.hpp"
#include "perception/plane_extractor.hpp"
#include "perception/plane_rays.hpp"

namespace geomap::perception {
namespace {

constexpr double kTolerance = 1.0;         // of an outline [pixel]
constexpr std::int64_t kLeastPixels = 24;  // of a part of an outline

struct Span {
  int y = 0, first = 0, last = 0;  // pixels [first, last) of row y
};

// The pixels within a ring.
std::vector<Span> spans_of(const LabelRing& ring) {
  std::vector<PixelCorner> crossings;  // of each row with the ring's upright edges
  for (std::size_t i = 0; i < ring.corners.size(); ++i) {
    const PixelCorner a = ring.corners[i], b = ring.corners[(i + 1) % ring.corners.size()];
    for (int y = std::min(a.y, b.y); y < std::max(a.y, b.y); ++y) crossings.push_back({a.x, y});
  }
  std::sort(crossings.begin(), crossings.end(),
            [](PixelCorner a, PixelCorner b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
  std::vector<Span> spans;
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    spans.push_back({crossings[i].y, crossings[i].x, crossings[i + 1].x});
  }
  return spans;
}

std::size_t index(int width, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(x);
}

geometry::GridPoint lift(const geometry::CameraModel& camera,
                         const geometry::PlanarPolygon& surface, const Eigen::Vector3d& y_axis,
                         const Eigen::Vector2d& pixel) {
  const Eigen::Vector3d p = intersect(camera, surface.plane, pixel) - surface.frame.origin;
  return geometry::to_grid({surface.frame.x_axis.dot(p), y_axis.dot(p)});
}

// Nothing where a ray misses the plane.
std::optional<geometry::Ring> lift_ring(const geometry::CameraModel& camera,
                                        const geometry::PlanarPolygon& surface,
                                        const std::vector<PixelCorner>& corners) {
  const Eigen::Vector3d y_axis = surface.frame.y_axis();
  geometry::Ring ring;
  ring.reserve(corners.size());
  for (const PixelCorner corner : corners) {
    const Eigen::Vector2d pixel(corner.x - 0.5, corner.y - 0.5);
    if (!meets(camera, surface.plane, pixel)) return std::nullopt;
    ring.push_back(lift(camera, surface, y_axis, pixel));
  }
  return ring;
}

}  // namespace

std::vector<std::int16_t> fill_holes(const geometry::RgbdFrame& frame,
                                     const std::vector<geometry::Plane>& planes, double largest,
                                     std::vector<std::int16_t>& label) {
  const int width = frame.depth.width;
  std::vector<std::int16_t> filled = label;
  for (const LabelRing& ring : trace_labels(label, width, frame.depth.height)) {
    if (ring.area >= 0) continue;
    const geometry::Plane& plane = planes[static_cast<std::size_t>(ring.label)];
    const Eigen::Vector2d at(ring.corners[0].x, ring.corners[0].y);
    if (!meets(frame.depth_camera, plane, at) ||
        static_cast<double>(-ring.area) * pixel_area(frame.depth_camera, plane, at) >= largest) {
      continue;
    }
    const std::vector<Span> spans = spans_of(ring);
    const bool is_empty = std::all_of(spans.begin(), spans.end(), [&](const Span& span) {
      return std::all_of(
          label.begin() + static_cast<std::ptrdiff_t>(index(width, span.first, span.y)),
          label.begin() + static_cast<std::ptrdiff_t>(index(width, span.last, span.y)),
          [&](std::int16_t l) { return l == kNoPlane || l == ring.label; });
    });
    if (!is_empty) continue;
    for (const Span& span : spans) {
      for (int x = span.first; x < span.last; ++x) {
        const std::size_t pixel = index(width, x, span.y);
        filled[pixel] = ring.label;
        if (!geometry::DepthImage::is_reading(frame.depth.millimetres[pixel])) {
          label[pixel] = ring.label;
        }
      }
    }
  }
  return filled;
}

void outline_regions(const geometry::CameraModel& camera, const std::vector<std::int16_t>& label,
                     std::vector<geometry::PlanarPolygon>& surfaces) {
  std::vector<std::vector<geometry::Ring>> rings(surfaces.size());
  std::vector<std::uint8_t> is_missed(surfaces.size(), 0);
  for (const LabelRing& ring : trace_labels(label, camera.width, camera.height)) {
    if (std::abs(ring.area) < kLeastPixels) continue;
    const std::vector<PixelCorner> corners = simplify_ring(ring.corners, kTolerance);
    if (corners.size() < 3) continue;
    const auto of = static_cast<std::size_t>(ring.label);
    auto lifted = lift_ring(camera, surfaces[of], corners);
    if (lifted) {
      rings[of].push_back(std::move(*lifted));
    } else {
      is_missed[of] = 1;
    }
  }
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (is_missed[i] != 0) continue;
    surfaces[i].polygon = geometry::from_rings(rings[i], geometry::FillRule::kNonZero);
  }
}

}  // namespace geomap::perception
