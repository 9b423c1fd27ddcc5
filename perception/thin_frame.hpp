// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "geometry/rgbd_frame.hpp"

namespace geomap::perception {

/// @brief A frame of fewer pixels that stands for a key frame in the point map: the smallest odd
/// step between kept pixels with which the images take at most `max_bytes` (2 bytes of depth a
/// pixel, 3 of colour). A frame that is small enough is returned as it is.
///
/// A kept pixel is the centre of a block of step x step pixels. Its depth is the mean over those
/// pairs of pixels opposite each other about the centre where both readings lie on the centre's
/// surface: most of the noise goes, a plane keeps its place even beside a hole or an edge, and no
/// point appears between two surfaces. A pixel without a reading stays without one. Colour is
/// averaged over those of these pixels that lie beside the centre, up to three on either side, and
/// left out unless its image has the size of the depth image.
///
/// @return a valid RgbdFrame with the camera of the kept pixels: it projects a point to (u, v)
/// where the full camera projects it to (step u + step / 2, step v + step / 2).
/// @throws std::invalid_argument when image and camera sizes disagree, or max_bytes is less than 5.
geometry::RgbdFrame thin_frame(const geometry::RgbdFrame& frame, std::size_t max_bytes);

}  // namespace geomap::perception
