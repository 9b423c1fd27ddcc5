// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "viewer/painter.hpp"
#include "viewer/renderer.hpp"
#include "viewer/surface_mesh.hpp"

namespace geomap::viewer {

/// @brief Surfaces that no observation fills any more: dashed outlines.
class RenderVetoes : public Renderer {
 public:
  explicit RenderVetoes(std::shared_ptr<Painter> painter)
      : Renderer("Kept-out surfaces", true), painter_(std::move(painter)) {}

  int order() const override { return 15; }
  void draw(const DrawContext& context) override;
  bool panel() override;
  void load(const Preferences& preferences) override;
  void store(Preferences& preferences) const override;

  bool shows_all = false;  // also of what was held or placed, not only of deletions

 private:
  struct Kept {
    mapping::VetoCause cause;
    SurfaceMesh mesh;
  };

  std::shared_ptr<Painter> painter_;
  std::vector<Kept> kept_;
  Stamp stamp_ = 0;
};

}  // namespace geomap::viewer
