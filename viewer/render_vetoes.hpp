// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "viewer/painter.hpp"
#include "viewer/renderer.hpp"
#include "viewer/surface_batch.hpp"

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
    Eigen::Vector3d middle;  // world frame
  };

  void update(const MapLayer& map);

  std::shared_ptr<Painter> painter_;
  std::vector<Kept> kept_;
  SurfaceBatch batch_;  // of kept_, in its order
  std::optional<Stamp> stamp_;
};

}  // namespace geomap::viewer
