// SPDX-License-Identifier: BSD-3-Clause
#include "logs/message_fields.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geomap/map_delta_t.hpp"
#include "geomap/rgbd_frame_t.hpp"
#include "logs/message_head.hpp"
#include "messaging/encode.hpp"
#include "messaging/random_message.hpp"

namespace geomap::logs {

void PrintTo(const FieldText& field, std::ostream* out) {
  *out << field.path << ": " << field.value;
}

namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::IsEmpty;

auto is_field(const std::string& path, const std::string& value) {
  return AllOf(Field(&FieldText::path, path), Field(&FieldText::value, value));
}

/// A delta with three changed features of two bytes each.
std::vector<std::uint8_t> delta() {
  geomap::map_delta_t message{};
  message.utime = -7;
  message.n_changed = 3;
  message.changed.resize(3);
  for (int i = 0; i < 3; ++i) {
    auto& feature = message.changed[static_cast<std::size_t>(i)];
    feature.id.plane = i;
    feature.n_outline = 2;
    feature.outline = {1, 2};
    feature.normal_ppm[2] = 1'000'000 + i;
    feature.locked = i == 2;
    feature.label = "door \x1b " + std::to_string(i);
  }
  return messaging::encode(message);
}

TEST(MessageFields, AreNamedByTheirPaths) {
  const auto fields = message_fields(delta());
  EXPECT_THAT(fields, Contains(is_field("utime", "-7")));
  EXPECT_THAT(fields, Contains(is_field("changed[1].id.plane", "1")));
  EXPECT_THAT(fields, Contains(is_field("changed[1].normal_ppm", "0 0 1000001 (3)")));
  EXPECT_THAT(fields, Contains(is_field("changed[1].outline", "2 bytes")));
  EXPECT_THAT(fields, Contains(is_field("changed[1].locked", "false")));
  EXPECT_THAT(fields, Contains(is_field("changed[1].label", "\"door ? 1\"")));
  EXPECT_THAT(fields, Contains(is_field("changed", "(3)")));
  EXPECT_THAT(fields, Contains(is_field("removed", "(0)")));
  EXPECT_THAT(message_fields(delta(), "changed[2]"), Not(IsEmpty()));
}

TEST(MessageFields, AreLimitedToWhatIsWanted) {
  EXPECT_THAT(message_fields(delta(), "utime"), ElementsAre(is_field("utime", "-7")));
  EXPECT_THAT(
      message_fields(delta(), "changed[1].id"),
      ElementsAre(is_field("changed[1].id.keyframe", "0"), is_field("changed[1].id.plane", "1")));
  // Cut off where all are shown.
  EXPECT_THAT(message_fields(delta(), "changed[2].locked"),
              ElementsAre(is_field("changed[2].locked", "true")));
  EXPECT_THAT(message_fields(delta(), "changed[2].normal_ppm[2]"),
              ElementsAre(is_field("changed[2].normal_ppm[2]", "1000002")));
  for (const char* nothing : {"change", "changed[3]", "changed[2].normal_ppm[3]", "utime.x", "."}) {
    EXPECT_THAT(message_fields(delta(), nothing), IsEmpty()) << nothing;
  }
}

TEST(MessageFields, LongArraysAreCutShort) {
  geomap::map_delta_t message{};
  message.n_removed = 100;
  message.removed.resize(100);
  message.removed[99].plane = 42;
  const auto bytes = messaging::encode(message);
  EXPECT_THAT(message_fields(bytes, "removed"),
              ElementsAre(is_field("removed[0].keyframe", "0"), is_field("removed[0].plane", "0"),
                          is_field("removed[1].keyframe", "0"), is_field("removed[1].plane", "0"),
                          is_field("removed", "(100)")));
  EXPECT_THAT(message_fields(bytes, "removed[99].plane"),
              ElementsAre(is_field("removed[99].plane", "42")));
}

TEST(MessageFields, OfEveryTypeCanBeAskedForOneByOne) {
  std::mt19937 random(1);
  for (const auto& [name, schema] : messaging::known_schemas().all()) {
    const auto bytes = testing::random_message(schema, random, true).bytes;
    const auto all = message_fields(bytes);
    EXPECT_THAT(all, Not(IsEmpty())) << name;
    for (const FieldText& field : all) {
      EXPECT_THAT(message_fields(bytes, field.path), Contains(is_field(field.path, field.value)));
    }
  }
}

TEST(MessageFields, DamagedMessagesHaveNone) {
  std::mt19937 random(2);
  for (const auto& [name, schema] : messaging::known_schemas().all()) {
    const testing::RandomMessage message = testing::random_message(schema, random, true);
    for (std::size_t size = 0; size < message.bytes.size(); ++size) {
      EXPECT_THAT(message_fields(std::span(message.bytes).first(size)), IsEmpty());
    }
    for (int round = 0; round < 200; ++round) {  // either refused or read within its bounds
      auto bytes = message.bytes;
      bytes[8 + random() % (bytes.size() - 8)] = static_cast<std::uint8_t>(random());
      EXPECT_EQ(message_fields(bytes).empty(), sound_type_of(bytes) == nullptr);
    }
  }
}

}  // namespace
}  // namespace geomap::logs
