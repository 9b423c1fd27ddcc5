// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/inbox.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace geomap::messaging {
namespace {

using namespace std::chrono_literals;

Received message(const std::string& channel, std::uint8_t content, std::size_t size = 1) {
  return {channel, std::vector<std::uint8_t>(size, content)};
}

std::vector<std::pair<std::string, int>> contents(Inbox& inbox) {
  std::vector<std::pair<std::string, int>> all;
  while (const auto next = inbox.take(Inbox::Clock::now())) {
    all.emplace_back(next->channel, next->data.front());
  }
  return all;
}

using Contents = std::vector<std::pair<std::string, int>>;

TEST(Inbox, KeepsTheOrderOfArrival) {
  Inbox inbox(1000, WhenFull::kDrop);
  inbox.put(message("A", 1), Keep::kEvery);
  inbox.put(message("B", 2), Keep::kEvery);
  inbox.put(message("A", 3), Keep::kEvery);
  EXPECT_EQ(contents(inbox), (Contents{{"A", 1}, {"B", 2}, {"A", 3}}));
}

TEST(Inbox, ANewerMessageTakesThePlaceOfOneThatWaits) {
  Inbox inbox(1000, WhenFull::kDrop);
  inbox.put(message("FRAME", 1), Keep::kNewest);
  inbox.put(message("POSE", 2), Keep::kEvery);
  inbox.put(message("FRAME", 3), Keep::kNewest);
  inbox.put(message("POSE", 4), Keep::kEvery);
  EXPECT_EQ(contents(inbox), (Contents{{"POSE", 2}, {"FRAME", 3}, {"POSE", 4}}));
  EXPECT_EQ(inbox.replaced().at("FRAME"), 1);
  inbox.put(message("FRAME", 5), Keep::kNewest);  // the last one has been taken
  EXPECT_EQ(contents(inbox), (Contents{{"FRAME", 5}}));
  EXPECT_EQ(inbox.replaced().at("FRAME"), 1);
}

TEST(Inbox, WhatFindsNoRoomIsCounted) {
  Inbox inbox(100, WhenFull::kDrop);
  for (int i = 0; i < 5; ++i) {
    inbox.put(message("A", static_cast<std::uint8_t>(i), 40), Keep::kEvery);
  }
  EXPECT_EQ(inbox.overflowed(), 3);
  EXPECT_EQ(contents(inbox), (Contents{{"A", 0}, {"A", 1}}));
  inbox.put(message("A", 9, 1000), Keep::kEvery);  // alone, it may be as large as it likes
  EXPECT_EQ(contents(inbox), (Contents{{"A", 9}}));
}

TEST(Inbox, AFullOneHoldsTheSenderBackAndLosesNothing) {
  Inbox inbox(100, WhenFull::kWait);
  std::thread sender([&] {
    for (int i = 0; i < 100; ++i) {
      inbox.put(message("A", static_cast<std::uint8_t>(i), 40), Keep::kEvery);
    }
  });
  for (int i = 0; i < 100; ++i) {
    const auto next = inbox.take(Inbox::Clock::now() + 10s);
    ASSERT_TRUE(next);
    EXPECT_EQ(next->data.front(), i);
  }
  sender.join();
  EXPECT_EQ(inbox.overflowed(), 0);
}

TEST(Inbox, ClosingLetsASenderThatWaitsGo) {
  Inbox inbox(10, WhenFull::kWait);
  inbox.put(message("A", 1, 10), Keep::kEvery);
  std::thread sender([&] { inbox.put(message("A", 2, 10), Keep::kEvery); });
  inbox.close();
  sender.join();
  EXPECT_EQ(contents(inbox), (Contents{{"A", 1}}));
}

TEST(Inbox, OneChannelCanBeTakenBeforeTheOthers) {
  Inbox inbox(1000, WhenFull::kDrop);
  inbox.put(message("A", 1), Keep::kEvery);
  inbox.put(message("HEALTH", 2), Keep::kEvery);
  EXPECT_EQ(inbox.take("HEALTH", Inbox::Clock::now())->data.front(), 2);
  EXPECT_FALSE(inbox.take("HEALTH", Inbox::Clock::now()));
  EXPECT_EQ(contents(inbox), (Contents{{"A", 1}}));
}

}  // namespace
}  // namespace geomap::messaging
