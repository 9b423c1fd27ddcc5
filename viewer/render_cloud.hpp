// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "viewer/painter.hpp"
#include "viewer/renderer.hpp"

namespace geomap::viewer {

/// @brief The points of the newest camera frame.
class RenderCloud : public Renderer {
 public:
  explicit RenderCloud(std::shared_ptr<Painter> painter)
      : Renderer("Live cloud", false), painter_(std::move(painter)) {}

  int order() const override { return 1; }
  void draw(const DrawContext& context) override;
  bool panel() override;
  void load(const Preferences& preferences) override;
  void store(Preferences& preferences) const override;

 private:
  std::shared_ptr<Painter> painter_;
  GlBuffer points_;  // camera frame
  Stamp stamp_ = 0;
  int stride_ = 0;     // between the pixels that were uploaded
  double size_ = 2.0;  // [px]
};

}  // namespace geomap::viewer
