// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/edit_text.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "mapping/export_features.hpp"
#include "mapping/feature_filter.hpp"

namespace geomap::mapping {
namespace {

using Json = nlohmann::ordered_json;

// Where a surface looks, in a word.
std::string facing(double slope) {
  if (slope > 0.9) return "up";
  if (slope < -0.9) return "down";
  return std::abs(slope) < 0.2 ? "aside" : "aslant";
}

Json to_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

std::string feature_table(const std::map<FeatureId, ViewFeature>& features,
                          const std::function<bool(const ViewFeature&)>& is_wanted) {
  std::string text = fmt::format("{:>4}  {:<22} {:>8} {:>8} {:<7} {:>5} {:>7}  {}\n", "#", "id",
                                 "area m2", "height m", "faces", "seen", "rms mm", "label");
  int number = 0;
  for (const auto& [id, feature] : features) {
    ++number;
    if (!is_wanted(feature)) continue;
    const FeatureFacts facts = facts_of(feature);
    text += fmt::format("{:>4}  {:<22} {:>8.2f} {:>8.2f} {:<7} {:>5} {:>7.1f}  {}{}\n", number,
                        to_string(id), facts.area, facts.height, facing(facts.slope),
                        feature.observations, feature.rms * geometry::kGridUnit * 1e3,
                        clean_text(feature.label), feature.locked ? " (held)" : "");
  }
  return text;
}

std::string feature_json(const std::map<FeatureId, ViewFeature>& features,
                         const std::function<bool(const ViewFeature&)>& is_wanted) {
  Json list = Json::array();
  int number = 0;
  for (const auto& [id, feature] : features) {
    ++number;
    if (!is_wanted(feature)) continue;
    const FeatureFacts facts = facts_of(feature);
    const geometry::Plane plane = surface_of(feature).plane;
    list.push_back({{"number", number},
                    {"id", to_string(id)},
                    {"label", clean_text(feature.label)},
                    {"held", feature.locked},
                    {"area", facts.area},
                    {"centroid", to_json(facts.centroid)},
                    {"normal", to_json(plane.normal)},
                    {"d", plane.d},
                    {"observations", feature.observations},
                    {"rms", feature.rms * geometry::kGridUnit}});
  }
  return list.dump(1) + "\n";
}

}  // namespace geomap::mapping
