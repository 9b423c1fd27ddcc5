// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "geometry/rgbd_frame.hpp"

namespace geomap::bench {

/// Upper bounds of all depth bins but the last, which is open [m].
inline constexpr std::array<double, 5> kDepthBinEnds = {1.0, 1.5, 2.0, 2.5, 3.0};

/// @brief Pixels of a range of depths.
struct DepthBin {
  std::int64_t valid = 0;     // with a reading
  std::int64_t labelled = 0;  // of those, on a plane that counts
};

/// @brief How well the labels of one frame follow its surfaces, as counts that can be added up over
/// frames. No ground truth is used. Only labels of at least 1000 readings count as planes.
struct SegmentationQuality {
  int planes = 0;  // labels that count
  std::array<DepthBin, kDepthBinEnds.size() + 1> bins;
  std::int64_t blocks = 0;         // well-fitted ones, see measure_segmentation()
  std::int64_t mismatched = 0;     // of those, more than 20° off their label's plane
  int splits = 0;                  // pairs of adjacent labels that are coplanar
  int flush_splits = 0;            // of those, the ones without even a small step between them
  double squared_residuals = 0.0;  // of labelled points to their label's plane [m²]

  std::int64_t valid() const;
  std::int64_t labelled() const;
  double cover() const;     // share of the readings that are labelled; 0 without readings
  double mismatch() const;  // share of the well-fitted blocks; 0 without blocks
  double rms() const;       // of labelled points about their label's plane [m]; 0 without any

  SegmentationQuality& operator+=(const SegmentationQuality& other);
};

/// @brief Measures labels against the readings they lie on, whatever their depth. A label's plane
/// is the least-squares plane of its points, all alike.
///
/// Under-segmentation: blocks of 16 x 16 pixels on a fixed grid, at a mean depth of less than 2.5
/// m, are well-fitted when 80 % of their pixels have readings, one label that counts has 75 % of
/// these, and the rms of all readings about their own least-squares plane is at most 1 mm + 0.8 mm
/// (z/m)². That is above a Kinect's noise and below what an edge of 90° through the block leaves.
/// Such a block is mismatched when its plane is more than 20° off its label's.
///
/// Over-segmentation: two labels are adjacent along a border of at least 20 pixels, each of which
/// has the other label within 3 pixels to the right or below, with none of its own between. They
/// are split when their planes differ by less than 5° and the centroid of each is less than 2 cm
/// from the plane of the other. A book on a table makes such a pair, too; the flush ones, which
/// differ by less than 2° and 5 mm, are pieces of one surface.
/// @param label per pixel, row by row; negative: none.
/// @throws std::invalid_argument unless there is one label per pixel.
SegmentationQuality measure_segmentation(const geometry::RgbdFrame& frame,
                                         std::span<const std::int16_t> label);

}  // namespace geomap::bench
