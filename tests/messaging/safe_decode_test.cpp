// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/safe_decode.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <limits>
#include <set>
#include <string>

#include "messaging/all_types.hpp"
#include "messaging/allocation_peak.hpp"
#include "messaging/encode.hpp"
#include "messaging/random_message.hpp"

namespace geomap::messaging {
namespace {

using Bytes = std::vector<std::uint8_t>;
using testing::random_message;
using testing::RandomMessage;

template <class Message>
DecodeResult<Message> decode(const Bytes& bytes) {
  return safe_decode<Message>(bytes.data(), bytes.size());
}

/// What a decoded message may take for every byte of its encoded form, containers included.
constexpr std::size_t kMemoryPerByte = 64;

template <class Message>
class SafeDecodeOf : public ::testing::Test {
 protected:
  /// Layouts and limits are read at first use; the tests measure what a message costs after that.
  static void SetUpTestSuite() {
    std::mt19937 random(1);
    decode<Message>(random_message(schema(), random).bytes);
  }
  static const MessageSchema& schema() { return *known_schemas().find(Message::getHash()); }
  std::mt19937 random_{20121};
};
TYPED_TEST_SUITE(SafeDecodeOf, testing::AllTypes);

TYPED_TEST(SafeDecodeOf, GivesBackSoundMessagesToTheLastByte) {
  for (int i = 0; i < 50; ++i) {
    const RandomMessage message = random_message(this->schema(), this->random_);
    const auto result = decode<TypeParam>(message.bytes);
    ASSERT_TRUE(result.message) << to_string(result.reason);
    EXPECT_EQ(encode(*result.message), message.bytes);
  }
}

TYPED_TEST(SafeDecodeOf, RefusesAMessageCutAtAnyByte) {
  const RandomMessage message = random_message(this->schema(), this->random_, true);
  for (std::size_t size = 0; size < message.bytes.size(); ++size) {
    const auto result = safe_decode<TypeParam>(message.bytes.data(), size);
    ASSERT_FALSE(result.message) << "cut at " << size;
    ASSERT_EQ(result.reason, size < 8 ? RejectReason::kTooShort : RejectReason::kTruncated);
  }
}

TYPED_TEST(SafeDecodeOf, RefusesBytesBehindTheLastField) {
  RandomMessage message = random_message(this->schema(), this->random_, true);
  message.bytes.push_back(0);
  EXPECT_EQ(decode<TypeParam>(message.bytes).reason, RejectReason::kTrailing);
}

TYPED_TEST(SafeDecodeOf, RefusesAnotherTypesFingerprint) {
  RandomMessage message = random_message(this->schema(), this->random_, true);
  message.bytes[7] = static_cast<std::uint8_t>(message.bytes[7] ^ 1);
  EXPECT_EQ(decode<TypeParam>(message.bytes).reason, RejectReason::kWrongType);
}

TYPED_TEST(SafeDecodeOf, RefusesNegativeCounts) {
  const RandomMessage message = random_message(this->schema(), this->random_, true);
  for (const RandomMessage::Place& count : message.counts) {
    Bytes bytes = message.bytes;
    testing::write_number(bytes, count, ~std::uint64_t{0});
    EXPECT_EQ(decode<TypeParam>(bytes).reason, RejectReason::kBadCount) << "at " << count.offset;
  }
}

TYPED_TEST(SafeDecodeOf, RefusesTheLargestCountWithoutAllocatingForIt) {
  const RandomMessage message = random_message(this->schema(), this->random_, true);
  for (const RandomMessage::Place& count : message.counts) {
    Bytes bytes = message.bytes;
    testing::write_number(bytes, count, 0x7fffffffULL >> (32 - 8 * count.size));
    testing::reset_allocation_peak();
    const auto result = decode<TypeParam>(bytes);
    EXPECT_FALSE(result.message) << "at " << count.offset;
    EXPECT_LE(testing::allocation_peak(), kMemoryPerByte * bytes.size());
  }
}

TYPED_TEST(SafeDecodeOf, RefusesNumbersThatAreNotFinite) {
  const RandomMessage message = random_message(this->schema(), this->random_, true);
  for (const RandomMessage::Place& number : message.doubles) {
    for (const double value :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
          -std::numeric_limits<double>::infinity()}) {
      Bytes bytes = message.bytes;
      testing::write_number(bytes, number, std::bit_cast<std::uint64_t>(value));
      EXPECT_EQ(decode<TypeParam>(bytes).reason, RejectReason::kNotFinite);
    }
  }
}

TYPED_TEST(SafeDecodeOf, SurvivesFlippedBitsWithinItsMemory) {
  for (int i = 0; i < 1000; ++i) {
    Bytes bytes = random_message(this->schema(), this->random_).bytes;
    const auto flips = 1 + this->random_() % 8;
    for (std::size_t k = 0; k < flips; ++k) {
      // The fingerprint stays: everything would be refused by it.
      if (bytes.size() == 8) break;
      const std::size_t at = 8 + this->random_() % (bytes.size() - 8);
      bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ (1U << (this->random_() % 8)));
    }
    testing::reset_allocation_peak();
    const auto result = decode<TypeParam>(bytes);
    ASSERT_LE(testing::allocation_peak(), kMemoryPerByte * bytes.size());
    ASSERT_EQ(result.message.has_value(), result.reason == RejectReason::kNone);
    // What is accepted is what the bytes say.
    if (result.message) {
      ASSERT_EQ(result.message->getEncodedSize(), static_cast<int>(bytes.size()));
    }
  }
}

