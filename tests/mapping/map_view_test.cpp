// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map_view.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "geometry/polygon_clip.hpp"
#include "mapping/map_view_messages.hpp"
#include "mapping/outline_code.hpp"
#include "mapping/scene.hpp"
#include "messaging/encode.hpp"

namespace geomap::mapping {
namespace {

using geometry::Polygon;

/// A level rectangle of 1 x 2 m at a height.
MapFeature table(double height, double width = 1.0) {
  MapFeature feature;
  feature.id = {1000, 0};
  feature.surface.plane = {Eigen::Vector3d::UnitZ(), -height};
  feature.surface.frame = {Eigen::Vector3d(3, 4, height), Eigen::Vector3d::UnitX(),
                           Eigen::Vector3d::UnitZ()};
  feature.surface.polygon = {{{geometry::rectangle({0, 0}, {width, 2}), {}}}};
  feature.observations = {feature.id};
  return feature;
}

FeatureSet set_of(const MapFeature& feature) {
  return {{feature.id, std::make_shared<const MapFeature>(feature)}};
}

/// A ring like a star, of so many vertices.
Polygon star(int vertices, double radius = 3.0) {
  geometry::Ring ring;
  for (int i = 0; i < vertices; ++i) {
    const double angle = 2.0 * M_PI * i / vertices;
    const double r = i % 2 == 0 ? radius : 0.8 * radius;
    ring.push_back(geometry::to_grid({r * std::cos(angle), r * std::sin(angle)}));
  }
  return geometry::canonical({{{ring, {}}}});
}

TEST(ViewFeature, IsWhereTheFeatureIs) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 200; ++i) {
    MapFeature feature = table(0.7);
    const Eigen::Quaterniond turn(normal(random), normal(random), normal(random), normal(random));
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() = turn.normalized().toRotationMatrix();
    T.translation() = 20.0 * Eigen::Vector3d(normal(random), normal(random), normal(random));
    feature.surface = feature.surface.transformed(T);
    // As far as the map lets a plane turn against its frame.
    const Eigen::Vector3d tilted =
        Eigen::AngleAxisd(0.0087, feature.surface.frame.x_axis) * feature.surface.plane.normal;
    feature.surface.plane =
        geometry::Plane::through(feature.surface.frame.origin, tilted.normalized());
    const geometry::PlanarPolygon seen = surface_of(quantised(feature));
    for (const geometry::GridPoint vertex : feature.surface.polygon.parts[0].outer) {
      EXPECT_LT((seen.lift(vertex) - feature.surface.lift(vertex)).norm(), 3e-4);
    }
    EXPECT_TRUE(is_sound(quantised(feature)));
  }
}

TEST(ViewFeature, LooksDifferentBeyondAMillimetreOrHalfAPercent) {
  const ViewTolerance tolerance;
  const ViewFeature sent = quantised(table(0.7));
  const auto differs = [&](const MapFeature& now) {
    return looks_different(sent, quantised(now), tolerance);
  };
  EXPECT_FALSE(differs(table(0.7)));
  EXPECT_FALSE(differs(table(0.7008)));
  EXPECT_TRUE(differs(table(0.7012)));
  EXPECT_FALSE(differs(table(0.7, 1.0008)));
  EXPECT_TRUE(differs(table(0.7, 1.0012)));

  MapFeature moved = table(0.7);
  moved.surface.frame.origin.x() += 0.002;
  EXPECT_TRUE(differs(moved));
  MapFeature with_hole = table(0.7);
  with_hole.surface.polygon = geometry::subtract(
      with_hole.surface.polygon, {{{geometry::rectangle({0.4, 0.4}, {0.43, 0.43}), {}}}});
  EXPECT_TRUE(differs(with_hole));
  MapFeature labelled = table(0.7);
  labelled.label = "table";
  EXPECT_TRUE(differs(labelled));
  MapFeature seen_again = table(0.7);
  seen_again.observations.push_back({2000, 1});
  seen_again.rms = 0.004;
  EXPECT_FALSE(differs(seen_again));
}

