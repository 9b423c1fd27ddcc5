// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>

#include "viewer/event_handler.hpp"
#include "viewer/preferences.hpp"
#include "viewer/workbench.hpp"

namespace geomap::viewer {

/// @brief How the view goes with the robot.
enum class Follow { kFree, kPosition, kPositionAndYaw };

/// @brief Moves the operator's eye: by the mouse, in smooth flights, after the robot, to bookmarks.
class ViewControl : public EventHandler {
 public:
  explicit ViewControl(const Workbench& workbench) : workbench_(workbench) {}

  ViewCamera& camera() { return camera_; }
  const ViewCamera& camera() const { return camera_; }

  /// @brief Goes on with a flight and after the robot. @return true when the view has changed.
  bool update(Clock::time_point now);
  bool is_flying() const { return flight_.has_value(); }
  /// @brief Ends a flight at once, where it was to end.
  void land();

  /// @brief Smoothly there, within half a second.
  void fly_to(const Viewpoint& viewpoint);
  void fly_to(const Eigen::AlignedBox3d& box);
  /// @brief Towards a point, halving the distance.
  void fly_towards(const Eigen::Vector3d& point);
  void show_all();  // smoothly
  /// @brief Shows a box without a flight. Not as the operator's wish.
  void show_at_once(const Eigen::AlignedBox3d& box) { camera_.set(camera_.fitting(box)); }
  /// @brief True until the operator has chosen where to look, or to follow the robot.
  bool is_untouched() const { return is_untouched_ && follow_ == Follow::kFree; }
  void look_from_above();
  void look_obliquely();
  void toggle_projection();

  Follow follow() const { return follow_; }
  void set_follow(Follow follow);
  /// @brief From the robot's camera, as long as it is on.
  bool is_first_person() const { return is_first_person_; }
  void set_first_person(bool on);

  /// @brief Numbered viewpoints, from 1 to 9, kept in the preferences.
  void store_bookmark(int number) { bookmarks_[number] = camera_.viewpoint(); }
  bool go_to_bookmark(int number);
  void load(const Preferences& preferences);
  void store(Preferences& preferences) const;

  bool press(const ViewCamera&, const PointerEvent& event) override;
  void drag(const ViewCamera&, const PointerEvent& event) override;
  bool double_click(const ViewCamera& camera, const PointerEvent& event) override;
  bool scroll(const ViewCamera& camera, const PointerEvent& event, double steps) override;

 private:
  struct Flight {
    Viewpoint from, to;
    Clock::time_point begin;
  };

  bool follow_robot();
  bool look_from_robot();

  const Workbench& workbench_;
  ViewCamera camera_;
  std::optional<Flight> flight_;
  bool is_untouched_ = true;
  Follow follow_ = Follow::kFree;
  std::optional<Eigen::Isometry3d> T_world_body_;  // when it was last followed
  bool is_first_person_ = false;
  std::map<int, Viewpoint> bookmarks_;
};

/// @brief As text for the preferences, and back; nothing for a text that is no viewpoint.
std::string to_text(const Viewpoint& viewpoint);
std::optional<Viewpoint> viewpoint_from(const std::string& text);

}  // namespace geomap::viewer
