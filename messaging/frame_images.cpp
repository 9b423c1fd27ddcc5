// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/frame_images.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "messaging/depth_codec.hpp"
#include "messaging/jpeg.hpp"

namespace geomap::messaging {
namespace {

/// Rows are padded to some alignment, never by more than this [byte].
constexpr std::int64_t kLargestPadding = 4096;

/// Bytes of a row, or nothing when the sizes are absurd.
std::optional<std::size_t> row_size(const EncodedImage& encoded, std::int64_t pixel_size) {
  if (encoded.width <= 0 || encoded.width > kMaxImageSide) return std::nullopt;
  if (encoded.height <= 0 || encoded.height > kMaxImageSide) return std::nullopt;
  const std::int64_t tight = pixel_size * encoded.width;
  const std::int64_t stride = encoded.row_stride == 0 ? tight : encoded.row_stride;
  if (stride < tight || stride > tight + kLargestPadding) return std::nullopt;
  return static_cast<std::size_t>(stride);
}

ColorResult read_plain_color(const EncodedImage& encoded, std::size_t stride) {
  const auto height = static_cast<std::size_t>(encoded.height);
  if (encoded.data.size() != stride * height) return {{}, FrameFault::kBadSize};
  const std::size_t tight = 3 * static_cast<std::size_t>(encoded.width);
  geometry::ColorImage image{encoded.width, encoded.height, {}};
  image.rgb.reserve(tight * height);
  for (std::size_t v = 0; v < height; ++v) {
    const std::uint8_t* row = encoded.data.data() + v * stride;
    image.rgb.insert(image.rgb.end(), row, row + tight);
  }
  return {std::move(image), FrameFault::kNone};
}

}  // namespace

DepthResult read_depth(const EncodedImage& encoded) {
  const std::optional<std::size_t> stride = row_size(encoded, 2);
  if (!stride) return {{}, FrameFault::kBadSize};

  const auto height = static_cast<std::size_t>(encoded.height);
  const std::size_t tight = 2 * static_cast<std::size_t>(encoded.width);
  std::optional<std::vector<std::uint16_t>> millimetres;
  if (!encoded.compressed) {
    millimetres = unpack_depth(encoded.data, encoded.width, encoded.height, *stride);
    if (!millimetres) return {{}, FrameFault::kBadSize};
  } else if (*stride == tight) {
    millimetres = decompress_depth(encoded.data, tight / 2 * height);
  } else if (const auto rows = inflate_bytes(encoded.data, *stride * height)) {
    millimetres = unpack_depth(*rows, encoded.width, encoded.height, *stride);
  }
  if (!millimetres) return {{}, FrameFault::kBadDepth};
  if (std::none_of(millimetres->begin(), millimetres->end(), geometry::DepthImage::is_reading)) {
    return {{}, FrameFault::kNoReading};
  }
  return {{encoded.width, encoded.height, std::move(*millimetres)}, FrameFault::kNone};
}

ColorResult read_color(const EncodedImage& encoded) {
  const std::optional<std::size_t> stride = row_size(encoded, 3);
  if (!encoded.compressed) {
    return stride ? read_plain_color(encoded, *stride) : ColorResult{{}, FrameFault::kBadSize};
  }
  std::optional<geometry::ColorImage> image = decode_jpeg(encoded.data);
  if (!image || image->width != encoded.width || image->height != encoded.height) {
    return {{}, FrameFault::kBadJpeg};
  }
  return {std::move(*image), FrameFault::kNone};
}

std::string to_string(FrameFault fault) {
  switch (fault) {
    case FrameFault::kNone:
      return "none";
    case FrameFault::kBadSize:
      return "bad_size";
    case FrameFault::kBadFormat:
      return "bad_format";
    case FrameFault::kBadDepth:
      return "bad_depth";
    case FrameFault::kBadJpeg:
      return "bad_jpeg";
    case FrameFault::kBadIntrinsics:
      return "bad_intrinsics";
    case FrameFault::kNoReading:
      return "no_reading";
  }
  return "unknown";
}

}  // namespace geomap::messaging