TEST(MapView, SmallChangesDoNotAddUp) {
  MapView view;
  for (int i = 0; i < 100; ++i) {
    const MapFeature feature = table(0.7 + 0.0004 * i);
    const ViewDelta delta = delta_after(view, set_of(feature), {{feature.id}, {}, {}}, {});
    apply(delta, view);
    const geometry::PlanarPolygon seen = surface_of(view.features.at(feature.id));
    EXPECT_NEAR(seen.plane.d, feature.surface.plane.d, 0.00105);
  }
}

TEST(MapView, ADeltaThatDoesNotFollowIsAMistake) {
  MapView view;
  ViewDelta delta = delta_after(view, set_of(table(1)), {{{1000, 0}}, {}, {}}, {});
  delta.revision = 2;
  EXPECT_THROW(apply(delta, view), std::invalid_argument);
}

TEST(OutlineCode, GivesBackEveryPolygon) {
  const Polygon square = {{{geometry::rectangle({-500, -500}, {500, 500}), {}}}};
  const Polygon with_hole =
      geometry::subtract(square, {{{geometry::rectangle({-1, -1}, {1, 1}), {}}}});
  const Polygon parts = geometry::unite(star(40), {{{geometry::rectangle({9, 9}, {10, 10}), {}}}});
  for (const Polygon& polygon : {square, with_hole, parts, star(5000, 900.0)}) {
    EXPECT_EQ(decode_outline(encode_outline(polygon)), polygon);
  }
}

TEST(OutlineCode, TakesFewBytesAVertex) { EXPECT_LT(encode_outline(star(100)).size(), 420U); }

TEST(OutlineCode, OfAnOutlineThatGrewOnlyTheNewPartIsSent) {
  const Polygon before = star(200);
  const Polygon hole = {{{geometry::rectangle({0.5, 0.5}, {0.6, 0.6}), {}}}};
  const Polygon more = {{{geometry::rectangle({2.5, -0.2}, {3.4, 0.2}), {}}}};
  for (const Polygon& now : {before, geometry::subtract(before, hole),
                             geometry::unite(before, more), geometry::subtract(before, more)}) {
    const std::vector<std::uint8_t> bytes = encode_outline(now, before);
    EXPECT_LT(bytes.size(), 60U);
    EXPECT_EQ(decode_outline(bytes, before), now);
    EXPECT_FALSE(decode_outline(bytes));
    EXPECT_NE(decode_outline(bytes, star(198)), now);
  }
}

TEST(OutlineCode, RefusesWhatIsNoPolygon) {
  const std::vector<std::uint8_t> sound = encode_outline(star(30));
  ASSERT_TRUE(decode_outline(sound));
  for (std::size_t size = 0; size < sound.size(); ++size) {
    EXPECT_FALSE(decode_outline({sound.data(), size})) << size;
  }
  std::vector<std::uint8_t> longer = sound;
  longer.push_back(0);
  EXPECT_FALSE(decode_outline(longer));
  EXPECT_FALSE(decode_outline(std::vector<std::uint8_t>(100, 0xff)));
  EXPECT_FALSE(decode_outline(std::vector<std::uint8_t>{0}));                             // no part
  EXPECT_FALSE(decode_outline(std::vector<std::uint8_t>{1, 1, 3, 6, 0, 0, 0, 0, 0, 0}));  // no area
  EXPECT_FALSE(decode_outline(encode_outline(star(30, 2000.0))));  // farther than 1 km
}

TEST(OutlineCode, SurvivesRandomBytes) {
  std::mt19937 random(1);
  for (int i = 0; i < 100'000; ++i) {
    const Polygon before = star(i % 2 == 0 ? 6 : 4);
    std::vector<std::uint8_t> bytes = encode_outline(star(6), before);
    for (int flips = 0; flips < 3; ++flips) {
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    }
    const auto polygon = decode_outline(bytes, before);
    EXPECT_TRUE(!polygon || geometry::find_fault(*polygon).empty());
  }
}

