// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "perception/surface_image.hpp"

namespace geomap::perception {

/// @brief How much of a view lies on known surface: in patches of 8 x 8 pixels, how many surfaces
/// there are, and whether any of them was found in the map, whose points lie farther apart.
class ViewOverlap {
 public:
  explicit ViewOverlap(const SurfaceImage& view)
      : view_(view),
        columns_((view.width() + kPatch - 1) / kPatch),
        surfaces_(static_cast<std::size_t>(columns_ * ((view.height() + kPatch - 1) / kPatch)), 0),
        found_(surfaces_.size(), 0) {
    for (int v = 0; v < view.height(); ++v) {
      for (int u = 0; u < view.width(); ++u) surfaces_[patch(u, v)] += view.at(u, v).valid();
    }
  }
  /// @param index of a pixel whose surface lies on the map, row by row.
  void mark(int index) { found_[patch(index % view_.width(), index / view_.width())] = 1; }
  /// @brief Of the view's surfaces, 0 to 1.
  double share() const {
    int all = 0, found = 0;
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
      all += surfaces_[i];
      found += found_[i] != 0 ? surfaces_[i] : 0;
    }
    return all > 0 ? static_cast<double>(found) / all : 0.0;
  }

 private:
  static constexpr int kPatch = 8;  // [pixel]

  std::size_t patch(int u, int v) const {
    return static_cast<std::size_t>(v / kPatch * columns_ + u / kPatch);
  }
  const SurfaceImage& view_;
  int columns_;
  std::vector<int> surfaces_;
  std::vector<char> found_;
};

}  // namespace geomap::perception
