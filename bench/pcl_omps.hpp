// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "geometry/rgbd_frame.hpp"

namespace geomap::bench {

/// @brief PCL's plane extraction from the image grid (Trevor et al., SPME 2013): normals from
/// integral images, smoothed over 20 pixels; regions of at least 1 000 pixels within 3° and 2 cm,
/// refined; outlines are chains of border pixels.
/// @return the number of planes.
std::size_t pcl_organized_planes(const geometry::RgbdFrame& frame);

}  // namespace geomap::bench
