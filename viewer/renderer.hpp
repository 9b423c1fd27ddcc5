// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "viewer/palette.hpp"
#include "viewer/preferences.hpp"
#include "viewer/scene_model.hpp"
#include "viewer/selection.hpp"
#include "viewer/view_camera.hpp"

namespace geomap::viewer {

/// @brief What a renderer is told when it draws.
struct DrawContext {
  const SceneModel& scene;
  const ViewCamera& camera;
  const Selection& selection;
  const Theme& theme;
  float scale = 1.0F;            // of lines and text, for the display's density
  std::size_t point_budget = 0;  // most points that may be drawn in all
};

/// @brief A word to be written over the drawing.
struct SceneLabel {
  Eigen::Vector3d position;  // world frame [m]
  std::string text;
  Rgba color;
};

/// @brief One kind of thing to draw: a plug-in of the viewer.
///
/// Contract: draw() finds a current OpenGL 3.3 context, a bound framebuffer with depth, the depth
/// test on, blending off; it leaves them so. It keeps what it has uploaded and compares stamps. It
/// is not called while it is not enabled. The context outlives the renderer.
class Renderer {
 public:
  /// @param name for people and preferences: "Point map".
  Renderer(std::string name, bool is_enabled) : enabled(is_enabled), name_(std::move(name)) {}
  virtual ~Renderer() = default;

  const std::string& name() const { return name_; }
  /// @brief Opaque things first, see-through ones last: ascending.
  virtual int order() const { return 0; }
  virtual void draw(const DrawContext& context) = 0;
  virtual void add_labels(const DrawContext&, std::vector<SceneLabel>&) {}
  /// @brief Its own settings, with Dear ImGui; nothing: it has none. @return true when one changed.
  virtual bool panel() { return false; }
  /// @brief Keys begin with the renderer's name and a dot.
  virtual void load(const Preferences&) {}
  virtual void store(Preferences&) const {}

  bool enabled;

 private:
  std::string name_;
};

/// @brief All renderers, in the order in which they are listed.
std::vector<std::unique_ptr<Renderer>> make_renderers();

}  // namespace geomap::viewer
