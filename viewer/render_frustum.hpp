// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "viewer/painter.hpp"
#include "viewer/renderer.hpp"

namespace geomap::viewer {

/// @brief What the camera sees now: the pyramid of its depth image.
class RenderFrustum : public Renderer {
 public:
  explicit RenderFrustum(std::shared_ptr<Painter> painter)
      : Renderer("Camera", true), painter_(std::move(painter)) {}

  int order() const override { return 33; }
  void draw(const DrawContext& context) override;
  bool panel() override;
  void load(const Preferences& preferences) override;
  void store(Preferences& preferences) const override;

 private:
  std::shared_ptr<Painter> painter_;
  GlBuffer lines_;  // camera frame
  std::optional<geometry::CameraModel> uploaded_;
  double far_ = 4.0;  // depth of the far end [m]
  double uploaded_far_ = 0.0;
};

}  // namespace geomap::viewer