MapView view_with(const std::vector<Polygon>& polygons) {
  MapView view{50, 7, 9, {}};
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    MapFeature feature = table(0.1 * static_cast<double>(i));
    feature.id = {1000, static_cast<std::int32_t>(i)};
    feature.observations = {feature.id};
    feature.surface.polygon = polygons[i];
    view.features.emplace(feature.id, quantised(feature));
  }
  return view;
}

ViewDelta delta_with(const MapView& view) {
  ViewDelta delta;
  delta.epoch = 7;
  delta.revision = 10;
  delta.cause = ViewCause::kPoseCorrection;
  for (const auto& [id, feature] : view.features) delta.changed.push_back(feature);
  for (std::int32_t i = 0; i < 300; ++i) {
    delta.removed.insert({2000, i});
    delta.absorbed.emplace(FeatureId{3000, i}, FeatureId{1000, 0});
  }
  return delta;
}

TEST(MapViewMessages, GoIntoPacketsAndComeBackTheSame) {
  for (const int vertices : {4, 100, 300, 3000}) {
    const MapView view = view_with({star(vertices), star(8), star(vertices), star(300)});
    const auto snapshot = to_messages(view);
    for (const geomap::map_t& part : snapshot) {
      EXPECT_LE(messaging::encode(part).size(), kMostViewMessageBytes);
    }
    const auto received = from_messages(snapshot);
    ASSERT_TRUE(received);
    EXPECT_EQ(received->features, view.features);
    EXPECT_EQ(view_hash(*received), view_hash(view));

    const ViewDelta delta = delta_with(view);
    const auto messages = to_messages(delta, {});
    for (const geomap::map_delta_t& part : messages) {
      EXPECT_LE(messaging::encode(part).size(), kMostViewMessageBytes);
    }
    EXPECT_EQ(from_messages(messages, {}), delta);
  }
}

TEST(MapViewMessages, PacketsAreFilled) {
  const auto parts = to_messages(view_with({star(3000)}));
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    EXPECT_GT(messaging::encode(parts[i]).size(), kMostViewMessageBytes - 2);
  }
}

TEST(MapViewMessages, AnEmptyViewIsOneMessage) {
  EXPECT_EQ(to_messages(MapView{}).size(), 1U);
  EXPECT_TRUE(from_messages(to_messages(MapView{})));
  EXPECT_EQ(to_messages(ViewDelta{}, {}).size(), 1U);
}

TEST(MapViewMessages, WhatDoesNotBelongTogetherOrIsNotSoundIsRefused) {
  const std::vector<geomap::map_t> sound = to_messages(view_with({star(300), star(300)}));
  ASSERT_GT(sound.size(), 1U);
  const auto refused = [&](const std::function<void(std::vector<geomap::map_t>&)>& spoil) {
    std::vector<geomap::map_t> parts = sound;
    spoil(parts);
    return !from_messages(parts);
  };
  EXPECT_FALSE(refused([](auto&) {}));
  EXPECT_TRUE(refused([](auto& parts) { parts.pop_back(); }));
  EXPECT_TRUE(refused([](auto& parts) { parts.clear(); }));
  EXPECT_TRUE(refused([](auto& parts) { std::swap(parts[0], parts[1]); }));
  EXPECT_TRUE(refused([](auto& parts) { ++parts[1].epoch; }));
  EXPECT_TRUE(refused([](auto& parts) { ++parts[1].revision; }));
  EXPECT_TRUE(refused([](auto& parts) { parts[0].view_hash[0] ^= 1; }));
  EXPECT_TRUE(refused([](auto& parts) { parts[0].features[0].normal_ppm[1] = 2'000'000; }));
  EXPECT_TRUE(refused([](auto& parts) { parts[0].features[0].x_axis[2] = 30'000; }));
  EXPECT_TRUE(refused([](auto& parts) { parts[0].features[0].observations = 0; }));
  EXPECT_TRUE(refused([](auto& parts) { parts[0].features[0].outline[5] ^= 0x80; }));
  EXPECT_TRUE(refused([](auto& parts) { parts[1].features.back().id.keyframe = 0; }));
}

}  // namespace
}  // namespace geomap::mapping
