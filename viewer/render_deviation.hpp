// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "viewer/painter.hpp"
#include "viewer/renderer.hpp"
#include "viewer/surface_mesh.hpp"

namespace geomap::viewer {

/// @brief The planes of the newest key frame, coloured by their distance from those of the map.
class RenderDeviation : public Renderer {
 public:
  explicit RenderDeviation(std::shared_ptr<Painter> painter)
      : Renderer("Key frame against map", false), painter_(std::move(painter)) {}

  int order() const override { return 21; }
  void draw(const DrawContext& context) override;
  void add_labels(const DrawContext& context, std::vector<SceneLabel>& labels) override;
  bool panel() override;
  void load(const Preferences& preferences) override;
  void store(Preferences& preferences) const override;

 private:
  struct Compared {
    SurfaceMesh mesh;
    std::optional<double> distance;  // rms, from the plane of the map [m]
  };

  std::shared_ptr<Painter> painter_;
  std::vector<Compared> planes_;
  Stamp planes_stamp_ = 0, map_stamp_ = 0;
  double most_ = 0.05;  // distance at the end of the ramp [m]
};

}  // namespace geomap::viewer
