// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/depth_codec.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <random>

#include "messaging/allocation_peak.hpp"

namespace geomap::messaging {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes some_bytes(std::size_t size) {
  std::mt19937 random(1);
  Bytes bytes(size);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() % 7);
  return bytes;
}

TEST(DepthCodec, ZlibReadsWhatIsDeflated) {
  const Bytes bytes = some_bytes(100000);
  const Bytes stream = deflate_bytes(bytes);
  Bytes inflated(bytes.size());
  uLongf size = inflated.size();
  ASSERT_EQ(uncompress(inflated.data(), &size, stream.data(), stream.size()), Z_OK);
  EXPECT_EQ(size, bytes.size());
  EXPECT_EQ(inflated, bytes);
}

TEST(DepthCodec, ALevelThatThereIsNotIsRefused) {
  EXPECT_THROW(deflate_bytes(some_bytes(10), 13), std::invalid_argument);
}

TEST(DepthCodec, BytesSurviveEveryLevel) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{100000}}) {
    const Bytes bytes = some_bytes(size);
    for (const int level : {0, 1, 6, 12}) {
      EXPECT_EQ(inflate_bytes(deflate_bytes(bytes, level), size), bytes);
    }
  }
}

TEST(DepthCodec, AStreamOfAnotherSizeIsRefused) {
  const Bytes stream = deflate_bytes(some_bytes(1000));
  EXPECT_TRUE(inflate_bytes(stream, 1000));
  EXPECT_FALSE(inflate_bytes(stream, 999));
  EXPECT_FALSE(inflate_bytes(stream, 1001));
  EXPECT_FALSE(inflate_bytes(stream, 0));
}

TEST(DepthCodec, ACutOrLengthenedStreamIsRefused) {
  Bytes stream = deflate_bytes(some_bytes(1000));
  for (std::size_t size = 0; size < stream.size(); ++size) {
    EXPECT_FALSE(inflate_bytes(std::span(stream).first(size), 1000)) << size;
  }
  stream.push_back(0);
  EXPECT_FALSE(inflate_bytes(stream, 1000));
}

/// zlib's checksum is weak where small differences cancel out, so not every flip is noticed.
TEST(DepthCodec, FlippedBitsAreNearlyAlwaysNoticed) {
  const Bytes bytes = some_bytes(1000);
  const Bytes stream = deflate_bytes(bytes);
  std::size_t unnoticed = 0;
  for (std::size_t bit = 0; bit < 8 * stream.size(); ++bit) {
    Bytes damaged = stream;
    damaged[bit / 8] = static_cast<std::uint8_t>(damaged[bit / 8] ^ (1U << (bit % 8)));
    const auto inflated = inflate_bytes(damaged, 1000);
    if (inflated && *inflated != bytes) ++unnoticed;
  }
  EXPECT_LT(unnoticed, stream.size() * 8 / 200);
}

TEST(DepthCodec, AZipBombDoesNotGoOff) {
  const Bytes bomb = deflate_bytes(Bytes(10'000'000, 0), 9);
  testing::reset_allocation_peak();
  EXPECT_FALSE(inflate_bytes(bomb, 1000));
  EXPECT_LE(testing::allocation_peak(), 100'000U);
}

TEST(DepthCodec, AShortStreamCannotAskForMuchMemory) {
  testing::reset_allocation_peak();
  EXPECT_FALSE(inflate_bytes(some_bytes(100), 1'000'000'000));
  EXPECT_LE(testing::allocation_peak(), 1'000U);
}

TEST(DepthCodec, DepthIsLittleEndianOnTheWire) {
  const std::vector<std::uint16_t> depth = {0x0102, 0xfffe};
  EXPECT_EQ(inflate_bytes(compress_depth(depth), 4), (Bytes{0x02, 0x01, 0xfe, 0xff}));
}

TEST(DepthCodec, DepthSurvives) {
  std::vector<std::uint16_t> depth(640 * 48);
  std::mt19937 random(2);
  for (std::uint16_t& value : depth) value = static_cast<std::uint16_t>(random() % 4000);
  const Bytes stream = compress_depth(depth);
  EXPECT_EQ(decompress_depth(stream, depth.size()), depth);
  EXPECT_FALSE(decompress_depth(stream, depth.size() - 1));
  EXPECT_FALSE(decompress_depth(stream, depth.size() + 1));
  EXPECT_FALSE(decompress_depth(std::span(stream).first(stream.size() - 1), depth.size()));
  EXPECT_FALSE(decompress_depth(some_bytes(100), 1'000'000'000));
}

TEST(DepthCodec, PaddingOfRowsIsDropped) {
  const Bytes rows = {1, 0, 2, 0, 99, 99, 3, 0, 4, 0, 99, 99};
  EXPECT_EQ(unpack_depth(rows, 2, 2, 6), (std::vector<std::uint16_t>{1, 2, 3, 4}));
}

TEST(DepthCodec, RowsThatDoNotFitAreRefused) {
  const Bytes rows(12, 1);
  EXPECT_TRUE(unpack_depth(rows, 3, 2, 6));
  EXPECT_FALSE(unpack_depth(rows, 4, 2, 6));   // a row longer than its stride
  EXPECT_FALSE(unpack_depth(rows, 3, 3, 6));   // too few rows
  EXPECT_FALSE(unpack_depth(rows, 3, 1, 6));   // too many
  EXPECT_FALSE(unpack_depth(rows, 0, 2, 6));   // no columns
  EXPECT_FALSE(unpack_depth(rows, 3, -2, 6));  // negative
  EXPECT_FALSE(unpack_depth(rows, 3, 5, 6));   // not divisible
}

}  // namespace
}  // namespace geomap::messaging
