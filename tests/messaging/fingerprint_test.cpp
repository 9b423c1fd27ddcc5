// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "messaging/all_types.hpp"
#include "messaging/message_schema.hpp"

namespace geomap {
namespace {

/// What drivers and robots of the LCM world send; these never change.
TEST(Fingerprint, OfOtherPeoplesTypesIsWhatTheyPublish) {
  EXPECT_EQ(bot_core::image_t::getHash(), 0x14739ffe13d5f5f0);
  EXPECT_EQ(bot_core::images_t::getHash(), 0x20ba4f05e8f5e33a);
  EXPECT_EQ(bot_core::pose_t::getHash(), 0x2e16efb052b0105e);
  EXPECT_EQ(static_cast<std::uint64_t>(bot_core::rigid_transform_t::getHash()),
            0xea9ffbf2acc5c5aeULL);
  EXPECT_EQ(kinect::image_msg_t::getHash(), 0x03f81d11fd4126c6);
  EXPECT_EQ(kinect::depth_msg_t::getHash(), 0x400db1119c176bec);
  EXPECT_EQ(static_cast<std::uint64_t>(kinect::frame_msg_t::getHash()), 0xac3dd2c457d02257ULL);
}

/// Ours. Before version 1.0 a change is made here too, knowingly; afterwards a new layout is a new
/// type.
TEST(Fingerprint, OfOurTypesDoesNotChangeUnnoticed) {
  const std::map<std::string, std::uint64_t> pinned = {
      {"geomap.absorbed_feature_t", 0x453fe26f97ae2345},
      {"geomap.camera_attitude_t", 0x8d9b0fee30eeb9cc},
      {"geomap.camera_t", 0x0d804340371ff466},
      {"geomap.counter_t", 0x85bfc43c0b3c07d0},
      {"geomap.edit_t", 0xbec1138cc6903dfe},
      {"geomap.edit_target_t", 0xc768f8e08802322b},
      {"geomap.feature_state_t", 0xd5cb64e23861407b},
      {"geomap.health_t", 0x6ff1cdc12b24861d},
      {"geomap.idle_edit_t", 0xaeb0f28ce1689897},
      {"geomap.keyframe_t", 0x7b88caf176f052b9},
      {"geomap.keyframe_update_t", 0x092742edb7aeb360},
      {"geomap.map_contents_t", 0xf8f1bee5abc4a0c7},
      {"geomap.map_delta_t", 0x7fd7466f8e5ae41d},
      {"geomap.map_edit_record_t", 0x3be1556b06d3de52},
      {"geomap.map_edit_reply_t", 0xfe51f705b48b3146},
      {"geomap.map_edit_t", 0xc8784487102e06f7},
      {"geomap.map_event_t", 0xbe7158edd2f14342},
      {"geomap.map_feature_t", 0x9d73d7c217417255},
      {"geomap.map_request_t", 0x67ecdf2721076e27},
      {"geomap.map_state_t", 0xd4f6ccf373c3edb0},
      {"geomap.map_t", 0x6eeb8b09bb064a31},
      {"geomap.observation_id_t", 0x1f4fe432d8394ee8},
      {"geomap.plane_frame_t", 0xdc046660cb29ee34},
      {"geomap.plane_set_t", 0xe47d5564caf84c46},
      {"geomap.plane_t", 0xefb8ded98b86fe17},
      {"geomap.point_map_update_t", 0xf69a5fe50258842d},
      {"geomap.point_t", 0xdeb28047fc62f5be},
      {"geomap.polygon_part_t", 0x5d66bf486240e185},
      {"geomap.polygon_t", 0x65200b97a686815a},
      {"geomap.pose_correction_t", 0x281eaab93844fff7},
      {"geomap.rgbd_frame_t", 0x304322b77e9696be},
      {"geomap.ring_t", 0x43e0a65419d0e78c},
      {"geomap.stage_latency_t", 0xc86a05ae48f055b1},
      {"geomap.transform_t", 0xe9444fe183628b25},
      {"geomap.veto_state_t", 0x7e16da9a333bbcfb},
      {"geomap.veto_t", 0x651f9957b84c9b64},
  };
  for (const auto& [name, schema] : messaging::known_schemas().all()) {
    if (!name.starts_with("geomap.")) continue;
    const auto pin = pinned.find(name);
    ASSERT_NE(pin, pinned.end()) << name;
    EXPECT_EQ(static_cast<std::uint64_t>(schema.fingerprint), pin->second) << name;
  }
}

template <class Message>
class FingerprintOf : public ::testing::Test {};
TYPED_TEST_SUITE(FingerprintOf, testing::AllTypes);

TYPED_TEST(FingerprintOf, TheEmbeddedLayoutIsThatOfTheGeneratedType) {
  const messaging::MessageSchema* schema = messaging::known_schemas().find(TypeParam::getHash());
  ASSERT_NE(schema, nullptr);
  EXPECT_TRUE(schema->name.ends_with(std::string(".") + TypeParam::getTypeName()));
}

template <class... Types>
constexpr std::size_t count_types(::testing::Types<Types...> /*list*/) {
  return sizeof...(Types);
}

TEST(Fingerprint, EveryTypeIsTestedAndNoTwoAreAlike) {
  std::set<std::int64_t> fingerprints;
  for (const auto& [name, schema] : messaging::known_schemas().all()) {
    fingerprints.insert(schema.fingerprint);
  }
  EXPECT_EQ(messaging::known_schemas().all().size(), count_types(testing::AllTypes{}));
  EXPECT_EQ(fingerprints.size(), count_types(testing::AllTypes{}));
}

}  // namespace
}  // namespace geomap
