// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/safe_decode.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

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

/// One type, without the type: what is done with it is compiled once, not for each of them.
struct AnyType {
  /// A decoded message is `size` bytes long, encoded.
  struct Checked {
    RejectReason reason;
    std::optional<int> size;
  };
  std::int64_t fingerprint;
  Checked (*check)(const void* data, std::size_t size);
  Bytes (*encode_again)(const Bytes& bytes);  // what the decoded message is, encoded
};

template <class... Messages>
std::vector<AnyType> any_types(::testing::Types<Messages...>) {
  return {AnyType{
      Messages::getHash(),
      [](const void* data, std::size_t size) {
        const auto result = safe_decode<Messages>(data, size);
        AnyType::Checked checked{result.reason, std::nullopt};
        if (result.message) checked.size = result.message->getEncodedSize();
        return checked;
      },
      [](const Bytes& bytes) { return encode(decode<Messages>(bytes).message.value()); }}...};
}

const MessageSchema& schema_of(const AnyType& type) {
  return *known_schemas().find(type.fingerprint);
}

class SafeDecodeOf : public ::testing::TestWithParam<AnyType> {
 protected:
  /// Layouts and limits are read at first use; the tests measure what a message costs after that.
  void SetUp() override {
    std::mt19937 random(1);
    check(random_message(schema(), random).bytes);
  }
  static const MessageSchema& schema() { return schema_of(GetParam()); }
  static AnyType::Checked check(const Bytes& bytes) {
    return GetParam().check(bytes.data(), bytes.size());
  }
  std::mt19937 random_{20121};
};

/// "geomap.plane_t" as GoogleTest wants it.
std::string name_of(const ::testing::TestParamInfo<AnyType>& type) {
  std::string name = schema_of(type.param).name;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(All, SafeDecodeOf, ::testing::ValuesIn(any_types(testing::AllTypes{})),
                         name_of);

TEST_P(SafeDecodeOf, GivesBackSoundMessagesToTheLastByte) {
  for (int i = 0; i < 50; ++i) {
    const RandomMessage message = random_message(schema(), random_);
    const auto result = check(message.bytes);
    ASSERT_TRUE(result.size) << to_string(result.reason);
    EXPECT_EQ(GetParam().encode_again(message.bytes), message.bytes);
  }
}

TEST_P(SafeDecodeOf, RefusesAMessageCutAtAnyByte) {
  const RandomMessage message = random_message(schema(), random_, true);
  for (std::size_t size = 0; size < message.bytes.size(); ++size) {
    const auto result = GetParam().check(message.bytes.data(), size);
    ASSERT_FALSE(result.size) << "cut at " << size;
    ASSERT_EQ(result.reason, size < 8 ? RejectReason::kTooShort : RejectReason::kTruncated);
  }
}

TEST_P(SafeDecodeOf, RefusesBytesBehindTheLastField) {
  RandomMessage message = random_message(schema(), random_, true);
  message.bytes.push_back(0);
  EXPECT_EQ(check(message.bytes).reason, RejectReason::kTrailing);
}

TEST_P(SafeDecodeOf, RefusesAnotherTypesFingerprint) {
  RandomMessage message = random_message(schema(), random_, true);
  message.bytes[7] = static_cast<std::uint8_t>(message.bytes[7] ^ 1);
  EXPECT_EQ(check(message.bytes).reason, RejectReason::kWrongType);
}

TEST_P(SafeDecodeOf, RefusesNegativeCounts) {
  const RandomMessage message = random_message(schema(), random_, true);
  for (const RandomMessage::Place& count : message.counts) {
    Bytes bytes = message.bytes;
    testing::write_number(bytes, count, ~std::uint64_t{0});
    EXPECT_EQ(check(bytes).reason, RejectReason::kBadCount) << "at " << count.offset;
  }
}

TEST_P(SafeDecodeOf, RefusesTheLargestCountWithoutAllocatingForIt) {
  const RandomMessage message = random_message(schema(), random_, true);
  for (const RandomMessage::Place& count : message.counts) {
    Bytes bytes = message.bytes;
    testing::write_number(bytes, count, 0x7fffffffULL >> (32 - 8 * count.size));
    testing::reset_allocation_peak();
    const auto result = check(bytes);
    EXPECT_FALSE(result.size) << "at " << count.offset;
    EXPECT_LE(testing::allocation_peak(), kMemoryPerByte * bytes.size());
  }
}

TEST_P(SafeDecodeOf, RefusesNumbersThatAreNotFinite) {
  const RandomMessage message = random_message(schema(), random_, true);
  for (const RandomMessage::Place& number : message.doubles) {
    for (const double value :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
          -std::numeric_limits<double>::infinity()}) {
      Bytes bytes = message.bytes;
      testing::write_number(bytes, number, std::bit_cast<std::uint64_t>(value));
      EXPECT_EQ(check(bytes).reason, RejectReason::kNotFinite);
    }
  }
}

TEST_P(SafeDecodeOf, SurvivesFlippedBitsWithinItsMemory) {
  for (int i = 0; i < 1000; ++i) {
    Bytes bytes = random_message(schema(), random_).bytes;
    const auto flips = 1 + random_() % 8;
    for (std::size_t k = 0; k < flips; ++k) {
      // The fingerprint stays: everything would be refused by it.
      if (bytes.size() == 8) break;
      const std::size_t at = 8 + random_() % (bytes.size() - 8);
      bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ (1U << (random_() % 8)));
    }
    testing::reset_allocation_peak();
    const auto result = check(bytes);
    ASSERT_LE(testing::allocation_peak(), kMemoryPerByte * bytes.size());
    ASSERT_EQ(result.size.has_value(), result.reason == RejectReason::kNone);
    // What is accepted is what the bytes say.
    if (result.size) {
      ASSERT_EQ(*result.size, static_cast<int>(bytes.size()));
    }
  }
}

TEST_P(SafeDecodeOf, SurvivesNoise) {
  for (int i = 0; i < 300; ++i) {
    Bytes bytes(8 + random_() % 400);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random_());
    testing::write_number(bytes, {0, 8}, static_cast<std::uint64_t>(GetParam().fingerprint));
    testing::reset_allocation_peak();
    const auto result = check(bytes);
    ASSERT_LE(testing::allocation_peak(), kMemoryPerByte * bytes.size());
    ASSERT_EQ(result.size.has_value(), result.reason == RejectReason::kNone);
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
