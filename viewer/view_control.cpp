// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/view_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "viewer/picker.hpp"

namespace geomap::viewer {
namespace {

constexpr double kFlight = 0.45;    // [s]
constexpr double kZoomStep = 0.88;  // of the distance, for a step of the wheel
constexpr double kObliqueYaw = -2.2, kObliquePitch = 0.6;
constexpr double kFieldOfView = 0.85;  // of a camera that has not told its own [rad]

double yaw_of(const Eigen::Isometry3d& T_world_body) {
  const Eigen::Vector3d forward = T_world_body.linear().col(0);
  return std::atan2(forward.y(), forward.x());
}

}  // namespace

bool ViewControl::update(Clock::time_point now) {
  bool is_changed = follow_robot();
  is_changed |= look_from_robot();
  if (!flight_) return is_changed;
  const double share =
      std::clamp(std::chrono::duration<double>(now - flight_->begin).count() / kFlight, 0.0, 1.0);
  camera_.set(between(flight_->from, flight_->to, share * share * (3.0 - 2.0 * share)));
  if (share >= 1.0) flight_.reset();
  return true;
}

bool ViewControl::follow_robot() {
  if (follow_ == Follow::kFree) return false;
  const auto body = workbench_.scene().T_world_body();
  if (!body) return false;
  const std::optional<Eigen::Isometry3d> before = std::exchange(T_world_body_, body);
  if (!before || before->isApprox(*body, 1e-12)) return false;
  Viewpoint viewpoint = camera_.viewpoint();
  const Eigen::Vector3d offset = viewpoint.target - before->translation();
  double turn = 0.0;
  if (follow_ == Follow::kPositionAndYaw) turn = yaw_of(*body) - yaw_of(*before);
  viewpoint.target =
      body->translation() + Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()) * offset;
  viewpoint.yaw += turn;
  camera_.set(viewpoint);
  if (flight_) {  // lands where it would have, as seen from the robot
    const Eigen::Vector3d moved = body->translation() - before->translation();
    flight_->from.target += moved;
    flight_->to.target += moved;
  }
  return true;
}

bool ViewControl::look_from_robot() {
  const TrackLayer& track = workbench_.scene().track;
  const bool was_there = camera_.is_first_person();
  if (!is_first_person_ || !track.newest) {
    camera_.look_from(std::nullopt, 0.0);
    return was_there;
  }
  const Eigen::Vector3d eye = camera_.eye(), forward = camera_.forward();
  const double fov_y =
      track.camera ? 2.0 * std::atan(0.5 * track.camera->height / track.camera->fy) : kFieldOfView;
  camera_.look_from(track.newest->T_world_camera, fov_y);
  return !was_there || eye != camera_.eye() || forward != camera_.forward();
}

void ViewControl::land() {
  if (!flight_) return;
  camera_.set(flight_->to);
  flight_.reset();
}

void ViewControl::fly_to(const Viewpoint& viewpoint) {
  is_untouched_ = false;
  set_first_person(false);
  flight_ = Flight{camera_.viewpoint(), viewpoint, Clock::now()};
}

void ViewControl::fly_to(const Eigen::AlignedBox3d& box) { fly_to(camera_.fitting(box)); }

void ViewControl::fly_towards(const Eigen::Vector3d& point) {
  Viewpoint viewpoint = camera_.viewpoint();
  viewpoint.target = point;
  viewpoint.distance = std::max(1.0, 0.5 * viewpoint.distance);
  fly_to(viewpoint);
}

void ViewControl::show_all() { fly_to(workbench_.bounds()); }

void ViewControl::look_from_above() {
  Viewpoint viewpoint = camera_.viewpoint();
  viewpoint.pitch = std::numbers::pi / 2.0;
  viewpoint.yaw = -std::numbers::pi / 2.0;  // x to the right, y up
  viewpoint.projection = Projection::kOrthographic;
  camera_.set(viewpoint);
  show_all();
}

