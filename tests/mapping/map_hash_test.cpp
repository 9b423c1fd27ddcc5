// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map_hash.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "mapping/fuse.hpp"
#include "mapping/scene.hpp"

namespace geomap::mapping {
namespace {

MapFeature table() {
  testing::Observer observer;
  const auto room = testing::small_room();
  const auto view = observer.observe(7, {room[3]}, testing::look_at({0, -1, 1.6}, {0.3, 1, 0.75}));
  return *feature_of(*view, 0, MergeConfig{});
}

std::string hash_of(const MapFeature& feature) {
  return map_hash({{feature.id, std::make_shared<const MapFeature>(feature)}});
}

TEST(MapHash, OfAnEmptyMapIsThatOfNoBytes) {
  EXPECT_EQ(map_hash({}), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(MapHash, ChangesWithEveryPartOfTheState) {
  const std::vector<std::function<void(MapFeature&)>> changes = {
      [](MapFeature&) {},
      [](MapFeature& f) { f.id.plane += 1; },
      [](MapFeature& f) { f.surface.plane.normal.x() += 1e-15; },
      [](MapFeature& f) { f.surface.plane.d += 1e-12; },
      [](MapFeature& f) { f.surface.frame.origin.y() += 1e-12; },
      [](MapFeature& f) { f.surface.frame.x_axis.z() += 1e-15; },
      [](MapFeature& f) { f.surface.frame.normal.z() -= 1e-15; },
      [](MapFeature& f) { f.moments.weight += 1e-6; },
      [](MapFeature& f) { f.moments.noise(2, 2) += 1e-6; },
      [](MapFeature& f) { f.surface.polygon.parts[0].outer[0].x += 1; },
      [](MapFeature& f) {
        f.surface.polygon.parts[0].holes.push_back({{0, 0}, {0, 9}, {9, 0}});
      },
      [](MapFeature& f) {
        f.observations.push_back({8, 0});
      },
      [](MapFeature& f) { f.inliers += 1; },
      [](MapFeature& f) { f.color[2] += 1e-9; },
      [](MapFeature& f) { f.label = "table"; },
  };
  std::set<std::string> hashes;
  for (const auto& change : changes) {
    MapFeature feature = table();
    change(feature);
    EXPECT_TRUE(hashes.insert(hash_of(feature)).second) << "change " << hashes.size();
  }
}

TEST(MapHash, DoesNotTellZeroFromMinusZero) {
  MapFeature plus = table(), minus = table();
  plus.color[0] = 0.0;
  minus.color[0] = -0.0;
  EXPECT_EQ(hash_of(plus), hash_of(minus));
}

}  // namespace
}  // namespace geomap::mapping
