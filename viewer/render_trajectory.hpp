// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "viewer/painter.hpp"
#include "viewer/path_lines.hpp"
#include "viewer/renderer.hpp"

namespace geomap::viewer {

/// @brief Where the camera has been, and from where the key frames were taken.
class RenderTrajectory : public Renderer {
 public:
  explicit RenderTrajectory(std::shared_ptr<Painter> painter)
      : Renderer("Trajectory", true), painter_(std::move(painter)) {}

  int order() const override { return 32; }
  void draw(const DrawContext& context) override;
  bool panel() override;
  void load(const Preferences& preferences) override;
  void store(Preferences& preferences) const override;

 private:
  void update(const TrackLayer& track);

  std::shared_ptr<Painter> painter_;
  PathLines path_;
  std::vector<Vertex> dots_;  // of the key frames, relative to the path's origin
  GlBuffer path_buffer_, keyframes_;
  Eigen::Isometry3d T_world_path_ = Eigen::Isometry3d::Identity();
  Stamp stamp_ = 0;
  bool shows_keyframes_ = true;
};

}  // namespace geomap::viewer
