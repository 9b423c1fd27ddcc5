// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "viewer/app.hpp"

namespace geomap::viewer {

/// @brief Where the parts of the window are. Pixels from the top left.
struct Layout {
  float scale = 1.0F;  // of text and lines, for the display's density
  Eigen::Vector2f size = {1280.0F, 800.0F};
  Eigen::AlignedBox2f toolbar, left, right, scene, status, time_line;
};
Layout make_layout(const App& app, float width, float height, float scale);

/// @brief Colours and roundings of Dear ImGui's own.
void apply_style(const Theme& theme, float scale);

/// The panels, drawn with Dear ImGui between its NewFrame and Render. Each fills its place.
void draw_toolbar(App& app, const Layout& layout);
void draw_left_panel(App& app, const Layout& layout);
void draw_right_panel(App& app, const Layout& layout, unsigned color_texture,
                      unsigned depth_texture);
void draw_status(App& app, const Layout& layout, Clock::time_point now);
void draw_time_line(App& app, const Layout& layout);
/// @brief Words and lines over the drawing: names, handles, what a tool needs, warnings, answers.
void draw_over_scene(App& app, const Layout& layout, Clock::time_point now);
void draw_help(App& app, const Layout& layout);
void draw_dialogs(App& app, const Layout& layout);

/// @brief Parts of the panels at the sides.
void draw_feature_list(App& app, float height);
void draw_layers(App& app);
void draw_selected(App& app);
void draw_history(App& app, float height);

/// @brief A window without any frame that fills a box; the caller ends it with ImGui::End().
void begin_panel(const char* name, const Eigen::AlignedBox2f& box);

}  // namespace geomap::viewer
