// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/export_features.hpp"

#include <algorithm>
#include <cmath>

namespace geomap::mapping {
namespace {

// Mid tones that keep apart from each other, neighbours in the list most.
constexpr std::array<Rgb, 10> kPalette = {{{78, 121, 167},
                                           {242, 142, 43},
                                           {89, 161, 79},
                                           {225, 87, 89},
                                           {118, 183, 178},
                                           {176, 122, 161},
                                           {237, 201, 72},
                                           {156, 117, 95},
                                           {255, 157, 167},
                                           {134, 142, 150}}};

}  // namespace

std::vector<const MapFeature*> sorted_by_id(std::span<const MapFeature> features) {
  std::vector<const MapFeature*> sorted;
  sorted.reserve(features.size());
  for (const MapFeature& feature : features) sorted.push_back(&feature);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const MapFeature* a, const MapFeature* b) { return a->id < b->id; });
  return sorted;
}

Rgb display_color(const MapFeature& feature, std::size_t index) {
  const std::array<double, 3>& mean = feature.color;
  if (mean == std::array<double, 3>{}) return kPalette[index % kPalette.size()];
  const auto byte = [](double value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
  };
  return {byte(mean[0]), byte(mean[1]), byte(mean[2])};
}

}  // namespace geomap::mapping
