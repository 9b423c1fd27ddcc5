// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/depth_codec.hpp"

#include <libdeflate.h>

#include <bit>
#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>

namespace geomap::messaging {
namespace {

// In place; nothing to do where the machine is little-endian itself.
void from_little_endian(std::span<std::uint16_t> values) {
  if constexpr (std::endian::native == std::endian::little) return;
  for (std::uint16_t& value : values) value = static_cast<std::uint16_t>(value << 8 | value >> 8);
}

// libdeflate wants an address even for no bytes.
template <class Byte>
Byte* address_of(std::span<Byte> bytes, std::uint8_t& nothing) {
  return bytes.empty() ? &nothing : bytes.data();
}

// Deflate shrinks at most 1032 to 1, so a short stream cannot ask for much memory.
bool may_inflate(std::span<const std::uint8_t> stream, std::size_t size) {
  constexpr std::size_t kLargestRatio = 1032;
  return size / kLargestRatio <= stream.size();
}

// @return false for a stream that is damaged, or inflates to another size.
bool inflate_into(std::span<const std::uint8_t> stream, std::span<std::uint8_t> bytes) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> codec(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (!codec) throw std::bad_alloc();
  std::uint8_t nothing = 0;
  std::size_t consumed = 0, inflated = 0;
  const libdeflate_result result =
      libdeflate_zlib_decompress_ex(codec.get(), stream.data(), stream.size(),
                                    address_of(bytes, nothing), bytes.size(), &consumed, &inflated);
  return result == LIBDEFLATE_SUCCESS && inflated == bytes.size() && consumed == stream.size();
}

}  // namespace

std::vector<std::uint8_t> deflate_bytes(std::span<const std::uint8_t> bytes, int level) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> codec(
      libdeflate_alloc_compressor(level), &libdeflate_free_compressor);
  if (!codec) throw std::invalid_argument("deflate_bytes: no such level");
  std::vector<std::uint8_t> stream(libdeflate_zlib_compress_bound(codec.get(), bytes.size()));
  std::uint8_t nothing = 0;
  stream.resize(libdeflate_zlib_compress(codec.get(), address_of(bytes, nothing), bytes.size(),
                                         stream.data(), stream.size()));
  return stream;
}

std::optional<std::vector<std::uint8_t>> inflate_bytes(std::span<const std::uint8_t> stream,
                                                       std::size_t size) {
  if (!may_inflate(stream, size)) return std::nullopt;
  std::vector<std::uint8_t> bytes(size);
  if (!inflate_into(stream, bytes)) return std::nullopt;
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

std::optional<std::vector<std::uint16_t>> decompress_depth(std::span<const std::uint8_t> stream,
                                                           std::size_t count) {
  if (!may_inflate(stream, 2 * count)) return std::nullopt;
  std::vector<std::uint16_t> millimetres(count);
  const auto bytes = std::as_writable_bytes(std::span(millimetres));
  if (!inflate_into(stream, {reinterpret_cast<std::uint8_t*>(bytes.data()), bytes.size()})) {
    return std::nullopt;
  }
  from_little_endian(millimetres);
  return millimetres;
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
  std::vector<std::uint16_t> millimetres(columns * lines);
  for (std::size_t v = 0; v < lines; ++v) {
    std::memcpy(millimetres.data() + v * columns, rows.data() + v * row_stride, 2 * columns);
  }
  from_little_endian(millimetres);
  return millimetres;
}

}  // namespace geomap::messaging
