// SPDX-License-Identifier: BSD-3-Clause
#include "logs/evaluation_json.hpp"

#include <nlohmann/json.hpp>
#include <optional>

#include "geometry/angles.hpp"

namespace geomap::logs {
namespace {

using geometry::degrees;
using nlohmann::ordered_json;

ordered_json to_json(const ErrorStatistics& statistics) {
  // Zero would read as perfect.
  const auto number = [&](double value) {
    return statistics.count > 0 ? ordered_json(value) : ordered_json();
  };
  return {{"rmse", number(statistics.rmse)},
          {"mean", number(statistics.mean)},
          {"median", number(statistics.median)},
          {"max", number(statistics.max)},
          {"std", number(statistics.deviation)}};
}

ordered_json to_json(const RelativeError& error) {
  return {{"translation", to_json(error.translation)},
          {"rotation_deg", to_json(in_degrees(error.rotation))},
          {"pairs", error.translation.count}};
}

template <typename Value>
ordered_json to_json(const std::optional<Value>& value) {
  return value ? ordered_json(*value) : ordered_json();
}

ordered_json to_json(const std::optional<HullDistance>& distance) {
  if (!distance) return nullptr;
  return {{"mean", distance->mean}, {"max", distance->max}};
}

void add_errors(const std::optional<PlaneErrors>& errors, ordered_json& json) {
  const auto measure = [&](double PlaneErrors::*member) {
    return errors ? ordered_json((*errors).*member) : ordered_json();
  };
  json["d_coeff"] = measure(&PlaneErrors::coeff);
  json["d_angle"] = measure(&PlaneErrors::angle);
  json["d_dist"] = measure(&PlaneErrors::dist);
  json["d_dist_local"] = measure(&PlaneErrors::dist_local);
  json["rms_p"] = measure(&PlaneErrors::rms_p);
}

ordered_json to_json(const SurfaceEvaluation& plane) {
  ordered_json json;
  json["name"] = plane.name;
  json["seen"] = plane.seen;
  json["features"] = plane.features;
  json["components"] = to_json(plane.components);
  add_errors(plane.errors, json);
  json["area"] = to_json(plane.area);
  json["visible_area"] = to_json(plane.visible_area);
  json["map_area"] = plane.map_area;
  json["area_iou"] = to_json(plane.area_iou());
  json["hull_distance"] = to_json(plane.hull_distance);
  return json;
}

ordered_json to_json(const std::vector<FalseFeature>& features) {
  ordered_json json = ordered_json::array();
  for (const FalseFeature& feature : features) {
    json.push_back({{"id", to_string(feature.id)}, {"area", feature.area}});
  }
  return json;
}

void add_map(const std::optional<MapEvaluationRun>& run, ordered_json& json) {
  const MapEvaluation evaluation = run ? run->evaluation : MapEvaluation{};
  const auto name = [&](bool is_it) {
    return run && is_it ? ordered_json(run->reference) : ordered_json();
  };
  json["map"] = run ? ordered_json(run->map) : ordered_json();
  json["truth"] = name(run && !run->against_map);
  json["against"] = name(run && run->against_map);
  add_errors(evaluation.errors, json);
  json["recall"] = to_json(evaluation.recall);
  json["precision"] = to_json(evaluation.precision);
  json["features_per_component"] = to_json(evaluation.features_per_component);
  json["area_iou"] = to_json(evaluation.area_iou);
  json["hull_distance"] = to_json(evaluation.hull_distance);
  json["reduction_ratio"] = run ? to_json(run->reduction_ratio()) : ordered_json();
  json["map_features_counted"] = run ? ordered_json(evaluation.features_counted) : ordered_json();
  json["false_features"] =
      evaluation.false_features ? to_json(*evaluation.false_features) : ordered_json();
  json["planes"] = run ? ordered_json::array() : ordered_json();
  for (const SurfaceEvaluation& plane : evaluation.planes) json["planes"].push_back(to_json(plane));
}

void add_trajectory(const std::optional<TrajectoryEvaluation>& evaluation, ordered_json& json) {
  if (!evaluation) {
    for (const char* key : {"trajectory", "reference", "trajectory_poses", "reference_poses",
                            "max_difference", "associated", "ate", "ate_anchored", "rpe"}) {
      json[key] = nullptr;
    }
    return;
  }
  const TrajectoryMetrics& metrics = evaluation->metrics;
  json["trajectory"] = evaluation->trajectory;
  json["reference"] = evaluation->reference;
  json["trajectory_poses"] = evaluation->trajectory_poses;
  json["reference_poses"] = evaluation->reference_poses;
  json["max_difference"] = evaluation->max_difference;
  json["associated"] = metrics.pairs.size();
  json["ate"] = to_json(metrics.aligned.statistics);
  json["ate_anchored"] = to_json(metrics.anchored.statistics);
  json["ate_anchored"]["end_translation"] = metrics.end.translation;
  json["ate_anchored"]["end_rotation_deg"] = degrees(metrics.end.rotation);
  json["rpe"] = {{"per_second", to_json(metrics.per_second)},
                 {"per_metre", to_json(metrics.per_metre)}};
}

}  // namespace

std::string evaluation_json(const Evaluation& evaluation) {
  ordered_json json;
  add_map(evaluation.map, json);
  add_trajectory(evaluation.trajectory, json);
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace geomap::logs
