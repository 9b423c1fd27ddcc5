// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "viewer/painter.hpp"
#include "viewer/renderer.hpp"

namespace geomap::viewer {

/// @brief The axes of the world at its origin (x red, y green, z blue), and the way down.
class RenderAxes : public Renderer {
 public:
  explicit RenderAxes(std::shared_ptr<Painter> painter)
      : Renderer("Axes", true), painter_(std::move(painter)) {}

  int order() const override { return 34; }
  void draw(const DrawContext& context) override;
  void add_labels(const DrawContext& context, std::vector<SceneLabel>& labels) override;
  bool panel() override;
  void load(const Preferences& preferences) override;
  void store(Preferences& preferences) const override;

 private:
  std::shared_ptr<Painter> painter_;
  GlBuffer lines_;
  double length_ = 1.0;  // [m]
  double uploaded_length_ = 0.0;
  bool shows_gravity_ = true;
};

}  // namespace geomap::viewer
