// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/move_tool.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "viewer/picker.hpp"

namespace geomap::viewer {
namespace {

constexpr double kArrowPixels = 90.0, kRingPixels = 64.0, kGripPixels = 9.0, kArrowsFirst = 4.0;
constexpr int kRingPieces = 48;
constexpr double kFarthest = 10'000.0;  // of a motion [m] or [rad]
constexpr double kRingEdgeOn = 0.1;     // a ring seen so flat cannot be turned by

}  // namespace

Eigen::Isometry3d motion_of(const MotionNumbers& numbers, const Eigen::Vector3d& center,
                            const Eigen::Matrix3d& axes) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const auto number = static_cast<std::size_t>(i);
    turn = Eigen::AngleAxisd(numbers.turn[number], axes.col(i)).toRotationMatrix() * turn;
    shift += numbers.shift[number] * axes.col(i);
  }
  Eigen::Isometry3d T_world_moved = Eigen::Isometry3d::Identity();
  T_world_moved.linear() = turn;
  T_world_moved.translation() = center + shift - turn * center;
  return T_world_moved;
}

std::string MoveTool::begin() {
  if (workbench_.selected().empty()) return "Move: select a polygon first";
  const Surface* first = workbench_.surfaces().find(*workbench_.selected().begin());
  if (!first) return "Move: that polygon is gone";
  targets_ = workbench_.selected();
  center_ = first->centroid;
  axes_.col(0) = first->polygon.plane.normal;
  // Level or upright where that is possible, whatever the feature's own frame is.
  const Eigen::Vector3d level = Eigen::Vector3d::UnitZ().cross(axes_.col(0));
  axes_.col(1) = level.norm() > 0.1 ? level.normalized()
                                    : axes_.col(0).cross(Eigen::Vector3d::UnitY()).normalized();
  axes_.col(2) = axes_.col(0).cross(axes_.col(1));
  is_done_ = false;
  held_.reset();
  hovered_.reset();
  set({});
  return "";
}

void MoveTool::set(const MotionNumbers& numbers) {
  for (const double number : {numbers.shift[0], numbers.shift[1], numbers.shift[2], numbers.turn[0],
                              numbers.turn[1], numbers.turn[2]}) {
    if (!(std::abs(number) <= kFarthest)) return;
  }
  numbers_ = numbers;
  workbench_.preview(motion_of(numbers_, center_, axes_));
}

std::string MoveTool::hint() const {
  return "Move: drag an arrow or a ring, or type numbers at the right. Enter moves, Esc leaves it";
}

bool MoveTool::accept() {
  if (numbers_ == MotionNumbers{}) return false;
  is_done_ = true;
  workbench_.move(motion_of(numbers_, center_, axes_));
  return true;
}

Eigen::Vector3d MoveTool::center_now() const {
  const Eigen::Map<const Eigen::Vector3d> shift(numbers_.shift.data());
  return center_ + axes_ * shift;
}

std::vector<Eigen::Vector3d> MoveTool::shape_of(const ViewCamera& camera,
                                                const Handle& handle) const {
  const Eigen::Vector3d center = center_now();
  const double pixel = camera.metres_per_pixel(center);
  if (!handle.is_ring) return {center, center + kArrowPixels * pixel * axes_.col(handle.axis)};
  std::vector<Eigen::Vector3d> ring;
  const Eigen::Vector3d a = axes_.col((handle.axis + 1) % 3), b = axes_.col((handle.axis + 2) % 3);
  for (int i = 0; i <= kRingPieces; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kRingPieces;
    ring.push_back(center + kRingPixels * pixel * (std::cos(angle) * a + std::sin(angle) * b));
  }
  return ring;
}

