// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "mapping/export_svg_view.hpp"
#include "mapping/map_snapshot.hpp"

namespace geomap::mapping {

/// @brief What a sheet shows and how large it may become.
struct SvgOptions {
  std::vector<SvgView> views = {SvgView::kTop, SvgView::kFront, SvgView::kOblique};
  double max_width = 1500.0;   // of the drawings, all views together [px]
  double max_height = 1000.0;  // of the drawings, all views together [px]
  std::string title = "Geometric map";
  bool labels = true;
  std::vector<FeatureId> highlighted;  // drawn bold, the others pale

  /// For series of pictures, which must not jump: a world box that fits at least, and the
  /// directions of the front and oblique views [rad]. Without them chosen for the map, see
  /// front_heading and oblique_turn.
  std::optional<Eigen::AlignedBox3d> extent;
  std::optional<double> heading;
  std::optional<double> turn;
};

/// @brief The map as a sheet for people: orthographic views (top, front, oblique) at one common
/// scale, with labels "#1", "#2", ... in the order of the ids, a scale bar and each view's axes.
/// Faces turned away from the eye are pale, so that one looks into a room through its ceiling and
/// near walls. What the operator holds has a bold outline, surfaces that he has deleted a dashed
/// one. Features under 0.02 m² stay without label. An empty map gives a sheet that says so.
/// @throws std::invalid_argument without views, or for a size that is not positive.
std::string to_svg(const MapSnapshot& map, const SvgOptions& options = {});

}  // namespace geomap::mapping
