// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/health.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "messaging/sequence_gaps.hpp"

namespace geomap::messaging {
namespace {

TEST(Latency, QuantilesAreGoodToATwentieth) {
  std::mt19937 random(1);
  std::lognormal_distribution<double> some(-5.0, 1.5);
  Latency latency;
  std::vector<double> all;
  for (int i = 0; i < 10'000; ++i) {
    all.push_back(some(random));
    latency.add(all.back());
  }
  std::sort(all.begin(), all.end());
  for (const double share : {0.1, 0.5, 0.95, 0.99}) {
    const double exact = all[static_cast<std::size_t>(share * 10'000.0) - 1];
    EXPECT_NEAR(latency.quantile(share), exact, 0.05 * exact) << share;
  }
  EXPECT_EQ(latency.max(), all.back());
  EXPECT_EQ(latency.count(), 10'000);
  EXPECT_EQ(Latency().quantile(0.5), 0.0);
}

TEST(Latency, WhatIsLongerThanTheLastClassCountsThere) {
  Latency latency;
  latency.add(1e9);
  latency.add(0.0);
  EXPECT_LT(latency.quantile(0.5), 2e-6);
  EXPECT_EQ(latency.max(), 1e9);
}

TEST(Health, LatenciesOfAMessageAreThoseSinceTheLastOne) {
  Health health("geomap-test", "hash", 5);
  health.count("frames", 3);
  health.set("rejected", 0);
  health.time("stage", 0.1);
  geomap::health_t message = health.take_message();
  EXPECT_EQ(message.process, "geomap-test");
  EXPECT_EQ(message.started, 5);
  ASSERT_EQ(message.n_counters, 1);
  EXPECT_EQ(message.counters[0].name, "frames");
  EXPECT_EQ(message.counters[0].value, 3);
  ASSERT_EQ(message.n_stages, 1);
  EXPECT_EQ(message.stages[0].count, 1);
  EXPECT_NEAR(message.stages[0].p50, 0.1, 0.005);
  message = health.take_message();
  EXPECT_EQ(message.stages[0].count, 0);
  EXPECT_NE(health.summary().find("1 runs"), std::string::npos);
}

TEST(SequenceGaps, CountsWhatIsMissing) {
  SequenceGaps gaps;
  EXPECT_EQ(gaps.note(5), 0);
  EXPECT_EQ(gaps.note(6), 0);
  EXPECT_EQ(gaps.note(9), 2);
  EXPECT_EQ(gaps.note(8), 0);           // out of order
  EXPECT_EQ(gaps.note(50'000'000), 0);  // another sender
}

TEST(SequenceGaps, ANewSessionBeginsAnew) {
  SequenceGaps gaps;
  EXPECT_EQ(gaps.note(100, 0), 0);
  EXPECT_EQ(gaps.note(100, 2), 1);
  EXPECT_EQ(gaps.note(200, 7), 0);
  EXPECT_EQ(gaps.note(200, 9), 1);
}

}  // namespace
}  // namespace geomap::messaging
