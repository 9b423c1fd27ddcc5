// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/log_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <stdexcept>

#include "messaging/allocation_peak.hpp"
#include "messaging/log_writer.hpp"
#include "messaging/temporary_folder.hpp"

namespace geomap::messaging {
namespace {

constexpr std::size_t kHeaderSize = 28;

class LogReaderTest : public testing::TemporaryFolder {
 protected:
  struct Written {
    std::string channel;
    std::int64_t utime = 0;
    std::vector<std::uint8_t> data;
  };

  /// A log of 20 events with odd channels and time stamps that go back and forth.
  std::string write_log() {
    std::mt19937 random(5);
    LogWriter writer(path("test.lcmlog"));
    for (int i = 0; i < 20; ++i) {
      Written event{i % 3 == 0 ? "LCM_SELF_TEST" : "CHANNEL_" + std::to_string(i),
                    1000 + (i % 4) * 500 - i, std::vector<std::uint8_t>(random() % 2000)};
      for (std::uint8_t& byte : event.data) byte = static_cast<std::uint8_t>(random());
      writer.write_bytes(event.channel, event.utime, event.data);
      offsets_.push_back(length_);
      length_ += kHeaderSize + event.channel.size() + event.data.size();
      written_.push_back(std::move(event));
    }
    writer.close();
    return path("test.lcmlog");
  }

  /// Reads to the end; checks that every event is one that was written, in order.
  std::vector<std::size_t> read_all(LogReader& reader) {
    std::vector<std::size_t> numbers;
    while (const auto event = reader.next()) {
      const auto number = static_cast<std::size_t>(event->number);
      EXPECT_LT(number, written_.size());
      EXPECT_EQ(event->channel, written_[number].channel);
      EXPECT_EQ(event->log_utime, written_[number].utime);
      EXPECT_EQ(event->data, written_[number].data);
      numbers.push_back(number);
    }
    EXPECT_EQ(reader.position(), reader.size());
    return numbers;
  }

