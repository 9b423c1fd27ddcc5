// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/depth_codec.hpp"

#include <zlib.h>

#include <stdexcept>

namespace geomap::messaging {

std::vector<std::uint8_t> deflate_bytes(std::span<const std::uint8_t> bytes, int level) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<std::uint8_t> stream(size);
  if (compress2(stream.data(), &size, bytes.data(), static_cast<uLong>(bytes.size()), level) !=
      Z_OK) {
    throw std::invalid_argument("deflate_bytes: no such level");
  }
  stream.resize(size);
  return stream;
}

std::optional<std::vector<std::uint8_t>> inflate_bytes(std::span<const std::uint8_t> stream,
                                                       std::size_t size) {
  // zlib shrinks at most 1032 to 1, so a short stream cannot ask for much memory.
  constexpr std::size_t kLargestRatio = 1032;
  if (size / kLargestRatio > stream.size()) return std::nullopt;
  std::vector<std::uint8_t> bytes(size);
  uLongf inflated = static_cast<uLongf>(size);
  uLong consumed = static_cast<uLong>(stream.size());
  const int status = uncompress2(bytes.data(), &inflated, stream.data(), &consumed);
  if (status != Z_OK || inflated != size || consumed != stream.size()) return std::nullopt;
  return bytes;
}

std::vector<std::uint8_t> compress_depth(std::span<const std::uint16_t> millimetres, int level) {
  std::vector<std::uint8_t> bytes(2 * millimetres.size());
  for (std::size_t i = 0; i < millimetres.size(); ++i) {
    bytes[2 * i] = static_cast<std::uint8_t>(millimetres[i] & 0xff);
    bytes[2 * i + 1] = static_cast<std::uint8_t>(millimetres[i] >> 8);
  }
  return deflate_bytes(bytes, level);
}

std::optional<std::vector<std::uint16_t>> unpack_depth(std::span<const std::uint8_t> rows,
                                                       int width, int height,
                                                       std::size_t row_stride) {
  if (width <= 0 || height <= 0) return std::nullopt;
  const auto columns = static_cast<std::size_t>(width);
  const auto lines = static_cast<std::size_t>(height);
  if (row_stride < 2 * columns || rows.size() % lines != 0 || rows.size() / lines != row_stride) {
    return std::nullopt;
  }
  std::vector<std::uint16_t> millimetres;
  millimetres.reserve(columns * lines);
  for (std::size_t v = 0; v < lines; ++v) {
    const std::uint8_t* row = rows.data() + v * row_stride;
    for (std::size_t u = 0; u < columns; ++u) {
      millimetres.push_back(static_cast<std::uint16_t>(row[2 * u] | (row[2 * u + 1] << 8)));
    }
  }
  return millimetres;
}

}  // namespace geomap::messaging
