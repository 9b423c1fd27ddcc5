// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>

namespace geomap::viewer {

/// @brief A line of sight: from `origin` along `direction` (unit). World frame, metres.
struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
  Eigen::Vector3d at(double distance) const { return origin + distance * direction; }
};

enum class Projection { kPerspective, kOrthographic };

/// @brief A viewpoint, as numbers that can be kept: what bookmarks hold.
struct Viewpoint {
  Eigen::Vector3d target = Eigen::Vector3d::Zero();  // that it turns about, world frame [m]
  double distance = 5.0;                             // of the eye from it [m]
  double yaw = -2.2;   // of the direction from target to eye about z, from x [rad]
  double pitch = 0.6;  // of the same above the horizon, -pi/2 to pi/2 [rad]
  Projection projection = Projection::kPerspective;
  bool operator==(const Viewpoint&) const = default;
};

/// @brief The eye of the operator. Pixels count from the top left of the drawing; (0, 0) is the
/// corner, not a pixel's centre. The view frame is OpenGL's: x right, y up, z towards the eye.
class ViewCamera {
 public:
  /// @brief Size of the drawing [px], at least 1 x 1.
  void resize(int width, int height);
  int width() const { return width_; }
  int height() const { return height_; }

  const Viewpoint& viewpoint() const { return viewpoint_; }
  void set(const Viewpoint& viewpoint);

  /// @brief A pose to look from (camera optical) in place of the viewpoint; nothing: the viewpoint.
  void look_from(const std::optional<Eigen::Isometry3d>& T_world_camera, double fov_y);
  bool is_first_person() const { return first_person_.has_value(); }
  /// @brief Lines of sight are parallel: never so from a pose.
  bool is_orthographic() const;

  /// @brief Mouse motions [px]: turns about the target; shifts so that what is at the target's
  /// distance stays under the mouse.
  void orbit(double dx, double dy);
  void pan(double dx, double dy);
  /// @brief Towards what is under the pixel, by a factor below 1; away by one above.
  void zoom(double factor, const Eigen::Vector2d& pixel);
  /// @brief The whole box in view, from the direction that is now.
  Viewpoint fitting(const Eigen::AlignedBox3d& box) const;

  Eigen::Vector3d eye() const;
  Eigen::Vector3d forward() const;     // unit, into the picture
  Eigen::Matrix4d view() const;        // world -> view
  Eigen::Matrix4d projection() const;  // view -> clip, OpenGL's
  Eigen::Matrix4d view_projection() const { return projection() * view(); }

  Ray ray(const Eigen::Vector2d& pixel) const;
  /// @brief Pixel of a point, and nothing when it is behind the eye.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point) const;
  /// @brief Size of one pixel at a point [m].
  double metres_per_pixel(const Eigen::Vector3d& point) const;

  double fov_y() const { return fov_y_; }  // of the perspective view [rad]

 private:
  Eigen::Matrix3d axes() const;  // columns: right, up, back, world frame

  Viewpoint viewpoint_;
  std::optional<Eigen::Isometry3d> first_person_;
  double fov_y_ = 0.9, viewpoint_fov_y_ = 0.9;
  int width_ = 1280, height_ = 800;
};

/// @brief Part of the way from one viewpoint to another, share from 0 to 1, yaw the short way
/// round.
Viewpoint between(const Viewpoint& from, const Viewpoint& to, double share);

}  // namespace geomap::viewer
