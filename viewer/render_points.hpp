// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>

#include "viewer/painter.hpp"
#include "viewer/renderer.hpp"

namespace geomap::viewer {

/// @brief The point map. Of each block the first points are drawn, more of those that are near the
/// eye, so that the sum keeps to the budget.
class RenderPoints : public Renderer {
 public:
  explicit RenderPoints(std::shared_ptr<Painter> painter)
      : Renderer("Point map", true), painter_(std::move(painter)) {}

  void draw(const DrawContext& context) override;
  bool panel() override;
  void load(const Preferences& preferences) override;
  void store(Preferences& preferences) const override;

  std::size_t blocks() const { return blocks_.size(); }  // on the graphics card

 private:
  struct Block {
    GlBuffer points;
    Eigen::Isometry3d T_world_block = Eigen::Isometry3d::Identity();
    Eigen::AlignedBox3d box;
    Stamp stamp = 0;
  };

  void update(const PointLayer& layer);

  std::shared_ptr<Painter> painter_;
  std::map<BlockKey, Block> blocks_;
  Stamp stamp_ = 0;
  std::size_t drawn_ = 0, held_ = 0;  // points, at the last drawing
  double low_ = 0.0, high_ = 1.0;     // heights in the map [m]
  double size_ = 2.0;                 // [px]
  double paleness_ = 0.35;            // share of the background in their colours
  bool is_round_ = false;
  bool is_by_height_ = false;
  bool hides_above_ = false;  // a ceiling, which would hide the room from above
  double hide_height_ = 2.0;  // world z [m]
};

}  // namespace geomap::viewer
