// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/polygon_colors.hpp"

#include <algorithm>
#include <cmath>

namespace geomap::viewer {
namespace {

Rgba from_bytes(const std::array<std::uint8_t, 3>& color) {
  return {static_cast<float>(color[0]) / 255.0F, static_cast<float>(color[1]) / 255.0F,
          static_cast<float>(color[2]) / 255.0F, 1.0F};
}

Eigen::Vector3d direction_of(const mapping::ViewFeature& feature) {
  return 1e-6 * Eigen::Vector3d(feature.normal[0], feature.normal[1], feature.normal[2]);
}

}  // namespace

void PolygonColors::update(const Features& features) {
  most_ = 1.0;
  if (features.empty()) return;
  oldest_ = features.begin()->first.keyframe;
  newest_ = features.rbegin()->first.keyframe;
  for (const auto& [id, feature] : features) {
    most_ = std::max(most_, static_cast<double>(feature.observations));
  }
}

Rgba PolygonColors::operator()(PolygonColor what, const mapping::ViewFeature& feature) const {
  switch (what) {
    case PolygonColor::kAsSeen:
      return from_bytes(feature.color);
    case PolygonColor::kId:
      return color_of(feature.id);
    case PolygonColor::kLabel:
      return color_of_label(feature.label);
    case PolygonColor::kNormal:
      return color_of_normal(direction_of(feature));
    case PolygonColor::kAge: {
      const auto span = static_cast<double>(std::max<std::int64_t>(newest_ - oldest_, 1));
      return ramp(static_cast<double>(feature.id.keyframe - oldest_) / span);
    }
    case PolygonColor::kWeight:
      // Observations grow a hundredfold between what was seen once and the floor.
      return ramp(std::log(std::max<double>(feature.observations, 1.0)) /
                  std::log(std::max(most_, 2.0)));
  }
  return color_of_label("");
}

}  // namespace geomap::viewer
