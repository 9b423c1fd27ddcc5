// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "geometry/rgbd_frame.hpp"

namespace geomap::bench {

/// @brief Depth as grey, near bright; black where there is no reading.
geometry::ColorImage picture_of_depth(const geometry::DepthImage& depth);

/// @brief Labels as colours, the same for the same number; readings without a label are dark grey,
/// pixels without a reading black.
geometry::ColorImage picture_of_labels(const geometry::DepthImage& depth,
                                       std::span<const std::int16_t> label);

/// @brief Writes rows of pictures of one size, every second pixel of each, as one PNG.
/// @throws std::invalid_argument when they do not form a grid; std::runtime_error when the file
/// cannot be written.
void write_contact_sheet(const std::vector<std::vector<geometry::ColorImage>>& rows,
                         const std::filesystem::path& file);

}  // namespace geomap::bench
