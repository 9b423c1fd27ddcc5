// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "viewer/tool.hpp"
#include "viewer/workbench.hpp"

namespace geomap::viewer {

/// @brief Points at and selects features: a click one, with Ctrl more, Shift and a drag all that
/// are whole inside a rectangle. Always at work, behind the other tools.
class SelectTool : public EventHandler {
 public:
  explicit SelectTool(Workbench& workbench) : workbench_(workbench) {}

  void add_overlay(Overlay& overlay) const;

  std::optional<double> pick(const ViewCamera& camera, const PointerEvent& event) override;
  void hover(const ViewCamera& camera, const PointerEvent& event, bool is_nearest) override;
  bool press(const ViewCamera& camera, const PointerEvent& event) override;
  void drag(const ViewCamera& camera, const PointerEvent& event) override;
  void release(const ViewCamera& camera, const PointerEvent& event) override;
  bool click(const ViewCamera& camera, const PointerEvent& event) override;

 private:
  Workbench& workbench_;
  Eigen::Vector2d first_corner_ = Eigen::Vector2d::Zero();
  std::optional<Eigen::AlignedBox2d> rectangle_;
};

}  // namespace geomap::viewer
