// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/event_handler.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace geomap::viewer {
namespace {

constexpr double kStill = 4.0;  // a click may wander [px]

struct Picked {
  EventHandler* handler;
  double distance;
};

}  // namespace

std::vector<EventHandler*> EventDispatcher::in_order(const ViewCamera& camera,
                                                     const PointerEvent& event) const {
  std::vector<Picked> picked;
  for (EventHandler* handler : handlers_) {
    picked.push_back(
        {handler, handler->pick(camera, event).value_or(std::numeric_limits<double>::infinity())});
  }
  const auto nearest =
      std::min_element(picked.begin(), picked.end(),
                       [](const Picked& a, const Picked& b) { return a.distance < b.distance; });
  if (nearest != picked.end()) std::rotate(picked.begin(), nearest, nearest + 1);
  std::vector<EventHandler*> handlers;
  for (const Picked& each : picked) handlers.push_back(each.handler);
  return handlers;
}

void EventDispatcher::set_handlers(std::vector<EventHandler*> handlers) {
  handlers_ = std::move(handlers);
  if (std::find(handlers_.begin(), handlers_.end(), owner_) == handlers_.end()) owner_ = nullptr;
}

void EventDispatcher::hover(const ViewCamera& camera, const PointerEvent& event) {
  bool is_nearest = true;
  for (EventHandler* handler : in_order(camera, event)) {
    const bool has_something = handler->pick(camera, event).has_value();
    handler->hover(camera, event, is_nearest && has_something);
    is_nearest = false;
  }
}

void EventDispatcher::press(const ViewCamera& camera, const PointerEvent& event) {
  if (is_pressed_) return;  // a second button during a drag
  is_pressed_ = true;
  pressed_ = event;
  travelled_ = 0.0;
  owner_ = nullptr;
  for (EventHandler* handler : in_order(camera, event)) {
    if (!handler->press(camera, event)) continue;
    owner_ = handler;
    break;
  }
}

void EventDispatcher::drag(const ViewCamera& camera, const PointerEvent& event) {
  if (!is_pressed_ || event.button != pressed_.button) return;
  travelled_ += event.moved.norm();
  // Until it is no click, nothing moves.
  if (owner_ && travelled_ > kStill) owner_->drag(camera, event);
}

void EventDispatcher::release(const ViewCamera& camera, const PointerEvent& event) {
  if (!is_pressed_ || event.button != pressed_.button) return;
  is_pressed_ = false;
  if (owner_) owner_->release(camera, event);
  if (travelled_ > kStill) return;
  for (EventHandler* handler : in_order(camera, event)) {
    if (handler->click(camera, event)) break;
  }
}

void EventDispatcher::double_click(const ViewCamera& camera, const PointerEvent& event) {
  for (EventHandler* handler : in_order(camera, event)) {
    if (handler->double_click(camera, event)) break;
  }
}

void EventDispatcher::scroll(const ViewCamera& camera, const PointerEvent& event, double steps) {
  for (EventHandler* handler : in_order(camera, event)) {
    if (handler->scroll(camera, event, steps)) break;
  }
}

}  // namespace geomap::viewer
