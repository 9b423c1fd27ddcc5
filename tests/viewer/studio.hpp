// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viewer/framebuffer.hpp"
#include "viewer/offscreen.hpp"
#include "viewer/renderers.hpp"

namespace geomap::testing {

/// @brief Draws scenes into pictures off the screen, with all renderers. Skips its tests where
/// there is no OpenGL.
class Studio : public ::testing::Test {
 protected:
  void SetUp() override;
  /// Every test also tells whether OpenGL found fault with what it was asked.
  void TearDown() override;

  /// @brief Only this one draws.
  viewer::Renderer& only(const std::string& name);
  viewer::Renderer& renderer(const std::string& name);

  viewer::Image draw(const viewer::SceneModel& scene, const viewer::ViewCamera& camera,
                     const viewer::Selection& selection = {});

  viewer::Theme theme_ = viewer::dark_theme();
  std::size_t point_budget_ = 60'000;
  std::vector<std::string> failures_;  // of renderers, at the last drawing
  std::shared_ptr<viewer::Painter> painter_;
  std::vector<std::unique_ptr<viewer::Renderer>> renderers_;

 private:
  std::optional<viewer::Framebuffer> framebuffer_;
};

/// @brief How far two pictures of one size are apart.
struct ImageDifference {
  double mean = 0.0;   // of the channels, over the pixels that are drawn in either, 0 to 255
  double share = 0.0;  // of these pixels that differ by more than a step that an eye sees
};
/// @param background a pixel of this colour counts as not drawn.
ImageDifference difference(const viewer::Image& a, const viewer::Image& b,
                           const viewer::Rgba& background);

/// @brief True when no one would call them different pictures: what other versions of a software
/// renderer may do to rims and roundings.
bool looks_alike(const ImageDifference& difference);

/// @brief Compares with tests/viewer/golden/NAME.png; with GEOMAP_UPDATE_GOLDEN=1 writes it. On
/// failure the picture and the difference are in the test's working folder, and named.
::testing::AssertionResult is_golden(const std::string& name, const viewer::Image& image,
                                     const viewer::Rgba& background);

/// @brief The difference from tests/viewer/golden/NAME.png, which is never written.
ImageDifference difference_from_golden(const std::string& name, const viewer::Image& image,
                                       const viewer::Rgba& background);

}  // namespace geomap::testing
