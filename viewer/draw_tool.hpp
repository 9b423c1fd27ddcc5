// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "viewer/tool.hpp"
#include "viewer/workbench.hpp"

namespace geomap::viewer {

enum class DrawKind { kSplit, kCut, kAdd, kMeasure };

/// @brief Draws on a plane, click by click: a line that splits the selected feature, a polygon that
/// is cut out of it, a new rectangle, or a distance to be measured.
class DrawTool : public Tool {
 public:
  DrawTool(DrawKind kind, Workbench& workbench) : kind_(kind), workbench_(workbench) {}

  std::string begin() override;
  std::string hint() const override;
  void add_overlay(const ViewCamera& camera, const Theme& theme, Overlay& overlay) const override;
  bool accept() override;
  bool step_back() override;
  bool is_done() const override { return is_done_; }

  std::optional<double> pick(const ViewCamera&, const PointerEvent&) override { return 0.0; }
  void hover(const ViewCamera& camera, const PointerEvent& event, bool is_nearest) override;
  bool click(const ViewCamera& camera, const PointerEvent& event) override;
  /// @brief Two quick corners are no wish to fly.
  bool double_click(const ViewCamera&, const PointerEvent&) override { return true; }

 private:
  std::optional<Eigen::Vector3d> point_at(const ViewCamera& camera, const Eigen::Vector2d& pixel);
  std::vector<Eigen::Vector3d> rectangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;
  std::vector<Eigen::Vector3d> outline() const;
  void finish();

  DrawKind kind_;
  Workbench& workbench_;
  std::optional<mapping::FeatureId> target_;                  // of a split or a cut
  std::optional<geometry::Plane> plane_;                      // that is drawn on
  Eigen::Vector3d eye_direction_ = Eigen::Vector3d::UnitZ();  // towards the eye, at the last click
  std::vector<Eigen::Vector3d> points_;
  std::optional<Eigen::Vector3d> next_;  // under the mouse
  bool is_done_ = false;
};

}  // namespace geomap::viewer