std::optional<MoveTool::Handle> MoveTool::handle_at(const ViewCamera& camera,
                                                    const Eigen::Vector2d& pixel) const {
  std::optional<Handle> nearest;
  double best = kGripPixels;
  for (const bool is_ring : {false, true}) {
    for (int axis = 0; axis < 3; ++axis) {
      const Handle handle{is_ring, axis};
      const auto shape = shape_of(camera, handle);
      for (std::size_t i = 1; i < shape.size(); ++i) {
        const auto a = camera.project(shape[i - 1]), b = camera.project(shape[i]);
        if (!a || !b) continue;
        // Arrows begin in one point: there nobody could tell which one is meant.
        const Eigen::Vector2d begin = is_ring ? *a : *a + 0.25 * (*b - *a);
        // Where a ring crosses an arrow's tip the arrow is meant.
        const double distance =
            distance_to_segment(pixel, begin, *b) + (is_ring ? kArrowsFirst : 0.0);
        if (distance >= best) continue;
        best = distance;
        nearest = handle;
      }
    }
  }
  return nearest;
}

// Where along the axis, or at which angle about it, the mouse points.
std::optional<double> MoveTool::value_at(const ViewCamera& camera, const Eigen::Vector2d& pixel,
                                         const Handle& handle) const {
  const Ray ray = camera.ray(pixel);
  const Eigen::Vector3d axis = axes_.col(handle.axis);
  if (handle.is_ring) {
    if (std::abs(axis.dot(ray.direction)) < kRingEdgeOn) return std::nullopt;
    const auto distance = distance_to_plane(ray, geometry::Plane::through(held_center_, axis));
    if (!distance) return std::nullopt;
    const Eigen::Vector3d arm = ray.at(*distance) - held_center_;
    return std::atan2(arm.dot(axes_.col((handle.axis + 2) % 3)),
                      arm.dot(axes_.col((handle.axis + 1) % 3)));
  }
  // The point of the axis that is nearest to the line of sight.
  const double cosine = axis.dot(ray.direction);
  const double squared_sine = 1.0 - cosine * cosine;
  if (squared_sine < 1e-4) return std::nullopt;
  const Eigen::Vector3d apart = ray.origin - held_center_;
  return (apart.dot(axis) - cosine * apart.dot(ray.direction)) / squared_sine;
}

std::optional<double> MoveTool::pick(const ViewCamera& camera, const PointerEvent& event) {
  if (!handle_at(camera, event.pixel)) return std::nullopt;
  return 0.0;
}

void MoveTool::hover(const ViewCamera& camera, const PointerEvent& event, bool is_nearest) {
  hovered_ = is_nearest ? handle_at(camera, event.pixel) : std::nullopt;
}

bool MoveTool::press(const ViewCamera& camera, const PointerEvent& event) {
  if (event.button != Button::kLeft) return false;
  held_ = handle_at(camera, event.pixel);
  if (!held_) return false;
  held_center_ = center_now();
  before_ = numbers_;
  const auto value = value_at(camera, event.pixel, *held_);
  if (!value) held_.reset();
  held_value_ = value.value_or(0.0);
  return true;
}

void MoveTool::drag(const ViewCamera& camera, const PointerEvent& event) {
  if (!held_) return;
  const auto value = value_at(camera, event.pixel, *held_);
  if (!value) return;
  MotionNumbers numbers = numbers_;
  const auto axis = static_cast<std::size_t>(held_->axis);
  if (held_->is_ring) {
    numbers.turn[axis] =
        std::remainder(before_.turn[axis] + *value - held_value_, 2.0 * std::numbers::pi);
  } else {
    numbers.shift[axis] = before_.shift[axis] + *value - held_value_;
  }
  set(numbers);
}

void MoveTool::release(const ViewCamera&, const PointerEvent&) { held_.reset(); }

void MoveTool::add_overlay(const ViewCamera& camera, const Theme& theme, Overlay& overlay) const {
  for (const bool is_ring : {true, false}) {
    for (int axis = 0; axis < 3; ++axis) {
      const Handle handle{is_ring, axis};
      const bool is_marked = held_ ? *held_ == handle : hovered_ == handle;
      const Rgba color = is_marked ? theme.hovered : kAxisColors[static_cast<std::size_t>(axis)];
      const auto shape = shape_of(camera, handle);
      for (std::size_t i = 1; i < shape.size(); ++i) {
        overlay.lines.push_back({shape[i - 1], shape[i], color, is_ring ? 2.0F : 3.5F});
      }
      if (!is_ring) overlay.dots.push_back({shape.back(), color, 6.0F});
    }
  }
}

}  // namespace geomap::viewer