TYPED_TEST(SafeDecodeOf, SurvivesNoise) {
  for (int i = 0; i < 300; ++i) {
    Bytes bytes(8 + this->random_() % 400);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(this->random_());
    testing::write_number(bytes, {0, 8}, static_cast<std::uint64_t>(TypeParam::getHash()));
    testing::reset_allocation_peak();
    const auto result = decode<TypeParam>(bytes);
    ASSERT_LE(testing::allocation_peak(), kMemoryPerByte * bytes.size());
    ASSERT_EQ(result.message.has_value(), result.reason == RejectReason::kNone);
  }
}

bot_core::rigid_transform_t turned_by(const std::array<double, 4>& quaternion) {
  bot_core::rigid_transform_t message{};
  std::copy(quaternion.begin(), quaternion.end(), message.quat);
  return message;
}

TEST(SafeDecode, RefusesAQuaternionThatIsNoRotation) {
  const auto reason = [](const std::array<double, 4>& quaternion) {
    return decode<bot_core::rigid_transform_t>(encode(turned_by(quaternion))).reason;
  };
  EXPECT_EQ(reason({0.0, 0.0, 0.0, 0.0}), RejectReason::kNotUnit);
  EXPECT_EQ(reason({1.0, 1.0, 0.0, 0.0}), RejectReason::kNotUnit);
  EXPECT_EQ(reason({1.0000001, 0.0, 0.0, 0.0}), RejectReason::kNone);  // a float's rounding
}

TEST(SafeDecode, RefusesAMatrixThatIsNoRotation) {
  transform_t message{};
  const auto reason = [&](std::initializer_list<double> rotation) {
    std::copy(rotation.begin(), rotation.end(), message.rotation);
    return decode<transform_t>(encode(message)).reason;
  };
  EXPECT_EQ(reason({1, 0, 0, 0, 1, 0, 0, 0, 1}), RejectReason::kNone);
  EXPECT_EQ(reason({0, 0, 0, 0, 0, 0, 0, 0, 0}), RejectReason::kNotUnit);
  EXPECT_EQ(reason({1, 0, 0, 0, 1, 0, 0, 0, -1}), RejectReason::kNotUnit);     // a mirror
  EXPECT_EQ(reason({1, 0, 0, 0, 1.001, 0, 0, 0, 1}), RejectReason::kNotUnit);  // a stretch
}

TEST(SafeDecode, RefusesANormalThatIsNotOfUnitLength) {
  plane_frame_t message{};
  message.x_axis[0] = 1.0;
  message.normal[2] = 1.0;
  EXPECT_EQ(decode<plane_frame_t>(encode(message)).reason, RejectReason::kNone);
  message.normal[2] = 0.99;
  EXPECT_EQ(decode<plane_frame_t>(encode(message)).reason, RejectReason::kNotUnit);
}

TEST(SafeDecode, RefusesAStringWithoutItsTerminatingZero) {
  counter_t message{};
  message.name = "frames";
  Bytes bytes = encode(message);
  bytes[8 + 4 + 6] = 'x';
  EXPECT_EQ(decode<counter_t>(bytes).reason, RejectReason::kBadString);
}

TEST(SafeDecode, RefusesMoreThanATypeMayNeed) {
  counter_t message{};
  message.name = std::string(2 << 20, 'x');
  EXPECT_EQ(decode<counter_t>(encode(message)).reason, RejectReason::kTooLarge);
}

/// The message of 28 bytes that brings down a process which uses LCM's typed subscribe.
TEST(SafeDecode, RefusesTheSmallMessageThatKillsATypedSubscriber) {
  Bytes bytes(28, 0);
  testing::write_number(bytes, {0, 8}, static_cast<std::uint64_t>(ring_t::getHash()));
  testing::write_number(bytes, {8, 4}, 0xffffffff);
  EXPECT_EQ(decode<ring_t>(bytes).reason, RejectReason::kBadCount);
}

TEST(SafeDecode, EveryReasonHasANameOfItsOwn) {
  std::set<std::string> names;
  const int last = static_cast<int>(RejectReason::kUndecodable);
  for (int i = 0; i <= last; ++i) names.insert(to_string(static_cast<RejectReason>(i)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(last + 1));
}

TEST(SafeDecode, ATypeThatIsNotOursIsACallersMistake) {
  EXPECT_THROW(check_message(nullptr, 0, 42), std::logic_error);
}

}  // namespace
}  // namespace geomap::messaging
