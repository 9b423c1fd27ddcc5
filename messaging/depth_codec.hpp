// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace geomap::messaging {

/// @brief zlib stream of any bytes. @param level 1 (94 kB in 5 ms for a Kinect's depth image) to 12
/// (smallest). @throws std::invalid_argument for another level.
std::vector<std::uint8_t> deflate_bytes(std::span<const std::uint8_t> bytes, int level = 1);

/// @brief The inverse, for a stream that must inflate to exactly `size` bytes; nothing for one that
/// is damaged, shorter or longer. Never writes beyond `size`, so a zip bomb does not go off.
std::optional<std::vector<std::uint8_t>> inflate_bytes(std::span<const std::uint8_t> stream,
                                                       std::size_t size);

/// @brief Depth values [mm] as little-endian bytes, deflated.
std::vector<std::uint8_t> compress_depth(std::span<const std::uint16_t> millimetres, int level = 1);

/// @brief The inverse, for a stream of exactly `count` values; nothing as inflate_bytes().
std::optional<std::vector<std::uint16_t>> decompress_depth(std::span<const std::uint8_t> stream,
                                                           std::size_t count);

/// @brief width · height depth values from little-endian rows of `row_stride` bytes, whose padding
/// is dropped; nothing unless `rows` has exactly height · row_stride bytes and a row fits its
/// stride.
std::optional<std::vector<std::uint16_t>> unpack_depth(std::span<const std::uint8_t> rows,
                                                       int width, int height,
                                                       std::size_t row_stride);

}  // namespace geomap::messaging
