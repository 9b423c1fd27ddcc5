// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "viewer/painter.hpp"
#include "viewer/renderer.hpp"

namespace geomap::viewer {

/// @brief Level lines at the bottom of the map about the eye's target, every metre and, stronger,
/// every ten.
class RenderGrid : public Renderer {
 public:
  explicit RenderGrid(std::shared_ptr<Painter> painter)
      : Renderer("Grid", true), painter_(std::move(painter)) {}

  int order() const override { return -10; }
  void draw(const DrawContext& context) override;
  bool panel() override;
  void load(const Preferences& preferences) override;
  void store(Preferences& preferences) const override;

 private:
  std::shared_ptr<Painter> painter_;
  GlBuffer lines_;
  bool is_at_map_ = true;   // at the lowest level of the map, where that is not z = 0
  double map_level_ = 0.0;  // world z [m]
  Stamp map_stamp_ = 0;
  double spacing_ = 0.0;  // of the lines that lines_ holds [m]
};

}  // namespace geomap::viewer
