// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "viewer/painter.hpp"
#include "viewer/renderer.hpp"

namespace geomap::viewer {

/// @brief All renderers, drawing with a painter that the caller may ask what it has done.
std::vector<std::unique_ptr<Renderer>> make_renderers(const std::shared_ptr<Painter>& painter);

/// @brief Draws what is enabled, by order, into the framebuffer that is bound. One that fails does
/// not keep the others from being drawn, and is asked again the next time.
/// @return why renderers failed, each with its name; none: all is drawn.
std::vector<std::string> draw_all(const std::vector<std::unique_ptr<Renderer>>& renderers,
                                  const DrawContext& context);

}  // namespace geomap::viewer
