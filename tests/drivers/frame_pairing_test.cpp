// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/frame_pairing.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace geomap::drivers {
namespace {

constexpr std::int64_t kTolerance = 16'000;

// As a FramePairing that nothing but the sensor's clock matters to.
struct Pairing : FramePairing {
  using FramePairing::FramePairing;
  std::optional<ImagePair> add(CameraImage image) { return FramePairing::add(std::move(image), 0); }
};

CameraImage depth(std::int64_t time, std::uint16_t value = 1) {
  return {time, geometry::DepthImage{1, 1, {value}}};
}
CameraImage color(std::int64_t time, std::uint8_t value = 1) {
  return {time, geometry::ColorImage{1, 1, {value, value, value}}};
}

TEST(FramePairing, DepthAndColourOfOneMomentArePairedInEitherOrder) {
  Pairing pairing(kTolerance);
  EXPECT_FALSE(pairing.add(depth(100'000, 7)));
  const auto first = pairing.add(color(110'000, 8));
  ASSERT_TRUE(first);
  EXPECT_EQ(first->sensor_time, 100'000);
  EXPECT_EQ(first->depth.millimetres[0], 7);
  EXPECT_EQ(first->color.rgb[0], 8);
  EXPECT_FALSE(pairing.add(color(133'000)));
  EXPECT_TRUE(pairing.add(depth(133'000)));
  EXPECT_EQ(pairing.unpaired(), 0);
}

TEST(FramePairing, AnImageWithoutItsPartnerIsCountedAndTheNextArePaired) {
  Pairing pairing(kTolerance);
  EXPECT_FALSE(pairing.add(depth(0)));
  EXPECT_FALSE(pairing.add(color(33'000)));
  EXPECT_TRUE(pairing.add(depth(33'000)));
  EXPECT_EQ(pairing.unpaired(), 1);
}

TEST(FramePairing, ColourThatComesThreeFramesLateIsPairedStill) {
  Pairing pairing(kTolerance);
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(pairing.add(depth(i * 33'000)));
  for (int i = 0; i < 3; ++i) {
    const auto pair = pairing.add(color(i * 33'000));
    ASSERT_TRUE(pair);
    EXPECT_EQ(pair->sensor_time, i * 33'000);
  }
  EXPECT_EQ(pairing.unpaired(), 0);
}

TEST(FramePairing, DepthWithoutAnyColourDoesNotPileUp) {
  Pairing pairing(kTolerance);
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(pairing.add(depth(i * 33'000)));
  EXPECT_EQ(pairing.unpaired(), 92);
}

TEST(FramePairing, JustWithinTheToleranceIsOneMomentJustBeyondIsNot) {
  Pairing pairing(kTolerance);
  pairing.add(depth(0));
  EXPECT_TRUE(pairing.add(color(kTolerance)));
  pairing.add(depth(100'000));
  EXPECT_FALSE(pairing.add(color(100'000 + kTolerance + 1)));
}

TEST(FramePairing, APairHasTheArrivalOfItsDepth) {
  FramePairing pairing(kTolerance);
  pairing.add(color(100'000), 500'000);
  EXPECT_EQ(pairing.add(depth(100'000), 530'000)->arrival, 530'000);
}

TEST(FramePairing, WhatWaitsIsGivenUpForAnotherCamera) {
  Pairing pairing(kTolerance);
  pairing.add(depth(100'000));
  pairing.clear();
  EXPECT_FALSE(pairing.add(color(100'000)));
  EXPECT_EQ(pairing.unpaired(), 1);
}

}  // namespace
}  // namespace geomap::drivers
