// SPDX-License-Identifier: BSD-3-Clause
#include "perception/region_outline.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "geometry/polygon_clip.hpp"
#include "geometry/ring_contacts.hpp"
#include "perception/label_rings.hpp"
#include "perception/plane_extractor.hpp"
#include "perception/plane_rays.hpp"

namespace geomap::perception {
namespace {

constexpr std::int64_t kLeastPixels = 24;  // of a part of an outline
// Of an outline's tolerance, over the root of its area: small ones keep their area too.
constexpr double kToleranceOfSize = 0.04;

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
  std::reverse(ring.begin(), ring.end());  // the frame's y axis points up
  return ring;
}

// Fills the hole within a ring, unless it is large or something else is seen in it.
bool fill_hole(const geometry::RgbdFrame& frame, const LabelRing& ring,
               const geometry::Plane& plane, double largest, std::vector<std::int16_t>& label) {
  const Eigen::Vector2d at(ring.corners[0].x, ring.corners[0].y);
  if (!meets(frame.depth_camera, plane, at)) return false;
  const double pixel = pixel_area(frame.depth_camera, plane, at);
  if (static_cast<double>(-ring.area) * pixel >= largest) return false;
  const int width = frame.depth.width;
  const std::vector<Span> spans = spans_of(ring);
  for (const Span& span : spans) {
    for (int x = span.first; x < span.last; ++x) {
      const std::int16_t l = label[index(width, x, span.y)];
      if (l != kNoPlane && l != ring.label) return false;
    }
  }
  for (const Span& span : spans) {
    for (int x = span.first; x < span.last; ++x) {
      const std::size_t i = index(width, x, span.y);
      if (!geometry::DepthImage::is_reading(frame.depth.millimetres[i])) label[i] = ring.label;
    }
  }
  return true;
}

// Of rings that cross themselves, as simplified ones of thin parts may; the pockets that leaves are
// no holes.
geometry::Polygon untangle(const std::vector<geometry::Ring>& rings, double largest_hole) {
  geometry::Polygon polygon = geometry::from_rings(rings, geometry::FillRule::kNonZero);
  for (geometry::PolygonPart& part : polygon.parts) {
    std::erase_if(part.holes, [largest_hole](const geometry::Ring& hole) {
      return -geometry::signed_area(hole) < largest_hole;
    });
  }
  if (polygon.parts.size() < 2) return polygon;
  std::vector<geometry::Ring> kept;  // a part may have lain in a pocket
  for (const geometry::Ring* ring : geometry::rings_of(polygon)) kept.push_back(*ring);
  return geometry::from_rings(kept, geometry::FillRule::kNonZero);
}

// Outer rings counter-clockwise and holes clockwise, as traced: without contacts, and with one
// outer ring, they are a polygon as they are.
geometry::Polygon polygon_of(std::vector<geometry::Ring> rings, double largest_hole) {
  std::vector<const geometry::Ring*> all;
  geometry::PolygonPart part;
  for (geometry::Ring& ring : rings) {
    ring = geometry::without_collinear(ring);
    all.push_back(&ring);
  }
  const bool is_plain =
      std::all_of(rings.begin(), rings.end(), [](const auto& ring) { return ring.size() > 2; }) &&
      std::count_if(rings.begin(), rings.end(),
                    [](const auto& ring) { return geometry::signed_area(ring) > 0.0; }) == 1 &&
      geometry::find_contacts(all).none();
  if (!is_plain) return untangle(rings, largest_hole);
  for (geometry::Ring& ring : rings) {
    if (geometry::signed_area(ring) > 0.0) {
      part.outer = std::move(ring);
    } else {
      part.holes.push_back(std::move(ring));
    }
  }
  geometry::Polygon polygon;
  polygon.parts.push_back(std::move(part));
  return geometry::canonical(std::move(polygon));
}

}  // namespace

void outline_parts(const geometry::RgbdFrame& frame, const OutlineSettings& settings,
                   std::vector<std::int16_t>& label, std::vector<FoundPart>& found) {
  const geometry::CameraModel& camera = frame.depth_camera;
  std::vector<std::vector<geometry::Ring>> rings(found.size());
  std::vector<std::uint8_t> is_missed(found.size(), 0);
  for (const LabelRing& ring : trace_labels(label, camera.width, camera.height)) {
    const auto of = static_cast<std::size_t>(ring.label);
    const geometry::PlanarPolygon& surface = found[of].observation.surface;
    if (ring.area < 0 && fill_hole(frame, ring, surface.plane, settings.max_hole_area, label)) {
      continue;
    }
    if (std::abs(ring.area) < kLeastPixels) continue;
    const double pixel = pixel_length(camera, surface.plane, camera.project(surface.frame.origin));
    const double tolerance =
        std::min(1.0 + settings.simplify_tolerance / pixel,
                 kToleranceOfSize * std::sqrt(static_cast<double>(std::abs(ring.area))));
    const std::vector<PixelCorner> corners = simplify_ring(ring.corners, tolerance);
    if (corners.size() < 3) continue;
    auto lifted = lift_ring(camera, surface, corners);
    if (lifted) {
      rings[of].push_back(std::move(*lifted));
    } else {
      is_missed[of] = 1;
    }
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (is_missed[i] != 0) continue;
    found[i].observation.surface.polygon = polygon_of(std::move(rings[i]), settings.max_hole_area);
  }
}

}  // namespace geomap::perception
