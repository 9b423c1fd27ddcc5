// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "viewer/view_camera.hpp"

namespace geomap::viewer {

enum class Button { kLeft, kRight, kMiddle };

/// @brief Where the mouse is and what is held down.
struct PointerEvent {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // of the drawing
  Eigen::Vector2d moved = Eigen::Vector2d::Zero();  // since the last event [px]
  Button button = Button::kLeft;
  bool shift = false, control = false;
};

/// @brief Something that mouse events can mean something to.
///
/// Picking contract: before a press, click or hover, every handler is asked for the distance along
/// the line of sight to the nearest thing of its own under the mouse; things that are drawn over
/// all others say 0. The handler with the smallest distance comes first, then the others in the
/// order in which they were added. Whoever returns true has consumed the event: nobody after him
/// hears of it, and of a press the consumer alone gets the drags and the release.
class EventHandler {
 public:
  virtual ~EventHandler() = default;

  /// @brief Distance [m] to its nearest thing; nothing: it has none there.
  virtual std::optional<double> pick(const ViewCamera&, const PointerEvent&) { return {}; }
  /// @brief Told to every handler, as the mouse moves without a button. @param is_nearest of all
  /// that were picked.
  virtual void hover(const ViewCamera&, const PointerEvent&, bool is_nearest) {
    static_cast<void>(is_nearest);
  }
  virtual bool press(const ViewCamera&, const PointerEvent&) { return false; }
  virtual void drag(const ViewCamera&, const PointerEvent&) {}
  virtual void release(const ViewCamera&, const PointerEvent&) {}
  /// @brief A press and release at one place; comes after the release.
  virtual bool click(const ViewCamera&, const PointerEvent&) { return false; }
  virtual bool double_click(const ViewCamera&, const PointerEvent&) { return false; }
  /// @param steps of the wheel, away from the operator positive.
  virtual bool scroll(const ViewCamera&, const PointerEvent&, double steps) {
    static_cast<void>(steps);
    return false;
  }
};

/// @brief Hands events to handlers as the contract says. Handlers outlive it.
class EventDispatcher {
 public:
  /// @brief Those who are asked from now on. A drag ends whose owner is no longer among them.
  void set_handlers(std::vector<EventHandler*> handlers);

  void hover(const ViewCamera& camera, const PointerEvent& event);
  void press(const ViewCamera& camera, const PointerEvent& event);
  void drag(const ViewCamera& camera, const PointerEvent& event);
  void release(const ViewCamera& camera, const PointerEvent& event);
  void double_click(const ViewCamera& camera, const PointerEvent& event);
  void scroll(const ViewCamera& camera, const PointerEvent& event, double steps);
  bool is_dragging() const { return is_pressed_; }

 private:
  std::vector<EventHandler*> in_order(const ViewCamera& camera, const PointerEvent& event) const;

  std::vector<EventHandler*> handlers_;
  EventHandler* owner_ = nullptr;  // of the drag
  bool is_pressed_ = false;
  PointerEvent pressed_;
  double travelled_ = 0.0;  // since the press [px]
};

}  // namespace geomap::viewer
