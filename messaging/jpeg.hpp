// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/rgbd_frame.hpp"

namespace geomap::messaging {

/// @brief Largest width and height that is decoded [pixel].
inline constexpr int kMaxImageSide = 8192;

/// @brief JPEG stream of a colour image. @param quality 1 to 100.
/// @throws std::invalid_argument for an empty or inconsistent image, or a quality out of range.
std::vector<std::uint8_t> encode_jpeg(const geometry::ColorImage& image, int quality = 90);

/// @brief The image; nothing for data that is damaged, cut short, no JPEG, or larger than
/// kMaxImageSide. Grey images become colour ones.
std::optional<geometry::ColorImage> decode_jpeg(std::span<const std::uint8_t> data);

}  // namespace geomap::messaging
