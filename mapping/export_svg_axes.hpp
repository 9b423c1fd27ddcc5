// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "mapping/export_svg_canvas.hpp"
#include "mapping/export_svg_view.hpp"

namespace geomap::mapping {

/// @brief The world's axes as a view shows them, around `origin`, at most 35 px long with their
/// names. An axis along the line of sight is a ring, with a dot when it points to the eye.
void draw_axes(SvgCanvas& canvas, const Eigen::Vector2d& origin, const ViewAxes& axes);

}  // namespace geomap::mapping
