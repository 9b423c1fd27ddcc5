// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "viewer/painter.hpp"
#include "viewer/renderer.hpp"
#include "viewer/surface_mesh.hpp"

namespace geomap::viewer {

/// @brief The planes that were seen in the newest key frame.
class RenderKeyframe : public Renderer {
 public:
  explicit RenderKeyframe(std::shared_ptr<Painter> painter)
      : Renderer("Key frame planes", true), painter_(std::move(painter)) {}

  int order() const override { return 20; }
  void draw(const DrawContext& context) override;
  bool panel() override;
  void load(const Preferences& preferences) override;
  void store(Preferences& preferences) const override;

 private:
  std::shared_ptr<Painter> painter_;
  std::vector<SurfaceMesh> planes_;
  Stamp stamp_ = 0;
  double opacity_ = 0.15;
};

}  // namespace geomap::viewer
