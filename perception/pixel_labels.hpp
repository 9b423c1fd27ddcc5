// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/plane.hpp"
#include "geometry/rgbd_frame.hpp"
#include "perception/cell_normals.hpp"
#include "perception/depth_cells.hpp"
#include "perception/depth_tolerance.hpp"
#include "perception/plane_extractor.hpp"

namespace geomap::perception {

/// @brief Assigns every reading to the plane it fits best, among the planes known in the
/// neighbourhood of its cell: within the depth tolerance at its range, and not where the cell's own
/// normal says otherwise. Keeps references to what it is made from.
class PixelLabeler {
 public:
  /// @param max_normal_angle between a cell's normal and the plane's [rad]
  PixelLabeler(const geometry::RgbdFrame& frame, const DepthCells& cells,
               const std::vector<CellNormal>& normals, const DepthTolerance& tolerance, double near,
               double far, double max_normal_angle);

  /// @brief Per pixel the index of its plane, or kNoPlane.
  /// @param planes with normals towards the camera (d > 0)
  /// @param cell_label where each plane is known to be: the seeds, one per cell.
  std::vector<std::int16_t> label(const std::vector<geometry::Plane>& planes,
                                  const std::vector<std::int16_t>& cell_label) const;

 private:
  struct ImagePlane;
  struct Candidates;
  struct Readings;
  ImagePlane in_image(const geometry::Plane& plane) const;
  void label_inner(int first, int last, int row, const ImagePlane& plane, std::int16_t label,
                   std::vector<std::int16_t>& labels) const;
  Candidates candidates_at(int column, int row, const std::vector<ImagePlane>& planes,
                           const std::vector<std::int16_t>& cell_label) const;
  Readings read(int u_first, int v_first, int u_last, int v_last, int step) const;
  std::int16_t& label_at(const Readings& readings, std::size_t i,
                         std::vector<std::int16_t>& labels) const;
  void label_cell(int column, int row, const Candidates& candidates,
                  std::vector<std::int16_t>& labels) const;
  void settle_cell(int column, int row, const Candidates& candidates, Readings& own,
                   std::vector<std::int16_t>& labels) const;

  const geometry::RgbdFrame& frame_;
  const DepthCells& cells_;
  const std::vector<CellNormal>& normals_;
  double unevenness_;  // tolerance along the normal, beside the rest [m]
  double cosine_;      // of the largest angle between normals
  // Per depth reading [mm]; 0 where it is out of range.
  std::vector<float> inverse_;    // inverse depth [1/m]
  std::vector<float> tolerance_;  // of inverse depth [1/m]
};

}  // namespace geomap::perception
