// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/draw_tool.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "viewer/picker.hpp"

namespace geomap::viewer {
namespace {

constexpr double kClosePixels = 10.0;  // to the first corner: the polygon is whole
constexpr double kLeastSide = 0.01;    // of a rectangle [m]

bool needs_target(DrawKind kind) { return kind == DrawKind::kSplit || kind == DrawKind::kCut; }

const char* name_of(DrawKind kind) {
  switch (kind) {
    case DrawKind::kSplit:
      return "Split";
    case DrawKind::kCut:
      return "Cut";
    case DrawKind::kAdd:
      return "New rectangle";
    case DrawKind::kMeasure:
      return "Measure";
  }
  return "";
}

}  // namespace

std::string DrawTool::begin() {
  target_.reset();
  plane_.reset();
  points_.clear();
  next_.reset();
  is_done_ = false;
  const auto& selected = workbench_.selected();
  if (needs_target(kind_)) {
    if (selected.size() != 1) return fmt::format("{}: select one polygon first", name_of(kind_));
    target_ = *selected.begin();
  }
  if (selected.size() == 1 && kind_ != DrawKind::kMeasure) {
    if (const Surface* surface = workbench_.surfaces().find(*selected.begin())) {
      plane_ = surface->polygon.plane;
    }
  }
  return "";
}

std::string DrawTool::hint() const {
  switch (kind_) {
    case DrawKind::kSplit:
      return points_.empty() ? "Split: click where the line begins"
                             : "Split: click where the line ends. Esc leaves it";
    case DrawKind::kCut:
      return points_.size() < 3
                 ? "Cut: click the corners of the piece. Backspace takes one back, Esc leaves it"
                 : "Cut: more corners, or Enter (or the first corner) to cut. Esc leaves it";
    case DrawKind::kAdd:
      return points_.empty() ? "New rectangle: click its first corner on a plane"
                             : "New rectangle: click the opposite corner. Esc leaves it";
    case DrawKind::kMeasure:
      return points_.size() < 2 ? "Measure: click two points. Esc leaves it"
                                : "Measure: click for another distance. Esc leaves it";
  }
  return "";
}

// On the plane that is drawn on; measured is on what is under the mouse, a new rectangle begins
// there, and where nothing is on the ground.
std::optional<Eigen::Vector3d> DrawTool::point_at(const ViewCamera& camera,
                                                  const Eigen::Vector2d& pixel) {
  const Ray ray = camera.ray(pixel);
  if (!plane_) {
    const auto hit = pick_feature(workbench_.surfaces(), camera, pixel);
    if (hit) return hit->point;
  }
  const auto distance =
      distance_to_plane(ray, plane_.value_or(geometry::Plane{Eigen::Vector3d::UnitZ(), 0.0}));
  if (!distance) return std::nullopt;
  return ray.at(*distance);
}

void DrawTool::hover(const ViewCamera& camera, const PointerEvent& event, bool) {
  next_ = point_at(camera, event.pixel);
}

bool DrawTool::click(const ViewCamera& camera, const PointerEvent& event) {
  if (event.button != Button::kLeft) return false;
  const auto point = point_at(camera, event.pixel);
  if (!point) {
    workbench_.tell(Level::kDegraded, "there is no plane under the mouse to draw on");
    return true;
  }
  eye_direction_ = -camera.ray(event.pixel).direction;
  if (kind_ == DrawKind::kMeasure && points_.size() == 2) points_.clear();
  if (kind_ == DrawKind::kAdd && points_.empty() && !plane_) {
    const auto hit = pick_feature(workbench_.surfaces(), camera, event.pixel);
    plane_ = hit ? workbench_.surfaces().find(hit->id)->polygon.plane
                 : geometry::Plane{Eigen::Vector3d::UnitZ(), 0.0};
  }
  if (kind_ == DrawKind::kCut && points_.size() >= 3) {
    const auto first = camera.project(points_.front());
    if (first && (*first - event.pixel).norm() < kClosePixels) {
      finish();
      return true;
    }
  }
  points_.push_back(*point);
  const bool is_whole =
      points_.size() == 2 && (kind_ == DrawKind::kSplit || kind_ == DrawKind::kAdd);
  if (is_whole) finish();
  return true;
}

bool DrawTool::accept() {
  if (kind_ != DrawKind::kCut || points_.size() < 3) return false;
  finish();
  return true;
}

bool DrawTool::step_back() {
  if (points_.empty()) return false;
  points_.pop_back();
  if (points_.empty() && kind_ == DrawKind::kAdd && workbench_.selected().size() != 1) {
    plane_.reset();
  }
  return true;
}

void DrawTool::finish() {
  if (kind_ == DrawKind::kSplit) workbench_.split(*target_, points_[0], points_[1]);
  if (kind_ == DrawKind::kCut) workbench_.cut(*target_, points_);
  if (kind_ == DrawKind::kAdd) {
    const auto corners = rectangle(points_[0], points_[1]);
    if (corners.empty()) {
      workbench_.tell(Level::kDegraded, "a rectangle needs two corners that lie apart both ways");
      points_.pop_back();
      return;
    }
    workbench_.add(corners);
  }
  points_.clear();
  is_done_ = true;
}

// Its sides are level and upright where the plane is steep, along the world's axes where it is
// flat.
std::vector<Eigen::Vector3d> DrawTool::rectangle(const Eigen::Vector3d& a,
                                                 const Eigen::Vector3d& b) const {
  const Eigen::Vector3d towards_eye =
      plane_->normal.dot(eye_direction_) < 0.0 ? -plane_->normal : plane_->normal;
  Eigen::Vector3d along = Eigen::Vector3d::UnitZ().cross(towards_eye);
  if (along.norm() < 0.1) along = Eigen::Vector3d::UnitY().cross(towards_eye);
  along.normalize();
  const Eigen::Vector3d across = towards_eye.cross(along);
  const double width = (b - a).dot(along), height = (b - a).dot(across);
  if (std::min(std::abs(width), std::abs(height)) < kLeastSide) return {};
  std::vector<Eigen::Vector3d> corners = {a, a + width * along, a + width * along + height * across,
                                          a + height * across};
  if (width * height < 0.0) std::reverse(corners.begin(), corners.end());
  return corners;
}

// What is drawn so far, with what a click now would add.
std::vector<Eigen::Vector3d> DrawTool::outline() const {
  std::vector<Eigen::Vector3d> points = points_;
  const bool is_whole = kind_ == DrawKind::kMeasure && points.size() == 2;
  if (next_ && !is_whole) points.push_back(*next_);
  if (kind_ == DrawKind::kAdd && points.size() == 2 && plane_) {
    points = rectangle(points[0], points[1]);
    if (!points.empty()) points.push_back(points.front());
  }
  if (kind_ == DrawKind::kCut && points.size() > 2) points.push_back(points.front());
  return points;
}

void DrawTool::add_overlay(const ViewCamera&, const Theme& theme, Overlay& overlay) const {
  const auto points = outline();
  for (std::size_t i = 0; i < points.size(); ++i) {
    overlay.dots.push_back({points[i], theme.selected, 4.0F});
    if (i > 0) overlay.lines.push_back({points[i - 1], points[i], theme.selected, 2.5F});
  }
  if (kind_ == DrawKind::kMeasure && points.size() == 2) {
    const Eigen::Vector3d apart = points[1] - points[0];
    overlay.texts.push_back({0.5 * (points[0] + points[1]),
                             fmt::format("{:.3f} m (level {:.3f}, up {:.3f})", apart.norm(),
                                         apart.head<2>().norm(), apart.z()),
                             theme.foreground});
  }
  if (kind_ == DrawKind::kAdd && points.size() == 5) {
    overlay.texts.push_back({points[2],
                             fmt::format("{:.2f} m x {:.2f} m", (points[1] - points[0]).norm(),
                                         (points[2] - points[1]).norm()),
                             theme.foreground});
  }
}

}  // namespace geomap::viewer