  std::string message_of_opening(const std::string& file) {
    try {
      LogReader reader(file);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  std::vector<Written> written_;
  std::vector<std::size_t> offsets_;
  std::size_t length_ = 0;
};

TEST_F(LogReaderTest, GivesBackEveryEventInFileOrder) {
  LogReader reader(write_log());
  EXPECT_EQ(reader.size(), static_cast<std::int64_t>(length_));
  EXPECT_EQ(read_all(reader).size(), 20U);
  EXPECT_TRUE(reader.damages().empty());
  EXPECT_FALSE(reader.truncated());
}

TEST_F(LogReaderTest, TellsHowFarItIs) {
  LogReader reader(write_log());
  EXPECT_EQ(reader.position(), 0);
  reader.next();
  EXPECT_EQ(reader.position(), static_cast<std::int64_t>(offsets_[1]));
}

TEST_F(LogReaderTest, ALogCutAnywhereGivesAllCompleteEvents) {
  const std::string whole = read_file(write_log());
  for (std::size_t cut = offsets_[18] + 1; cut < whole.size(); cut += 7) {
    LogReader reader(write_file("cut.lcmlog", whole.substr(0, cut)));
    const std::size_t complete = cut < offsets_[19] ? 18 : 19;
    EXPECT_EQ(read_all(reader).size(), complete) << "cut at " << cut;
    if (cut == offsets_[19]) continue;
    ASSERT_TRUE(reader.truncated()) << "cut at " << cut;
    EXPECT_EQ(reader.damages().back().offset, static_cast<std::int64_t>(offsets_[complete]));
    EXPECT_EQ(reader.damages().back().size, static_cast<std::int64_t>(cut - offsets_[complete]));
  }
}

TEST_F(LogReaderTest, ADamagedMagicWordOrLengthLosesOnlyItsOwnEvent) {
  const std::string whole = read_file(write_log());
  std::vector<std::size_t> others(20);
  std::iota(others.begin(), others.end(), std::size_t{0});
  others.erase(others.begin() + 7);
  // Magic word, length of the channel, length of the data; by little and by much, up and down.
  for (const std::size_t at : {0, 1, 2, 3, 20, 21, 22, 23, 24, 25, 26, 27}) {
    for (const int change : {-60, -5, -3, -2, -1, 1, 2, 3, 4, 5, 27, 28, 60, 127}) {
      std::string damaged = whole;
      damaged[offsets_[7] + at] = static_cast<char>(damaged[offsets_[7] + at] + change);
      LogReader reader(write_file("damaged.lcmlog", damaged));
      ASSERT_EQ(read_all(reader), others) << "byte " << at << " changed by " << change;
      ASSERT_EQ(reader.damages().size(), 1U);
      EXPECT_EQ(reader.damages()[0].offset, static_cast<std::int64_t>(offsets_[7]));
      EXPECT_EQ(reader.damages()[0].size, static_cast<std::int64_t>(offsets_[8] - offsets_[7]));
      EXPECT_FALSE(reader.truncated());
    }
  }
}

TEST_F(LogReaderTest, AHeaderFullOfNoiseLosesOnlyItsOwnEvent) {
  std::string damaged = read_file(write_log());
  for (std::size_t i = 0; i < kHeaderSize; ++i) damaged[offsets_[19] + i] = static_cast<char>(i);
  LogReader reader(write_file("noise.lcmlog", damaged));
  EXPECT_EQ(read_all(reader).size(), 19U);
}

TEST_F(LogReaderTest, ALengthThatClaimsTheEventsBehindItLosesOnlyItsOwn) {
  const std::string whole = read_file(write_log());
  std::vector<std::size_t> others(20);
  std::iota(others.begin(), others.end(), std::size_t{0});
  others.erase(others.begin() + 5);
  // Into the midst of an event, and exactly to where one begins.
  for (const std::size_t end : {offsets_[8] + 1, offsets_[8], length_}) {
    std::string bytes = whole;
    const std::size_t claimed = end - (offsets_[5] + kHeaderSize + written_[5].channel.size());
    for (std::size_t i = 0; i < 4; ++i) {
      bytes[offsets_[5] + 24 + i] = static_cast<char>(claimed >> (24 - 8 * i));
    }
    LogReader reader(write_file("claims.lcmlog", bytes));
    EXPECT_EQ(read_all(reader), others);
    ASSERT_EQ(reader.damages().size(), 1u);
    EXPECT_EQ(reader.damages()[0].offset, static_cast<std::int64_t>(offsets_[5]));
    EXPECT_EQ(reader.damages()[0].size, static_cast<std::int64_t>(offsets_[6] - offsets_[5]));
  }
}

TEST_F(LogReaderTest, ALogWithinAMessageIsAMessage) {
  const std::string inner = read_file(write_log());
  LogWriter writer(path("outer.lcmlog"));
  for (int i = 0; i < 3; ++i) {
    writer.copy({500 * i, 0, "LOG", std::vector<std::uint8_t>(inner.begin(), inner.end())});
  }
  writer.close();
  LogReader reader(path("outer.lcmlog"));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(reader.next()->data.size(), inner.size());
  EXPECT_TRUE(reader.damages().empty());
}

TEST_F(LogReaderTest, AHugeLengthInAHeaderIsNotAllocated) {
  std::string damaged = read_file(write_log());
  for (const char* length : {"\x3f\xff\xff\xff", "\x7f\xff\xff\xff", "\xff\xff\xff\xff"}) {
    damaged.replace(offsets_[7] + 24, 4, length, 4);
    LogReader reader(write_file("huge.lcmlog", damaged));
    testing::reset_allocation_peak();
    EXPECT_EQ(read_all(reader).size(), 19U);
    EXPECT_LE(testing::allocation_peak(), 200'000U);
  }
}

TEST_F(LogReaderTest, NoiseBeforeTheFirstEventIsPassedOver) {
  const std::string noise(1000, '\xed');
  LogReader reader(write_file("noise.lcmlog", noise + read_file(write_log())));
  EXPECT_EQ(read_all(reader).size(), 20U);
  ASSERT_EQ(reader.damages().size(), 1U);
  EXPECT_EQ(reader.damages()[0].size, 1000);
}

TEST_F(LogReaderTest, FlippedBitsNeverBreakIt) {
  const std::string whole = read_file(write_log());
  std::mt19937 random(9);
  for (int i = 0; i < 200; ++i) {
    std::string damaged = whole;
    for (int k = 0; k < 20; ++k) {
      const std::size_t at = offsets_[random() % offsets_.size()] + random() % kHeaderSize;
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << (random() % 8)));
    }
    LogReader reader(write_file("flipped.lcmlog", damaged));
    std::int64_t bytes = 0;
    while (const auto event = reader.next()) {
      bytes += static_cast<std::int64_t>(kHeaderSize + event->channel.size() + event->data.size());
    }
    for (const LogDamage& damage : reader.damages()) bytes += damage.size;
    EXPECT_EQ(bytes, reader.size());  // every byte is either read or reported
  }
}

TEST_F(LogReaderTest, WhatIsNoLogIsSaidInOneLine) {
  using ::testing::AllOf;
  using ::testing::HasSubstr;
  using ::testing::Not;
  const auto one_line = [](const std::string& reason, const std::string& file) {
    return AllOf(HasSubstr(reason), HasSubstr(file), Not(HasSubstr("\n")));
  };
  EXPECT_THAT(message_of_opening(path("missing.lcmlog")),
              one_line("No such file", "missing.lcmlog"));
  EXPECT_THAT(message_of_opening(write_file("empty.lcmlog", "")),
              one_line("empty", "empty.lcmlog"));
  EXPECT_THAT(message_of_opening(write_file("text.lcmlog", std::string(100000, 'x'))),
              one_line("not an LCM log", "text.lcmlog"));
  EXPECT_THAT(message_of_opening(path("")), one_line("folder", "WhatIsNoLog"));
}

}  // namespace
}  // namespace geomap::messaging
