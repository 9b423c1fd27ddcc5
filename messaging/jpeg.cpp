// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/jpeg.hpp"

#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>

// Last: it needs size_t and FILE, and includes neither.
#include <jpeglib.h>

namespace geomap::messaging {
namespace {

/// libjpeg reports a fatal error by a call that must not return.
struct ErrorManager {
  jpeg_error_mgr base{};
  std::jmp_buf escape{};
};

void escape_from_error(j_common_ptr codec) {
  std::longjmp(reinterpret_cast<ErrorManager*>(codec->err)->escape, 1);
}

void swallow_message(j_common_ptr /*codec*/) {}

jpeg_error_mgr* install(ErrorManager& errors) {
  jpeg_error_mgr* base = jpeg_std_error(&errors.base);
  base->error_exit = escape_from_error;
  base->output_message = swallow_message;
  return base;
}

// Between setjmp and longjmp no object with a destructor may be created: the functions below hold
// plain data only, their callers own all memory.

/// False when the image cannot be encoded. `*stream` is malloc's, the caller's to free.
bool compress(const geometry::ColorImage& image, int quality, unsigned char** stream,
              unsigned long* size) {
  jpeg_compress_struct codec{};
  ErrorManager errors;
  codec.err = install(errors);
  if (setjmp(errors.escape) != 0) {
    jpeg_destroy_compress(&codec);
    return false;
  }
  jpeg_create_compress(&codec);
  jpeg_mem_dest(&codec, stream, size);
  codec.image_width = static_cast<JDIMENSION>(image.width);
  codec.image_height = static_cast<JDIMENSION>(image.height);
  codec.input_components = 3;
  codec.in_color_space = JCS_RGB;
  jpeg_set_defaults(&codec);
  jpeg_set_quality(&codec, quality, TRUE);
  jpeg_start_compress(&codec, TRUE);
  const std::size_t stride = 3 * static_cast<std::size_t>(image.width);
  while (codec.next_scanline < codec.image_height) {
    // libjpeg's interface lacks const; it only reads.
    JSAMPROW row = const_cast<JSAMPROW>(image.rgb.data() + codec.next_scanline * stride);
    jpeg_write_scanlines(&codec, &row, 1);
  }
  jpeg_finish_compress(&codec);
  jpeg_destroy_compress(&codec);
  return true;
}

struct ImageSize {
  JDIMENSION width = 0;
  JDIMENSION height = 0;
};

/// Size zero when there is no sound header.
ImageSize read_size(std::span<const std::uint8_t> data) {
  jpeg_decompress_struct codec{};
  ErrorManager errors;
  codec.err = install(errors);
  if (setjmp(errors.escape) != 0) {
    jpeg_destroy_decompress(&codec);
    return {};
  }
  jpeg_create_decompress(&codec);
  jpeg_mem_src(&codec, data.data(), static_cast<unsigned long>(data.size()));
  jpeg_read_header(&codec, TRUE);
  const ImageSize size{codec.image_width, codec.image_height};
  jpeg_destroy_decompress(&codec);
  return size;
}

/// Fills the pixels of an image of the size in the header; false for an error or a warning: damaged
/// data decodes to grey, with a warning only.
bool decompress(std::span<const std::uint8_t> data, std::uint8_t* rgb) {
  jpeg_decompress_struct codec{};
  ErrorManager errors;
  codec.err = install(errors);
  if (setjmp(errors.escape) != 0) {
    jpeg_destroy_decompress(&codec);
    return false;
  }
  jpeg_create_decompress(&codec);
  jpeg_mem_src(&codec, data.data(), static_cast<unsigned long>(data.size()));
  jpeg_read_header(&codec, TRUE);
  codec.out_color_space = JCS_RGB;
  jpeg_start_decompress(&codec);
  const std::size_t stride = 3 * static_cast<std::size_t>(codec.output_width);
  while (codec.output_scanline < codec.output_height && errors.base.num_warnings == 0) {
    JSAMPROW row = rgb + codec.output_scanline * stride;
    jpeg_read_scanlines(&codec, &row, 1);
  }
  if (errors.base.num_warnings == 0) jpeg_finish_decompress(&codec);
  const bool sound = errors.base.num_warnings == 0;
  jpeg_destroy_decompress(&codec);
  return sound;
}

}  // namespace

std::vector<std::uint8_t> encode_jpeg(const geometry::ColorImage& image, int quality) {
  const auto pixels =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (image.width <= 0 || image.height <= 0 || image.rgb.size() != 3 * pixels) {
    throw std::invalid_argument("encode_jpeg: width, height and number of bytes do not fit");
  }
  if (quality < 1 || quality > 100) throw std::invalid_argument("encode_jpeg: quality 1 to 100");

  unsigned char* stream = nullptr;
  unsigned long size = 0;
  const bool done = compress(image, quality, &stream, &size);
  const std::unique_ptr<unsigned char, decltype(&std::free)> owner(stream, &std::free);
  if (!done) throw std::invalid_argument("encode_jpeg: libjpeg refuses this image");
  return {stream, stream + size};
}

std::optional<geometry::ColorImage> decode_jpeg(std::span<const std::uint8_t> data) {
  // Even a uniform image takes more than a bit for every block of 8x8 pixels, so a header alone
  // cannot ask for much memory.
  constexpr std::size_t kPixelsPerByte = 512;
  if (data.empty()) return std::nullopt;
  const ImageSize size = read_size(data);
  const std::size_t pixels = std::size_t{size.width} * size.height;
  if (pixels == 0 || size.width > kMaxImageSide || size.height > kMaxImageSide ||
      pixels / kPixelsPerByte > data.size()) {
    return std::nullopt;
  }
  geometry::ColorImage image;
  image.width = static_cast<int>(size.width);
  image.height = static_cast<int>(size.height);
  image.rgb.resize(3 * pixels);
  if (!decompress(data, image.rgb.data())) return std::nullopt;
  return image;
}

}  // namespace geomap::messaging
