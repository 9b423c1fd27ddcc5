// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "viewer/painter.hpp"
#include "viewer/renderer.hpp"

namespace geomap::viewer {

/// @brief Lines on the world's z = 0 about the eye's target, every metre and, stronger, every ten.
class RenderGrid : public Renderer {
 public:
  explicit RenderGrid(std::shared_ptr<Painter> painter)
      : Renderer("Grid", true), painter_(std::move(painter)) {}

  int order() const override { return -10; }
  void draw(const DrawContext& context) override;

 private:
  std::shared_ptr<Painter> painter_;
  GlBuffer lines_;
  double spacing_ = 0.0;  // of the lines that lines_ holds [m]
};

}  // namespace geomap::viewer
