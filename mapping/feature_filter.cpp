// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/feature_filter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "mapping/parse_number.hpp"

namespace geomap::mapping {
namespace {

using Condition = std::function<bool(const ViewFeature&)>;

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

std::optional<double> value_of(const ViewFeature& feature, std::string_view field) {
  if (field == "area") return facts_of(feature).area;
  if (field == "height") return facts_of(feature).height;
  if (field == "slope") return facts_of(feature).slope;
  if (field == "observations") return feature.observations;
  if (field == "rms") return feature.rms * geometry::kGridUnit;
  if (field == "held") return feature.locked ? 1.0 : 0.0;
  return std::nullopt;
}

template <class Value>
bool holds(const Value& left, std::string_view relation, const Value& right) {
  if (relation == "<") return left < right;
  if (relation == "<=") return left <= right;
  if (relation == ">") return left > right;
  if (relation == ">=") return left >= right;
  if (relation == "!=") return left != right;
  return left == right;
}

Condition parse_condition(std::string_view text) {
  const std::size_t at = text.find_first_of("<>=!");
  if (at == std::string_view::npos) {
    throw std::invalid_argument(
        fmt::format("'{}' is no condition: write for example area>0.5", text));
  }
  const std::size_t end = text.find_first_not_of("<>=!", at);
  const std::string field(trimmed(text.substr(0, at)));
  const std::string relation(text.substr(at, end - at));
  const std::string value(end == std::string_view::npos ? "" : trimmed(text.substr(end)));
  constexpr std::array<std::string_view, 6> kRelations = {"<", "<=", ">", ">=", "=", "!="};
  if (std::find(kRelations.begin(), kRelations.end(), relation) == kRelations.end()) {
    throw std::invalid_argument(fmt::format("'{}' is no relation: use < <= > >= = !=", relation));
  }
  if (field == "label") {
    return [=](const ViewFeature& feature) { return holds(feature.label, relation, value); };
  }
  if (!value_of(ViewFeature(), field)) {
    throw std::invalid_argument(fmt::format(
        "'{}' is no field: use area, height, slope, observations, rms, held or label", field));
  }
  const auto number = parse_number<double>(value);
  if (!number) throw std::invalid_argument(fmt::format("'{}' is no number", value));
  return [=](const ViewFeature& feature) {
    return holds(*value_of(feature, field), relation, *number);
  };
}

}  // namespace

FeatureFacts facts_of(const ViewFeature& feature) {
  const geometry::PlanarPolygon surface = surface_of(feature);
  const geometry::AreaMoments moments = geometry::area_moments(feature.polygon);
  FeatureFacts facts;
  facts.area = moments.area;
  facts.centroid = surface.lift(moments.centroid);
  facts.height = facts.centroid.z();
  facts.slope = surface.plane.normal.z();
  return facts;
}

std::function<bool(const ViewFeature&)> parse_filter(const std::string& text) {
  constexpr std::string_view kAnd = " and ";
  std::vector<Condition> conditions;
  std::string_view rest = text;
  for (;;) {
    const std::size_t at = rest.find(kAnd);
    conditions.push_back(parse_condition(trimmed(rest.substr(0, at))));
    if (at == std::string_view::npos) break;
    rest = rest.substr(at + kAnd.size());
  }
  return [conditions](const ViewFeature& feature) {
    return std::all_of(conditions.begin(), conditions.end(),
                       [&](const Condition& condition) { return condition(feature); });
  };
}

FeatureId find_feature(const std::string& name, const std::map<FeatureId, ViewFeature>& features) {
  const std::string_view digits = std::string_view(name).substr(name.starts_with('#') ? 1 : 0);
  if (const auto number = parse_number<std::size_t>(digits)) {
    if (*number < 1 || *number > features.size()) {
      throw std::invalid_argument(
          fmt::format("there is no feature #{}: the map has {}", *number, features.size()));
    }
    return std::next(features.begin(), static_cast<std::ptrdiff_t>(*number - 1))->first;
  }
  std::optional<FeatureId> found;
  for (const auto& [id, feature] : features) {
    const std::string text = to_string(id);
    if (text == name) return id;
    if (!text.ends_with(name)) continue;
    if (found) throw std::invalid_argument("several features end with '" + name + "'");
    found = id;
  }
  if (!found) throw std::invalid_argument("there is no feature '" + name + "'");
  return *found;
}

}  // namespace geomap::mapping
