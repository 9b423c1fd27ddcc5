// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/jpeg.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <stdexcept>
#include <utility>

#include "messaging/allocation_peak.hpp"

namespace geomap::messaging {
namespace {

/// A smooth picture: what JPEG is good at.
geometry::ColorImage gradient(int width, int height) {
  geometry::ColorImage image{width, height, {}};
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      image.rgb.push_back(static_cast<std::uint8_t>(255 * u / 700));
      image.rgb.push_back(static_cast<std::uint8_t>(255 * v / 700));
      image.rgb.push_back(40);
    }
  }
  return image;
}

int largest_difference(const geometry::ColorImage& a, const geometry::ColorImage& b) {
  int largest = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) {
    largest = std::max(largest, std::abs(int{a.rgb[i]} - int{b.rgb[i]}));
  }
  return largest;
}

TEST(Jpeg, ImagesOfAnySizeSurvive) {
  for (const auto& [width, height] :
       {std::pair{1, 1}, std::pair{17, 3}, std::pair{160, 120}, std::pair{641, 479}}) {
    const geometry::ColorImage image = gradient(width, height);
    const auto back = decode_jpeg(encode_jpeg(image, 95));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->width, width);
    EXPECT_EQ(back->height, height);
    ASSERT_EQ(back->rgb.size(), image.rgb.size());
    EXPECT_LE(largest_difference(image, *back), 8);
  }
}

TEST(Jpeg, RedStaysRed) {
  geometry::ColorImage image{16, 16, {}};
  for (int i = 0; i < 256; ++i) image.rgb.insert(image.rgb.end(), {250, 10, 20});
  const auto back = decode_jpeg(encode_jpeg(image, 95));
  ASSERT_TRUE(back);
  EXPECT_LE(largest_difference(image, *back), 4);
}

TEST(Jpeg, LowerQualityTakesLessSpace) {
  const geometry::ColorImage image = gradient(320, 240);
  EXPECT_LT(encode_jpeg(image, 20).size(), encode_jpeg(image, 95).size());
}

TEST(Jpeg, ImagesThatDoNotFitTheirSizeAreACallersMistake) {
  EXPECT_THROW(encode_jpeg({}), std::invalid_argument);
  EXPECT_THROW(encode_jpeg({2, 2, std::vector<std::uint8_t>(11)}), std::invalid_argument);
  EXPECT_THROW(encode_jpeg({-2, -2, std::vector<std::uint8_t>(12)}), std::invalid_argument);
  EXPECT_THROW(encode_jpeg(gradient(8, 8), 0), std::invalid_argument);
  EXPECT_THROW(encode_jpeg(gradient(8, 8), 101), std::invalid_argument);
  EXPECT_THROW(encode_jpeg({70000, 1, std::vector<std::uint8_t>(210000)}),
               std::invalid_argument);  // beyond JPEG's 65 500
}

TEST(Jpeg, ACutStreamIsRefusedWhereverItIsCut) {
  const std::vector<std::uint8_t> stream = encode_jpeg(gradient(64, 48));
  for (std::size_t size = 0; size + 2 < stream.size(); ++size) {
    EXPECT_FALSE(decode_jpeg(std::span(stream).first(size))) << size;
  }
}

TEST(Jpeg, WhatIsNoJpegIsRefused) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    std::vector<std::uint8_t> noise(random() % 500);
    for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(random());
    EXPECT_FALSE(decode_jpeg(noise));
  }
}

TEST(Jpeg, FlippedBitsNeverBreakTheDecoder) {
  const std::vector<std::uint8_t> stream = encode_jpeg(gradient(64, 48));
  std::mt19937 random(2);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::uint8_t> damaged = stream;
    const std::size_t at = random() % damaged.size();
    damaged[at] = static_cast<std::uint8_t>(damaged[at] ^ (1U << (random() % 8)));
    testing::reset_allocation_peak();
    const auto image = decode_jpeg(damaged);
    ASSERT_LE(testing::allocation_peak(), 3 * 512 * damaged.size() + 1000);
    if (!image) ++refused;
  }
  EXPECT_GT(refused, 100);
}

/// Width and height stand 5 and 3 bytes behind the start-of-frame marker.
TEST(Jpeg, AHeaderCannotAskForMuchMemory) {
  std::vector<std::uint8_t> stream = encode_jpeg(gradient(16, 16));
  const std::vector<std::uint8_t> marker = {0xff, 0xc0};
  const auto frame = std::search(stream.begin(), stream.end(), marker.begin(), marker.end());
  ASSERT_NE(frame, stream.end());
  std::fill(frame + 5, frame + 9, std::uint8_t{0x1f});  // 7967 x 7967
  testing::reset_allocation_peak();
  EXPECT_FALSE(decode_jpeg(stream));
  EXPECT_LE(testing::allocation_peak(), 1000U);
  std::fill(frame + 5, frame + 9, std::uint8_t{0x7f});  // beyond the limit
  EXPECT_FALSE(decode_jpeg(stream));
}

}  // namespace
}  // namespace geomap::messaging
