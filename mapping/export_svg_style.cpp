// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/export_svg_style.hpp"

#include <cmath>

#include "geometry/angles.hpp"

namespace geomap::mapping {
namespace {

constexpr double kMeanColorShare = 0.35;

Rgb mix(const Rgb& a, const Rgb& b, double share_of_b) {
  Rgb mixed{};
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    mixed[i] = static_cast<std::uint8_t>(std::lround(a[i] + share_of_b * (b[i] - a[i])));
  }
  return mixed;
}

}  // namespace

Orientation orientation_of(const MapFeature& feature) {
  const double up = feature.surface.plane.normal.z();
  const double limit = geometry::radians(15.0);
  if (up > std::cos(limit)) return Orientation::kUp;
  if (up < -std::cos(limit)) return Orientation::kDown;
  return std::abs(up) < std::sin(limit) ? Orientation::kUpright : Orientation::kInclined;
}

std::string_view orientation_name(Orientation orientation) {
  switch (orientation) {
    case Orientation::kUp:
      return "facing up";
    case Orientation::kDown:
      return "facing down";
    case Orientation::kUpright:
      return "upright";
    case Orientation::kInclined:
      return "inclined";
  }
  return "";
}

std::array<Rgb, 2> orientation_colors(Orientation orientation) {
  const auto one = [](const Rgb& color) { return std::array<Rgb, 2>{color, color}; };
  switch (orientation) {
    case Orientation::kUp:
      return one({233, 205, 140});
    case Orientation::kDown:
      return one({190, 168, 206});
    case Orientation::kUpright:
      return {{{125, 170, 215}, {120, 190, 165}}};
    case Orientation::kInclined:
      return one({232, 148, 122});
  }
  return {};
}

Rgb fill_color(const MapFeature& feature, double heading) {
  const Eigen::Vector3d& normal = feature.surface.plane.normal;
  const double across = normal.x() * std::sin(heading) - normal.y() * std::cos(heading);
  const auto [first, last] = orientation_colors(orientation_of(feature));
  const Rgb color = mix(first, last, std::min(1.0, across * across));
  if (feature.color == std::array<double, 3>{}) return color;
  return mix(color, display_color(feature, 0), kMeanColorShare);
}

Rgb outline_color(const Rgb& fill) { return mix(fill, {25, 32, 44}, 0.65); }

}  // namespace geomap::mapping
