// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map_messages.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "messaging/convert_geometry.hpp"

namespace geomap::mapping {
namespace {

// Overload set for std::visit.
struct EventWriter {
  geomap::map_event_t& message;

  void operator()(const std::shared_ptr<const Observation>& observation) const {
    message.kind = geomap::map_event_t::OBSERVATION;
    message.utime = message.keyframe = observation->keyframe;
    message.T_world_camera = messaging::to_message(observation->T_world_camera);
    for (const geometry::PlaneObservation& plane : observation->planes) {
      message.planes.push_back(messaging::to_message(plane));
    }
    message.n_planes = static_cast<std::int32_t>(message.planes.size());
  }
  void operator()(const KeyframeRemoval& removal) const {
    message.kind = geomap::map_event_t::KEYFRAME_REMOVAL;
    message.utime = message.keyframe = removal.keyframe;
  }
  void operator()(const PoseCorrection& correction) const {
    message.kind = geomap::map_event_t::POSE_CORRECTION;
    for (const auto& [keyframe, pose] : correction.poses) {
      message.corrections.push_back({keyframe, messaging::to_message(pose)});
      message.utime = std::max(message.utime, keyframe);
    }
    message.n_corrections = static_cast<std::int32_t>(message.corrections.size());
  }
  void operator()(const std::shared_ptr<const Edit>& edit) const {
    message.kind = geomap::map_event_t::EDIT;
    message.utime = edit->after;
    message.edits = {to_message(*edit)};
    message.n_edits = 1;
  }
};

}  // namespace

geomap::observation_id_t to_message(const ObservationId& id) { return {id.keyframe, id.plane}; }
ObservationId from_message(const geomap::observation_id_t& id) { return {id.keyframe, id.plane}; }

geomap::map_event_t to_message(const MapEvent& event) {
  geomap::map_event_t message{};
  message.T_world_camera = messaging::to_message(Eigen::Isometry3d::Identity());
  std::visit(EventWriter{message}, event);
  return message;
}

std::shared_ptr<const Observation> from_message(const geomap::plane_set_t& message) {
  auto planes = messaging::from_message(message);
  if (!planes) return nullptr;
  auto observation = std::make_shared<Observation>();
  observation->keyframe = planes->keyframe;
  observation->T_world_camera = planes->T_world_camera;
  observation->planes = std::move(planes->planes);
  return observation;
}

std::vector<MapEvent> from_message(const geomap::keyframe_update_t& message) {
  std::vector<MapEvent> events;
  PoseCorrection correction;
  for (const geomap::pose_correction_t& pose : message.corrections) {
    correction.poses.emplace_back(pose.keyframe, messaging::from_message(pose.T_world_camera));
  }
  if (!correction.poses.empty()) events.emplace_back(std::move(correction));
  for (const std::int64_t keyframe : message.removed) {
    events.emplace_back(KeyframeRemoval{keyframe});
  }
  return events;
}

std::optional<MapEvent> from_message(const geomap::map_event_t& message) {
  switch (message.kind) {
    case geomap::map_event_t::OBSERVATION: {
      auto observation = std::make_shared<Observation>();
      observation->keyframe = message.keyframe;
      observation->T_world_camera = messaging::from_message(message.T_world_camera);
      for (const geomap::plane_t& plane : message.planes) {
        auto decoded = messaging::from_message(plane);
        if (!decoded) return std::nullopt;
        observation->planes.push_back(std::move(*decoded));
      }
      return observation;
    }
    case geomap::map_event_t::KEYFRAME_REMOVAL:
      return KeyframeRemoval{message.keyframe};
    case geomap::map_event_t::POSE_CORRECTION: {
      PoseCorrection correction;
      for (const geomap::pose_correction_t& pose : message.corrections) {
        correction.poses.emplace_back(pose.keyframe, messaging::from_message(pose.T_world_camera));
      }
      return correction;
    }
    case geomap::map_event_t::EDIT: {
      if (message.edits.size() != 1) return std::nullopt;
      auto edit = from_message(message.edits.front());
      if (!edit) return std::nullopt;
      return std::make_shared<const Edit>(std::move(*edit));
    }
    default:
      return std::nullopt;
  }
}

geomap::edit_t to_message(const Edit& edit) {
  geomap::edit_t message{};
  message.number = edit.number;
  message.after = edit.after;
  message.kind = static_cast<std::int8_t>(edit.kind);
  message.author = edit.author;
  message.command = edit.command;
  message.utime = edit.utime;
  for (const std::vector<ObservationId>& observations : edit.targets) {
    geomap::edit_target_t target;
    for (const ObservationId& id : observations) target.observations.push_back(to_message(id));
    target.n_observations = static_cast<std::int32_t>(target.observations.size());
    message.targets.push_back(std::move(target));
  }
  message.n_targets = static_cast<std::int32_t>(message.targets.size());
  message.anchor = edit.anchor;
  message.T_world_anchor = messaging::to_message(edit.T_world_anchor);
  message.T_anchor_moved = messaging::to_message(edit.T_anchor_moved);
  for (const Eigen::Vector3d& point : edit.points) {
    message.points.push_back({{point.x(), point.y(), point.z()}});
  }
  message.n_points = static_cast<std::int32_t>(message.points.size());
  message.label = edit.label;
  message.keyframe = edit.keyframe;
  message.edits = edit.edits;
  message.n_edits = static_cast<std::int32_t>(message.edits.size());
  return message;
}

std::optional<Edit> from_message(const geomap::edit_t& message) {
  if (message.kind < 0 || message.kind > static_cast<std::int8_t>(kLastEditKind)) {
    return std::nullopt;
  }
  Edit edit;
  edit.number = message.number;
  edit.after = message.after;
  edit.kind = static_cast<EditKind>(message.kind);
  edit.author = message.author;
  edit.command = message.command;
  edit.utime = message.utime;
  for (const geomap::edit_target_t& target : message.targets) {
    std::vector<ObservationId>& observations = edit.targets.emplace_back();
    for (const geomap::observation_id_t& id : target.observations) {
      observations.push_back(from_message(id));
    }
  }
  edit.anchor = message.anchor;
  edit.T_world_anchor = messaging::from_message(message.T_world_anchor);
  edit.T_anchor_moved = messaging::from_message(message.T_anchor_moved);
  for (const geomap::point_t& point : message.points) edit.points.emplace_back(point.position);
  edit.label = message.label;
  edit.keyframe = message.keyframe;
  edit.edits = message.edits;
  return edit;
}

geomap::feature_state_t to_message(const MapFeature& feature) {
  geomap::feature_state_t message{};
  const std::array<double, 16> moments = feature.moments.to_array();
  const geometry::Plane& plane = feature.surface.plane;
  message.id = to_message(feature.id);
  std::copy(plane.normal.begin(), plane.normal.end(), message.normal);
  message.d = plane.d;
  message.frame = messaging::to_message(feature.surface.frame);
  message.polygon = messaging::to_message(feature.surface.polygon);
  std::copy(moments.begin(), moments.end(), message.moments);
  for (const ObservationId& id : feature.observations) {
    message.observations.push_back(to_message(id));
  }
  message.n_observations = static_cast<std::int32_t>(message.observations.size());
  message.inliers = feature.inliers;
  message.rms = feature.rms;
  message.sigma_angle = feature.sigma_angle;
  message.sigma_d = feature.sigma_d;
  std::copy(feature.color.begin(), feature.color.end(), message.color);
  message.label = feature.label;
  message.label_edit = feature.label_edit;
  message.other_labels = feature.other_labels;
  message.n_other_labels = static_cast<std::int32_t>(message.other_labels.size());
  message.held_by = feature.held_by;
  message.n_held_by = static_cast<std::int32_t>(message.held_by.size());
  return message;
}

std::optional<MapFeature> from_message(const geomap::feature_state_t& message) {
  MapFeature feature;
  std::array<double, 16> moments{};
  std::copy(std::begin(message.moments), std::end(message.moments), moments.begin());
  feature.id = from_message(message.id);
  feature.surface.plane = {Eigen::Vector3d(message.normal), message.d};
  feature.surface.frame = messaging::from_message(message.frame);
  feature.surface.polygon = messaging::from_message(message.polygon);
  feature.moments = geometry::PlaneMoments::from_array(moments);
  for (const geomap::observation_id_t& id : message.observations) {
    feature.observations.push_back(from_message(id));
  }
  feature.inliers = message.inliers;
  feature.rms = message.rms;
  feature.sigma_angle = message.sigma_angle;
  feature.sigma_d = message.sigma_d;
  std::copy(std::begin(message.color), std::end(message.color), feature.color.begin());
  feature.label = message.label;
  feature.label_edit = message.label_edit;
  feature.other_labels = message.other_labels;
  feature.held_by = message.held_by;

  const bool sound = !feature.observations.empty() && feature.observations.front() == feature.id &&
                     std::is_sorted(feature.observations.begin(), feature.observations.end()) &&
                     feature.moments.weight > 0.0 && feature.inliers > 0 &&
                     find_fault(feature.surface) == EventFault::kNone;
  if (!sound) return std::nullopt;
  return feature;
}

geomap::map_contents_t to_message(const MapContents& contents) {
  geomap::map_contents_t message{};
  for (const auto& [id, feature] : contents.features) {
    message.features.push_back(to_message(*feature));
  }
  message.n_features = static_cast<std::int32_t>(message.features.size());
  for (const auto& [key, veto] : contents.vetoes) {
    geomap::veto_state_t state;
    state.edit = veto->edit;
    state.cause = static_cast<std::int8_t>(veto->cause);
    state.feature = to_message(veto->feature);
    message.vetoes.push_back(std::move(state));
  }
  message.n_vetoes = static_cast<std::int32_t>(message.vetoes.size());
  for (const auto& [number, reason] : contents.idle_edits) {
    message.idle_edits.push_back({number, reason});
  }
  message.n_idle_edits = static_cast<std::int32_t>(message.idle_edits.size());
  return message;
}

std::optional<MapContents> from_message(const geomap::map_contents_t& message,
                                        const MergeConfig& config) {
  MapContents contents;
  for (const geomap::feature_state_t& state : message.features) {
    auto feature = from_message(state);
    if (!feature) return std::nullopt;
    const FeatureId id = feature->id;
    contents.features.emplace(id, std::make_shared<const MapFeature>(std::move(*feature)));
  }
  for (const geomap::veto_state_t& state : message.vetoes) {
    const auto feature = from_message(state.feature);
    const bool is_known =
        state.cause >= 0 && state.cause <= static_cast<std::int8_t>(kLastVetoCause);
    if (!feature || !is_known) return std::nullopt;
    add_veto(state.edit, static_cast<VetoCause>(state.cause), *feature, config, contents.vetoes);
  }
  for (const geomap::idle_edit_t& idle : message.idle_edits) {
    contents.idle_edits.emplace(idle.number, idle.reason);
  }
  return contents;
}

}  // namespace geomap::mapping
