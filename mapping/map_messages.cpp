// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map_messages.hpp"

#include <algorithm>
#include <array>

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
    default:
      return std::nullopt;
  }
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

  const bool sound = !feature.observations.empty() && feature.observations.front() == feature.id &&
                     std::is_sorted(feature.observations.begin(), feature.observations.end()) &&
                     feature.moments.weight > 0.0 && feature.inliers > 0 &&
                     find_fault(feature.surface) == EventFault::kNone;
  if (!sound) return std::nullopt;
  return feature;
}

}  // namespace geomap::mapping
