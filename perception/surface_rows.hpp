// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "geometry/depth_noise.hpp"

namespace geomap::perception {

/// The loops of a surface image over one row of pixels each, written so that the compiler takes
/// several pixels at a time. No pixel's result depends on its neighbours in such a group.

/// @brief Inverse depth [1/m] of readings [mm] between `nearest` and `farthest` [mm], 0 elsewhere.
void invert_depth(const std::uint16_t* millimetres, int count, double nearest, double farthest,
                  double* inverse);

/// @brief Planes in the image, as inverse depth: slopes [1/m per pixel] and the value at the
/// window's centre [1/m], 0 where nothing fits.
struct WindowFits {
  double* slope_u;
  double* slope_v;
  double* centre;
};

/// @brief Least squares over windows of 5 x 5 pixels, where those are not flat of 3 x 3, from the
/// pixels whose depth is close to the centre's.
/// @param inverse depth at the row's first pixel; two more pixels can be read on every side of the
/// row, `stride` values lie between rows.
/// @param flat_rms that a fit may have, over the noise of a reading.
void fit_windows(const double* inverse, int stride, int count, const geometry::DepthNoise& noise,
                 double flat_rms, const WindowFits& fits);

/// @brief Surfaces of a row in the camera frame, as of SurfacePixel; zeros where there is none.
struct SurfaceRow {
  double* inverse_depth[3];
  double* normal[3];
  double* point[3];
};

/// @brief The planes of fits in space. @param ray_x, ray_y viewing rays (x, y, 1) of the row.
/// @param fx, fy focal lengths [pixel]. @param least_cosine between normal and ray.
void place_surfaces(const WindowFits& fits, int count, const double* ray_x, double ray_y, double fx,
                    double fy, double least_cosine, const SurfaceRow& row);

}  // namespace geomap::perception
