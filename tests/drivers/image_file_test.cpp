// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/image_file.hpp"

#include <png.h>
#include <zlib.h>

#include <stdexcept>

#include "drivers/data_set_writer.hpp"
#include "drivers/frame_source.hpp"

namespace geomap::drivers {
namespace {

using geometry::ColorImage;
using geometry::DepthImage;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;
using testing::PngImage;
using ::testing::ThrowsMessage;
using Bytes = std::vector<std::uint8_t>;

class ImageFile : public ::testing::Test {
 protected:
  testing::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "image.png";

  void expect_depth_refused(const std::string& why) {
    EXPECT_THAT([&] { read_depth_png(file_); },
                ThrowsMessage<SourceError>(AllOf(HasSubstr(file_.string()), HasSubstr(why))));
  }
  Bytes color_of(const PngImage& image) {
    testing::write_png(file_, image);
    const ColorImage color = read_color_png(file_);
    EXPECT_EQ(color.width, image.width);
    EXPECT_EQ(color.height, image.height);
    return color.rgb;
  }
};

DepthImage all_values() {
  DepthImage depth{256, 256, {}};
  for (int i = 0; i < 65536; ++i) depth.millimetres.push_back(static_cast<std::uint16_t>(i));
  return depth;
}

TEST_F(ImageFile, EveryDepthValueComesBackAndOnly65535BecomesNoReading) {
  testing::write_depth_png(file_, all_values());
  const DepthImage depth = read_depth_png(file_);
  std::vector<std::uint16_t> expected = all_values().millimetres;
  expected[65535] = DepthImage::kNoReading;
  EXPECT_EQ(depth.millimetres, expected);
}

TEST_F(ImageFile, DepthOfFiveThousandUnitsAMetreIsRoundedToMillimetres) {
  testing::write_depth_png(file_, all_values());
  const DepthImage depth = read_depth_png(file_, 5000);
  for (std::size_t i = 0; i < 65535; ++i) {
    ASSERT_EQ(depth.millimetres[i], (2 * i + 5) / 10) << i;  // no value lies half-way
  }
  EXPECT_EQ(depth.millimetres[5000], 1000);
  EXPECT_EQ(depth.millimetres[65535], DepthImage::kNoReading);
}

TEST_F(ImageFile, DepthBeyondSixteenBitsOfMillimetresIsNoReading) {
  testing::write_depth_png(file_, {2, 1, {32767, 32768}});
  EXPECT_THAT(read_depth_png(file_, 500).millimetres, ElementsAre(65534, DepthImage::kNoReading));
}

TEST_F(ImageFile, InterlacedDepthOfAnOddSizeIsReadLikeAnyOther) {
  const DepthImage depth = testing::some_depth(3, 13, 7);
  PngImage image{13, 7, 16, PNG_COLOR_TYPE_GRAY, {}};
  for (const std::uint16_t value : depth.millimetres) {
    image.bytes.push_back(static_cast<std::uint8_t>(value >> 8));
    image.bytes.push_back(static_cast<std::uint8_t>(value & 0xff));
  }
  image.interlaced = true;
  testing::write_png(file_, image);
  const DepthImage read = read_depth_png(file_);
  testing::write_depth_png(file_, depth);
  EXPECT_EQ(read.millimetres, read_depth_png(file_).millimetres);
  EXPECT_EQ(read.at(12, 6), depth.at(12, 6));
}

TEST_F(ImageFile, ColorOfEveryPngKindBecomesRgb) {
  const Bytes rgb = {10, 20, 30, 40, 50, 60};
  EXPECT_EQ(color_of({2, 1, 8, PNG_COLOR_TYPE_RGB, rgb}), rgb);
  EXPECT_EQ(color_of({2, 1, 8, PNG_COLOR_TYPE_RGB_ALPHA, {10, 20, 30, 0, 40, 50, 60, 255}}), rgb);
  EXPECT_EQ(
      color_of({2, 1, 16, PNG_COLOR_TYPE_RGB, {10, 10, 20, 20, 30, 30, 40, 40, 50, 50, 60, 60}}),
      rgb);
  EXPECT_EQ(color_of({2, 1, 8, PNG_COLOR_TYPE_PALETTE, {1, 0}, {40, 50, 60, 10, 20, 30}}), rgb);
  EXPECT_EQ(color_of({2, 1, 1, PNG_COLOR_TYPE_PALETTE, {0x80}, {40, 50, 60, 10, 20, 30}, {7, 9}}),
            rgb);
  EXPECT_THAT(color_of({2, 1, 8, PNG_COLOR_TYPE_GRAY, {7, 200}}),
              ElementsAre(7, 7, 7, 200, 200, 200));
  EXPECT_THAT(color_of({2, 1, 8, PNG_COLOR_TYPE_GRAY_ALPHA, {7, 0, 200, 255}}),
              ElementsAre(7, 7, 7, 200, 200, 200));
  EXPECT_THAT(color_of({2, 1, 4, PNG_COLOR_TYPE_GRAY, {0x0f}}),
              ElementsAre(0, 0, 0, 255, 255, 255));
}

TEST_F(ImageFile, DepthThatIsNotSixteenBitGreyIsRefusedWithWhatItIs) {
  testing::write_png(file_, {2, 1, 8, PNG_COLOR_TYPE_GRAY, {7, 200}});
  expect_depth_refused("8-bit grey where 16-bit grey depth is wanted");
  testing::write_color_png(file_, testing::some_color(0));
  expect_depth_refused("8-bit colour where 16-bit grey depth is wanted");
}

TEST_F(ImageFile, APngCutAnywhereIsRefused) {
  testing::write_depth_png(file_, testing::some_depth(0));
  const Bytes whole = testing::file_bytes(file_);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    testing::write_bytes(file_, {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)});
    ASSERT_THROW(read_depth_png(file_), SourceError) << size;
  }
}

