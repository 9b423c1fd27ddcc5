// SPDX-License-Identifier: BSD-3-Clause
#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <span>
#include <string>

#include "drivers/frame_source.hpp"
#include "drivers/image_file.hpp"
#include "drivers/input_file.hpp"

namespace geomap::drivers {
namespace {

using std::filesystem::path;

// No chunk of an honest image is larger; guards against bombs in compressed text and profiles.
constexpr png_alloc_size_t kMaxChunkBytes = png_alloc_size_t{8} << 20;

// libpng reports errors by longjmp: between setjmp and libpng no object may need a destructor, so
// the message goes into a plain array and everything that owns memory is made beforehand.
class PngDecoder {
 public:
  explicit PngDecoder(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, keep_error, ignore_warning);
    info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
  }
  ~PngDecoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngDecoder(const PngDecoder&) = delete;
  PngDecoder& operator=(const PngDecoder&) = delete;

  // Each step returns false when libpng gave up; error() says why.
  bool read_header() {
    if (info_ == nullptr || setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_user_limits(png_, kMaxImageSide, kMaxImageSide);
    png_set_chunk_malloc_max(png_, kMaxChunkBytes);
    png_set_read_fn(png_, this, read_memory);
    png_read_info(png_, info_);
    return true;
  }

  bool prepare_depth() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }

  bool prepare_rgb() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_expand(png_);  // palette, few-bit grey, transparent colour: to 8 bits and alpha
    png_set_scale_16(png_);
    png_set_gray_to_rgb(png_);
    png_set_strip_alpha(png_);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }

  bool read_rows(std::vector<png_bytep>& rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_image(png_, rows.data());
    png_read_end(png_, nullptr);
    return true;
  }

  int width() const { return static_cast<int>(png_get_image_width(png_, info_)); }
  int height() const { return static_cast<int>(png_get_image_height(png_, info_)); }
  int bit_depth() const { return png_get_bit_depth(png_, info_); }
  int color_type() const { return png_get_color_type(png_, info_); }
  std::size_t row_bytes() const { return png_get_rowbytes(png_, info_); }
  const char* error() const { return error_; }

 private:
  static void read_memory(png_structp png, png_bytep out, std::size_t count) {
    auto* self = static_cast<PngDecoder*>(png_get_io_ptr(png));
    if (count > self->bytes_.size()) png_error(png, "it ends too early");
    std::memcpy(out, self->bytes_.data(), count);
    self->bytes_ = self->bytes_.subspan(count);
  }
  [[noreturn]] static void keep_error(png_structp png, png_const_charp message) {
    auto* self = static_cast<PngDecoder*>(png_get_error_ptr(png));
    std::snprintf(self->error_, sizeof self->error_, "%s", message);
    png_longjmp(png, 1);
  }
  static void ignore_warning(png_structp, png_const_charp) {}

  std::span<const std::uint8_t> bytes_;  // not yet consumed
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  char error_[128] = "out of memory";
};

[[noreturn]] void refuse(const path& file, const std::string& why) {
  throw SourceError(file.string() + ": not a usable PNG image: " + why);
}

void check(bool done, const PngDecoder& png, const path& file) {
  if (!done) refuse(file, png.error());
}

std::string kind(const PngDecoder& png) {
  const int type = png.color_type();
  const char* name = (type & PNG_COLOR_MASK_PALETTE) ? "palette"
                     : (type & PNG_COLOR_MASK_COLOR) ? "colour"
                                                     : "grey";
  return std::to_string(png.bit_depth()) + "-bit " + name +
         ((type & PNG_COLOR_MASK_ALPHA) ? " with alpha" : "");
}

// Reads all rows into `pixels`, whose rows are `row_bytes` apart.
void read_pixels(PngDecoder& png, std::uint8_t* pixels, std::size_t row_bytes, const path& file) {
  if (png.row_bytes() != row_bytes) refuse(file, "rows of an unexpected length");
  std::vector<png_bytep> rows(static_cast<std::size_t>(png.height()));
  for (std::size_t v = 0; v < rows.size(); ++v) rows[v] = pixels + v * row_bytes;
  check(png.read_rows(rows), png, file);
}

std::uint16_t to_millimetres(std::uint16_t value, int units_per_metre) {
  if (!geometry::DepthImage::is_reading(value)) return geometry::DepthImage::kNoReading;
  const std::int64_t rounded =
      (std::int64_t{value} * 2000 + units_per_metre) / (std::int64_t{2} * units_per_metre);
  // Beyond what 16 bits of millimetres can say: no reading rather than a wrong one.
  return rounded < geometry::DepthImage::kInvalid ? static_cast<std::uint16_t>(rounded)
                                                  : geometry::DepthImage::kNoReading;
}

}  // namespace

geometry::DepthImage read_depth_png(const path& file, int units_per_metre) {
  if (units_per_metre <= 0) throw std::invalid_argument("units_per_metre must be positive");
  const std::vector<std::uint8_t> bytes = read_bytes(file);
  PngDecoder png(bytes);
  check(png.read_header(), png, file);
  if (png.bit_depth() != 16 || png.color_type() != PNG_COLOR_TYPE_GRAY) {
    refuse(file, "it is " + kind(png) + " where 16-bit grey depth is wanted");
  }
  check(png.prepare_depth(), png, file);

  geometry::DepthImage depth{png.width(), png.height(), {}};
  const auto width = static_cast<std::size_t>(depth.width);
  depth.millimetres.resize(width * static_cast<std::size_t>(depth.height));
  read_pixels(png, reinterpret_cast<std::uint8_t*>(depth.millimetres.data()), 2 * width, file);
  for (std::uint16_t& value : depth.millimetres) value = to_millimetres(value, units_per_metre);
  return depth;
}

geometry::ColorImage read_color_png(const path& file) {
  const std::vector<std::uint8_t> bytes = read_bytes(file);
  PngDecoder png(bytes);
  check(png.read_header(), png, file);
  check(png.prepare_rgb(), png, file);

  geometry::ColorImage color{png.width(), png.height(), {}};
  const auto width = static_cast<std::size_t>(color.width);
  color.rgb.resize(3 * width * static_cast<std::size_t>(color.height));
  read_pixels(png, color.rgb.data(), 3 * width, file);
  return color;
}

}  // namespace geomap::drivers
