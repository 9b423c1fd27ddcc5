// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/select_tool.hpp"

#include "viewer/picker.hpp"

namespace geomap::viewer {

void SelectTool::add_overlay(Overlay& overlay) const { overlay.rectangle = rectangle_; }

std::optional<double> SelectTool::pick(const ViewCamera& camera, const PointerEvent& event) {
  const auto hit = pick_feature(workbench_.surfaces(), camera, event.pixel);
  if (!hit) return std::nullopt;
  return hit->distance;
}

void SelectTool::hover(const ViewCamera& camera, const PointerEvent& event, bool is_nearest) {
  const auto hit =
      is_nearest ? pick_feature(workbench_.surfaces(), camera, event.pixel) : std::optional<Hit>();
  workbench_.hover(hit ? std::optional(hit->id) : std::nullopt);
}

bool SelectTool::press(const ViewCamera&, const PointerEvent& event) {
  if (event.button != Button::kLeft || !event.shift) return false;
  first_corner_ = event.pixel;
  return true;
}

void SelectTool::drag(const ViewCamera&, const PointerEvent& event) {
  rectangle_.emplace(first_corner_);
  rectangle_->extend(event.pixel);
}

void SelectTool::release(const ViewCamera& camera, const PointerEvent& event) {
  if (!rectangle_) return;
  const auto inside = features_inside(workbench_.surfaces(), camera, *rectangle_);
  if (event.control) {
    workbench_.add_to_selection(inside);
  } else {
    workbench_.select(inside);
  }
  rectangle_.reset();
}

bool SelectTool::click(const ViewCamera& camera, const PointerEvent& event) {
  if (event.button != Button::kLeft) return false;
  const auto hit = pick_feature(workbench_.surfaces(), camera, event.pixel);
  if (hit && (event.control || event.shift)) {
    workbench_.toggle(hit->id);
  } else if (hit) {
    workbench_.select({hit->id});
  } else if (!event.control && !event.shift) {
    workbench_.select({});
  }
  return true;
}

}  // namespace geomap::viewer