TEST_F(ImageFile, ADamagedByteInAPngNeverGivesOtherDepths) {
  const DepthImage depth = testing::some_depth(0);
  testing::write_depth_png(file_, depth);
  const DepthImage expected = read_depth_png(file_);
  const Bytes whole = testing::file_bytes(file_);
  int refused = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    Bytes damaged = whole;
    damaged[i] ^= 0x55;
    testing::write_bytes(file_, damaged);
    try {
      EXPECT_EQ(read_depth_png(file_).millimetres, expected.millimetres) << i;
    } catch (const SourceError&) {
      ++refused;
    }
  }
  EXPECT_GE(refused, static_cast<int>(whole.size()) - 4);
}

TEST_F(ImageFile, APngOfAnAbsurdSizeIsRefusedByItsHeader) {
  testing::write_depth_png(file_, testing::some_depth(0));
  const Bytes whole = testing::file_bytes(file_);
  for (const std::uint32_t width : {0x7fffffffU, kMaxImageSide + 1U, 0U}) {
    Bytes bytes = whole;  // the IHDR chunk: width at 16, checksum of 17 bytes from 12 on at 29
    const auto put = [&](std::size_t at, std::uint32_t value) {
      for (std::size_t i = 0; i < 4; ++i) {
        bytes[at + i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
      }
    };
    put(16, width);
    put(29, static_cast<std::uint32_t>(crc32(0, bytes.data() + 12, 17)));
    testing::write_bytes(file_, bytes);
    expect_depth_refused("Invalid IHDR data");
  }
}

TEST_F(ImageFile, WhatIsNoImageIsRefusedByName) {
  expect_depth_refused("no such file");
  testing::write_text(file_, "not an image at all");
  expect_depth_refused("not a usable PNG image");
  EXPECT_THROW(read_jpeg(file_), SourceError);
  testing::write_jpeg(file_, testing::some_color(0));
  expect_depth_refused("not a usable PNG image");
  std::filesystem::remove(file_);
  std::filesystem::create_directory(file_);
  expect_depth_refused("not a regular file");
  EXPECT_THROW(read_depth_png(file_, 0), std::invalid_argument);
}

TEST_F(ImageFile, AJpegKeepsItsBytesAndTellsItsSize) {
  testing::write_jpeg(file_, testing::some_color(5, 33, 17));
  const JpegFile jpeg = read_jpeg(file_);
  EXPECT_EQ(jpeg.width, 33);
  EXPECT_EQ(jpeg.height, 17);
  EXPECT_EQ(jpeg.bytes, testing::file_bytes(file_));
}

TEST_F(ImageFile, AJpegCutAnywhereIsRefused) {
  testing::write_jpeg(file_, testing::some_color(5, 33, 17));
  const Bytes whole = testing::file_bytes(file_);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    testing::write_bytes(file_, {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)});
    ASSERT_THROW(read_jpeg(file_), SourceError) << size;
  }
}

TEST_F(ImageFile, AJpegLargerThanAnyCameraIsRefused) {
  testing::write_jpeg(file_, testing::some_color(0, kMaxImageSide + 1, 1));
  EXPECT_THAT([&] { read_jpeg(file_); }, ThrowsMessage<SourceError>(HasSubstr("is too large")));
}

}  // namespace
}  // namespace geomap::drivers
