// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <set>

#include "viewer/tool.hpp"
#include "viewer/workbench.hpp"

namespace geomap::viewer {

/// @brief Colours of the handles: normal, sideways, across.
inline constexpr std::array<Rgba, 3> kAxisColors = {kPalette[1], kPalette[0], kPalette[6]};

/// @brief A motion as six numbers about a frame: shifts along its axes, then, in place, turns about
/// them one after the other.
struct MotionNumbers {
  std::array<double, 3> shift{};  // [m]
  std::array<double, 3> turn{};   // [rad]
  bool operator==(const MotionNumbers&) const = default;
};

/// @brief Maps points to where the motion takes them. @param axes columns: axes 0, 1 and 2, unit.
Eigen::Isometry3d motion_of(const MotionNumbers& numbers, const Eigen::Vector3d& center,
                            const Eigen::Matrix3d& axes);

/// @brief Moves the selected features by handles or numbers: axis 0 is the normal of the first one,
/// 1 and 2 lie in its plane. What is tried is shown; Enter asks the mapper for it.
class MoveTool : public Tool {
 public:
  explicit MoveTool(Workbench& workbench) : workbench_(workbench) {}

  const MotionNumbers& numbers() const { return numbers_; }
  void set(const MotionNumbers& numbers);

  std::string begin() override;
  void end() override { workbench_.preview(std::nullopt); }
  std::string hint() const override;
  void add_overlay(const ViewCamera& camera, const Theme& theme, Overlay& overlay) const override;
  bool accept() override;
  bool is_done() const override { return is_done_ || workbench_.selected() != targets_; }

  std::optional<double> pick(const ViewCamera& camera, const PointerEvent& event) override;
  void hover(const ViewCamera& camera, const PointerEvent& event, bool is_nearest) override;
  bool press(const ViewCamera& camera, const PointerEvent& event) override;
  void drag(const ViewCamera& camera, const PointerEvent& event) override;
  void release(const ViewCamera& camera, const PointerEvent& event) override;

 private:
  struct Handle {
    bool is_ring = false;  // turns; else shifts
    int axis = 0;
    bool operator==(const Handle&) const = default;
  };

  std::optional<Handle> handle_at(const ViewCamera& camera, const Eigen::Vector2d& pixel) const;
  std::vector<Eigen::Vector3d> shape_of(const ViewCamera& camera, const Handle& handle) const;
  std::optional<double> value_at(const ViewCamera& camera, const Eigen::Vector2d& pixel,
                                 const Handle& handle) const;
  Eigen::Vector3d center_now() const;

  Workbench& workbench_;
  std::set<mapping::FeatureId> targets_;  // when another selection takes their place it ends
  MotionNumbers numbers_;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();
  std::optional<Handle> hovered_, held_;
  double held_value_ = 0.0;  // under the mouse when it was taken [m] or [rad]
  MotionNumbers before_;     // the drag
  Eigen::Vector3d held_center_ = Eigen::Vector3d::Zero();
  bool is_done_ = false;
};

}  // namespace geomap::viewer
