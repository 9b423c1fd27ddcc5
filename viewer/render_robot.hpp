// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "viewer/painter.hpp"
#include "viewer/renderer.hpp"

namespace geomap::viewer {

/// @brief The robot: a drum with an arrow to its front, at the pose of the body.
class RenderRobot : public Renderer {
 public:
  explicit RenderRobot(std::shared_ptr<Painter> painter)
      : Renderer("Robot", true), painter_(std::move(painter)) {}

  int order() const override { return 31; }
  void draw(const DrawContext& context) override;

 private:
  std::shared_ptr<Painter> painter_;
  GlBuffer body_, edges_;  // body frame
};

}  // namespace geomap::viewer
