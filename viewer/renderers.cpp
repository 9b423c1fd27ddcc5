// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/renderers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "viewer/render_axes.hpp"
#include "viewer/render_cloud.hpp"
#include "viewer/render_deviation.hpp"
#include "viewer/render_frustum.hpp"
#include "viewer/render_grid.hpp"
#include "viewer/render_keyframe.hpp"
#include "viewer/render_points.hpp"
#include "viewer/render_polygons.hpp"
#include "viewer/render_robot.hpp"
#include "viewer/render_trajectory.hpp"
#include "viewer/render_vetoes.hpp"

namespace geomap::viewer {

std::vector<std::unique_ptr<Renderer>> make_renderers(const std::shared_ptr<Painter>& painter) {
  std::vector<std::unique_ptr<Renderer>> all;
  all.push_back(std::make_unique<RenderPolygons>(painter));
  all.push_back(std::make_unique<RenderVetoes>(painter));
  all.push_back(std::make_unique<RenderPoints>(painter));
  all.push_back(std::make_unique<RenderCloud>(painter));
  all.push_back(std::make_unique<RenderKeyframe>(painter));
  all.push_back(std::make_unique<RenderDeviation>(painter));
  all.push_back(std::make_unique<RenderFrustum>(painter));
  all.push_back(std::make_unique<RenderTrajectory>(painter));
  all.push_back(std::make_unique<RenderRobot>(painter));
  all.push_back(std::make_unique<RenderGrid>(painter));
  all.push_back(std::make_unique<RenderAxes>(painter));
  return all;
}

std::vector<std::unique_ptr<Renderer>> make_renderers() {
  return make_renderers(std::make_shared<Painter>());
}

std::vector<std::string> draw_all(const std::vector<std::unique_ptr<Renderer>>& renderers,
                                  const DrawContext& context) {
  std::vector<Renderer*> enabled;
  for (const auto& renderer : renderers) {
    if (renderer->enabled) enabled.push_back(renderer.get());
  }
  std::stable_sort(enabled.begin(), enabled.end(),
                   [](const Renderer* a, const Renderer* b) { return a->order() < b->order(); });
  std::vector<std::string> failures;
  for (Renderer* renderer : enabled) {
    try {
      renderer->draw(context);
    } catch (const std::exception& error) {
      failures.push_back(fmt::format("{}: {}", renderer->name(), error.what()));
    }
  }
  return failures;
}

}  // namespace geomap::viewer