void ViewControl::look_obliquely() {
  Viewpoint viewpoint = camera_.viewpoint();
  viewpoint.pitch = kObliquePitch;
  viewpoint.yaw = kObliqueYaw;
  viewpoint.projection = Projection::kPerspective;
  camera_.set(viewpoint);
  show_all();
}

void ViewControl::toggle_projection() {
  Viewpoint viewpoint = camera_.viewpoint();
  viewpoint.projection = viewpoint.projection == Projection::kPerspective
                             ? Projection::kOrthographic
                             : Projection::kPerspective;
  camera_.set(viewpoint);
}

void ViewControl::set_follow(Follow follow) {
  follow_ = follow;
  T_world_body_ = workbench_.scene().T_world_body();
  if (follow == Follow::kFree || !T_world_body_) return;
  Viewpoint viewpoint = camera_.viewpoint();
  viewpoint.target = T_world_body_->translation();
  camera_.set(viewpoint);
}

void ViewControl::set_first_person(bool on) {
  is_first_person_ = on;
  look_from_robot();
}

bool ViewControl::go_to_bookmark(int number) {
  const auto found = bookmarks_.find(number);
  if (found == bookmarks_.end()) return false;
  fly_to(found->second);
  return true;
}

void ViewControl::load(const Preferences& preferences) {
  for (int number = 1; number <= 9; ++number) {
    const std::string text = preferences.get(fmt::format("bookmark.{}", number), std::string());
    if (const auto viewpoint = viewpoint_from(text)) bookmarks_[number] = *viewpoint;
  }
}

void ViewControl::store(Preferences& preferences) const {
  for (const auto& [number, viewpoint] : bookmarks_) {
    preferences.set(fmt::format("bookmark.{}", number), to_text(viewpoint));
  }
}

bool ViewControl::press(const ViewCamera&, const PointerEvent&) { return true; }

void ViewControl::drag(const ViewCamera&, const PointerEvent& event) {
  if (camera_.is_first_person()) return;
  flight_.reset();
  is_untouched_ = false;
  if (event.button == Button::kLeft) {
    camera_.orbit(event.moved.x(), event.moved.y());
  } else {
    camera_.pan(event.moved.x(), event.moved.y());
  }
}

bool ViewControl::double_click(const ViewCamera& camera, const PointerEvent& event) {
  if (event.button != Button::kLeft) return false;
  const auto hit = pick_feature(workbench_.surfaces(), camera, event.pixel);
  if (hit) fly_towards(hit->point);
  return hit.has_value();
}

bool ViewControl::scroll(const ViewCamera&, const PointerEvent& event, double steps) {
  if (camera_.is_first_person()) return false;
  flight_.reset();
  is_untouched_ = false;
  camera_.zoom(std::pow(kZoomStep, steps), event.pixel);
  return true;
}

std::string to_text(const Viewpoint& viewpoint) {
  const auto& target = viewpoint.target;
  return fmt::format(
      "{} {} {} {} {} {} {}", target.x(), target.y(), target.z(), viewpoint.distance, viewpoint.yaw,
      viewpoint.pitch,
      viewpoint.projection == Projection::kPerspective ? "perspective" : "orthographic");
}

std::optional<Viewpoint> viewpoint_from(const std::string& text) {
  std::istringstream in(text);
  Viewpoint viewpoint;
  std::string projection;
  in >> viewpoint.target.x() >> viewpoint.target.y() >> viewpoint.target.z() >>
      viewpoint.distance >> viewpoint.yaw >> viewpoint.pitch >> projection;
  const bool is_finite = viewpoint.target.allFinite() && std::isfinite(viewpoint.yaw) &&
                         std::isfinite(viewpoint.pitch) && viewpoint.distance > 0.0;
  if (in.fail() || !is_finite) return std::nullopt;
  if (projection == "orthographic") {
    viewpoint.projection = Projection::kOrthographic;
  } else if (projection != "perspective") {
    return std::nullopt;
  }
  return viewpoint;
}

}  // namespace geomap::viewer
