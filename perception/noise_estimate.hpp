// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "geometry/depth_noise.hpp"
#include "perception/depth_cells.hpp"

namespace geomap::perception {

/// @brief The depth noise of one frame from the frame itself, so that one configuration serves
/// noise-free simulation, white noise and real cameras.
///
/// Planes are fitted to blocks of 16 x 16 pixels; a low quantile of their residuals is taken as
/// noise (edges and clutter only ever raise a residual). The result is `model` with its factor
/// replaced, for white noise also without its growth with depth (slope 0) where the residuals do
/// not grow as the model says. Noise drawn from the model at factor f gives about f. The factor
/// stays within [kLeastNoiseFactor, kLargestNoiseFactor]; a frame without a whole block gives
/// `model` as it is.
geometry::DepthNoise estimate_noise(const DepthCells& cells, const geometry::DepthNoise& model);

/// Rounded, noise-free readings leave nothing to measure; tolerances stay a little above zero.
inline constexpr double kLeastNoiseFactor = 0.05;
inline constexpr double kLargestNoiseFactor = 50.0;

}  // namespace geomap::perception
