// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/edit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "mapping/geometric_map.hpp"
#include "mapping/map_hash.hpp"
#include "mapping/scene.hpp"

namespace geomap::mapping {
namespace {

using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;
using ::testing::HasSubstr;
using testing::Observer;
using testing::Rectangle;

using testing::kX, testing::kY, testing::kZ;

Rectangle table(double x = 0.0, double half_u = 0.5) {
  return {"table", {x, 0, 0.75}, kX, kY, half_u, 0.4, {160, 60, 40}, {}};
}
Rectangle wall() { return {"wall", {0, 1, 1}, kX, kZ, 2.0, 1.0, {200, 200, 200}, {}}; }

Isometry3d camera_at(std::int64_t keyframe) {
  const double x = 0.02 * static_cast<double>(keyframe % 20);
  return testing::look_at({x, -1.5, 1.8}, {0, 0, 0.75});
}

using testing::hash_of;

/// A map of noisy views, with what an operator does to it.
class EditTest : public ::testing::Test {
 protected:
  EditTest() {
    observer_.angle_noise = 0.005;
    observer_.offset_noise = 0.004;
    observer_.outline_noise = 0.02;
  }

  void see(const std::vector<Rectangle>& scene, int views = 1) {
    for (int i = 0; i < views; ++i) {
      ++keyframe_;
      map_.apply(observer_.observe(keyframe_, scene, camera_at(keyframe_)));
    }
  }

  EditResult edit(EditCommand command) {
    command.author = "ann";
    command.command = ++command_;
    return map_.edit(command);
  }
  EditResult edit(EditKind kind, std::vector<FeatureId> targets) {
    return edit({.kind = kind, .targets = std::move(targets)});
  }
  EditResult undo(std::vector<std::int64_t> edits = {}) {
    return edit({.kind = EditKind::kUndo, .edits = std::move(edits)});
  }

  /// The features that look up at a height, as a table does.
  std::vector<FeatureId> tables() const {
    std::vector<FeatureId> ids;
    for (const auto& [id, feature] : map_.features()) {
      if (feature->surface.plane.normal.z() > 0.9) ids.push_back(id);
    }
    return ids;
  }
  const MapFeature& feature(const FeatureId& id) const { return *map_.features().at(id); }
  double area(const FeatureId& id) const { return geometry::area(feature(id).surface.polygon); }

  Observer observer_{3};
  GeometricMap map_{MergeConfig{}, HistoryConfig{}};
  std::int64_t keyframe_ = 0;
  std::int64_t command_ = 0;
};

TEST_F(EditTest, ADeletedSurfaceStaysOutAndWhatIsBesideBeforeAndBehindItIsMapped) {
  see({table(), wall()}, 5);
  const std::vector<FeatureId> before = tables();
  ASSERT_EQ(before.size(), 1U);
  ASSERT_TRUE(edit(EditKind::kDelete, before).edit);
  see({table(), wall()}, 50);
  EXPECT_TRUE(tables().empty());
  EXPECT_EQ(map_.vetoes().size(), 1U);
  EXPECT_EQ(map_.vetoes().begin()->second->cause, VetoCause::kDeleted);

  Rectangle book = table(0.1, 0.2), board = table(-0.1, 0.3);
  book.center.z() += 0.15;
  board.center.z() -= 0.2;
  see({table(), book, board, table(1.5, 0.3)});
  EXPECT_EQ(tables().size(), 3U);
}

TEST_F(EditTest, OfALargerSurfaceOnlyWhatReachesBeyondTheDeletedOneIsMapped) {
  see({table()}, 3);
  edit(EditKind::kDelete, tables());
  Rectangle longer = table(0.5, 1.0);
  see({longer}, 10);
  ASSERT_EQ(tables().size(), 1U);
  EXPECT_NEAR(area(tables()[0]), (1.0 - 0.03) * 0.8, 0.08);  // noise has it grow
}

TEST_F(EditTest, ARestoredSurfaceHasAllItsObservations) {
  see({table(), wall()}, 5);
  GeometricMap never = map_;
  const EditResult deleted = edit(EditKind::kDelete, tables());
  Observer copy = observer_;
  for (int i = 0; i < 30; ++i) see({table(), wall()});
  for (std::int64_t k = 6; k <= 35; ++k) {
    never.apply(copy.observe(k, {table(), wall()}, camera_at(k)));
  }
  ASSERT_TRUE(edit({.kind = EditKind::kRestore, .edits = {deleted.edit->number}}).edit);
  EXPECT_EQ(hash_of(map_), hash_of(never));
  EXPECT_EQ(feature(tables().at(0)).observations.size(), 35U);
  undo();  // of the restoration
  EXPECT_TRUE(tables().empty());
}

TEST_F(EditTest, AMovedTableStaysWhereItWasPutToTheLastBitUntilItIsUnlocked) {
  see({table(), wall()}, 5);
  GeometricMap never = map_;
  Observer copy = observer_;
  const FeatureId id = tables().at(0);
  const Vector3d before = feature(id).surface.frame.origin;
  ASSERT_TRUE(edit({.kind = EditKind::kMove,
                    .targets = {id},
                    .T_world_moved = Isometry3d(Translation3d(0.3, 0.1, 0.05))})
                  .edit);
  EXPECT_LT((feature(id).surface.frame.origin - before - Vector3d(0.3, 0.1, 0.05)).norm(), 1e-9);
  const std::string put = map_hash({{id, map_.features().at(id)}});
  for (int i = 0; i < 60; ++i) see({table(), wall()});
  EXPECT_EQ(map_hash({{id, map_.features().at(id)}}), put);
  EXPECT_EQ(tables().size(), 1U);  // not drawn a second time where it is observed

  ASSERT_TRUE(edit(EditKind::kUnlock, {id}).edit);
  for (std::int64_t k = 6; k <= 65; ++k) {
    never.apply(copy.observe(k, {table(), wall()}, camera_at(k)));
  }
  EXPECT_EQ(hash_of(map_), hash_of(never));
}

TEST_F(EditTest, WhatIsSeenWhereATableWasPutDoesNotDrawItASecondTime) {
  see({table(), wall()}, 3);
  const FeatureId id = tables().at(0);
  const Isometry3d to_the_right(Translation3d(1.5, 0, 0));
  edit({.kind = EditKind::kMove, .targets = {id}, .T_world_moved = to_the_right});
  see({table(), table(1.5), wall()}, 10);
  EXPECT_EQ(tables(), std::vector<FeatureId>{id});
  edit({.kind = EditKind::kMove, .targets = {id}, .T_world_moved = to_the_right});
  see({table(), table(1.5), wall()}, 10);
  EXPECT_EQ(tables().size(), 2U);  // the place that it has left is open again
}

TEST_F(EditTest, FeaturesThatWereHeldTogetherAreLetGoTogether) {
  see({table(-1.2), table(1.2)}, 2);
  const std::vector<FeatureId> both = tables();
  edit(EditKind::kLock, {both[0], both[1], both[0]});
  EXPECT_EQ(map_.history().edits().entries().at(1).edit->targets.size(), 2U);
  EXPECT_THAT(edit(EditKind::kUnlock, {both[0]}).refusal,
              HasSubstr("edit 1 holds " + to_string(both[1]) + " too"));
  ASSERT_TRUE(edit(EditKind::kUnlock, both).edit);
  EXPECT_FALSE(feature(both[0]).is_held() || feature(both[1]).is_held());
}

TEST_F(EditTest, WhatNoMapCanHoldIsRefusedAlsoWhenItComesAboutByAnUndo) {
  see({wall()}, 1);
  const auto square_at = [&](double x) {
    const EditResult added = edit(
        {.kind = EditKind::kAdd, .points = {{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}}});
    return added.edit ? made_by(*added.edit, 0) : FeatureId{};
  };
  const FeatureId near = square_at(0), far = square_at(1500), farther = square_at(300'000);
  EXPECT_THAT(edit(EditKind::kMerge, {near, far}).refusal, HasSubstr("farther than a map"));
  EXPECT_THAT(edit(EditKind::kMerge, {near, farther}).refusal, HasSubstr("cannot be done"));
  edit({.kind = EditKind::kMove,
        .targets = {farther},
        .T_world_moved = Isometry3d(Translation3d(-299'998, 0, 0))});
  const EditResult merged = edit(EditKind::kMerge, {near, farther});
  ASSERT_TRUE(merged.edit) << merged.refusal;
  see({wall()}, 20);
  const std::size_t keyframes = feature({1, 0}).observations.size();
  ASSERT_TRUE(undo({merged.edit->number - 1}).edit);  // of the move
  EXPECT_EQ(map_.idle_edits().count(merged.edit->number), 1U);
  EXPECT_EQ(feature({1, 0}).observations.size(), keyframes);
  edit({.kind = EditKind::kRedo});
  EXPECT_TRUE(map_.idle_edits().empty());
}

TEST_F(EditTest, ALockedFeatureNeitherGrowsNorMerges) {
  see({table()}, 3);
  const FeatureId id = tables().at(0);
  ASSERT_TRUE(edit(EditKind::kLock, {id}).edit);
  const std::string locked = map_hash({{id, map_.features().at(id)}});
  see({table(0.5, 1.0)}, 5);
  EXPECT_EQ(map_hash({{id, map_.features().at(id)}}), locked);
  EXPECT_EQ(tables().size(), 2U);  // what is beside it is a feature of its own
  EXPECT_THAT(edit(EditKind::kLock, {id}).refusal, HasSubstr("held already"));
  ASSERT_TRUE(edit(EditKind::kMerge, tables()).edit);
  ASSERT_EQ(tables().size(), 1U);
  EXPECT_TRUE(feature(id).is_held());  // as its older part was
  EXPECT_NEAR(area(id), 2.0 * 0.8, 0.1);
  see({table(0.5, 1.0)}, 5);
  EXPECT_EQ(tables().size(), 1U);
  edit(EditKind::kUnlock, {id});
  EXPECT_EQ(tables().size(), 1U);
  EXPECT_FALSE(feature(id).is_held());
}

TEST_F(EditTest, TwoPiecesBecomeOneAndOneBecomesTwo) {
  see({table(-1.2), table(1.2)}, 3);
  const std::vector<FeatureId> pieces = tables();
  ASSERT_EQ(pieces.size(), 2U);
  ASSERT_TRUE(edit(EditKind::kMerge, pieces).edit);
  ASSERT_EQ(tables(), std::vector<FeatureId>{pieces[0]});
  EXPECT_NEAR(area(pieces[0]), 1.6, 0.1);
  see({table(-1.2), table(1.2)}, 3);
  EXPECT_EQ(tables().size(), 1U);

  const double whole = area(pieces[0]);
  ASSERT_TRUE(edit({.kind = EditKind::kSplit,
                    .targets = {pieces[0]},
                    .points = {{-1.2, -3, 1}, {-1.2, 4, 1}}})
                  .edit);
  ASSERT_EQ(tables().size(), 2U);
  EXPECT_NEAR(area(tables()[0]) + area(tables()[1]), whole, 1e-3);
  EXPECT_NEAR(std::min(area(tables()[0]), area(tables()[1])), 0.4, 0.08);
  see({table(-1.2), table(1.2)}, 5);
  EXPECT_EQ(tables().size(), 2U);
  EXPECT_THAT(
      edit({.kind = EditKind::kSplit, .targets = {pieces[0]}, .points = {{5, -3, 1}, {5, 4, 1}}})
          .refusal,
      HasSubstr("does not cross"));
}

TEST_F(EditTest, ACutHoleStaysAHole) {
  see({table()}, 3);
  const FeatureId id = tables().at(0);
  const std::vector<Vector3d> square = {
      {-0.2, -0.2, 0.8}, {0.2, -0.2, 0.8}, {0.2, 0.2, 0.8}, {-0.2, 0.2, 0.8}};
  ASSERT_TRUE(edit({.kind = EditKind::kCut, .targets = {id}, .points = square}).edit);
  see({table()}, 30);
  ASSERT_EQ(tables().size(), 1U);
  const auto& holes = feature(id).surface.polygon.parts.at(0).holes;
  ASSERT_EQ(holes.size(), 1U);
  EXPECT_NEAR(-geometry::signed_area(holes[0]), 0.16, 1e-3);
  EXPECT_GT(feature(id).observations.size(), 30U);
}

TEST_F(EditTest, AnAddedPolygonIsThereAndHeld) {
  see({wall()}, 2);
  const std::vector<Vector3d> door = {{2.1, 1, 0}, {2.1, 1, 2}, {3.0, 1, 2}, {3.0, 1, 0}};
  const EditResult added = edit({.kind = EditKind::kAdd, .points = door, .label = "door"});
  ASSERT_TRUE(added.edit) << added.refusal;
  ASSERT_EQ(added.change.upserted.size(), 1U);
  const FeatureId id = *added.change.upserted.begin();
  EXPECT_NEAR(area(id), 1.8, 1e-6);
  EXPECT_LT((feature(id).surface.plane.normal - kY).norm(), 1e-9);
  EXPECT_EQ(feature(id).label, "door");
  EXPECT_THAT(edit(EditKind::kUnlock, {id}).refusal, HasSubstr("added by hand"));
  EXPECT_THAT(edit({.kind = EditKind::kAdd, .points = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}})
                  .refusal,
              HasSubstr("no plane polygon"));
  ASSERT_TRUE(edit(EditKind::kDelete, {id}).edit);
  EXPECT_FALSE(map_.features().contains(id));
}

TEST_F(EditTest, TheOperatorsLastWordIsTheLabelOfAMergedFeature) {
  see({table(-1.2), table(1.2)}, 2);
  const std::vector<FeatureId> pieces = tables();
  edit({.kind = EditKind::kLabel, .targets = {pieces[1]}, .label = "floor"});
  edit({.kind = EditKind::kLabel, .targets = {pieces[0]}, .label = "desk"});
  edit({.kind = EditKind::kLabel, .targets = {pieces[1]}, .label = "table"});
  see({table(0.0, 1.6)}, 1);  // bridges them
  ASSERT_EQ(tables().size(), 1U);
  EXPECT_EQ(feature(pieces[0]).label, "table");
  EXPECT_THAT(feature(pieces[0]).other_labels, ::testing::ElementsAre("desk"));
  edit({.kind = EditKind::kLabel, .targets = {pieces[0]}, .label = "bar"});
  EXPECT_TRUE(feature(pieces[0]).other_labels.empty());
}

TEST_F(EditTest, EditsFollowACorrectedPoseAndOutliveTheirFirstKeyFrame) {
  see({table(), wall()}, 5);
  const FeatureId id = tables().at(0);
  edit({.kind = EditKind::kLabel, .targets = {id}, .label = "table"});
  edit({.kind = EditKind::kMove,
        .targets = {id},
        .T_world_moved = Isometry3d(Translation3d(0, 0, 0.2))});
  const Vector3d before = feature(id).surface.frame.origin;
  PoseCorrection correction;
  const Isometry3d shift(Translation3d(1.0, 2.0, 0.0));
  for (const auto& [keyframe, observation] : map_.history().keyframes()) {
    correction.poses.emplace_back(keyframe, shift * observation->T_world_camera);
  }
  map_.apply(correction);
  EXPECT_LT((feature(id).surface.frame.origin - shift * before).norm(), 1e-6);

  map_.apply(KeyframeRemoval{id.keyframe});
  ASSERT_EQ(tables().size(), 1U);
  EXPECT_NE(tables()[0], id);
  EXPECT_EQ(feature(tables()[0]).label, "table");
  EXPECT_NEAR(feature(tables()[0]).surface.frame.origin.z(), 0.95, 0.02);
}

TEST_F(EditTest, AnEditWhoseTargetIsGoneIsIdleAndWorksAgainWhenItIsBack) {
  see({table(), wall()}, 2);
  const FeatureId id = tables().at(0);
  const EditResult label = edit({.kind = EditKind::kLabel, .targets = {id}, .label = "table"});
  const EditResult first = edit({.kind = EditKind::kDropKeyframe, .keyframe = 1});
  const EditResult second = edit({.kind = EditKind::kDropKeyframe, .keyframe = 2});
  EXPECT_TRUE(map_.features().empty());
  EXPECT_EQ(map_.idle_edits().count(label.edit->number), 1U);
  undo({second.edit->number});
  EXPECT_TRUE(map_.idle_edits().empty());
  EXPECT_EQ(feature(tables().at(0)).label, "table");
}

TEST_F(EditTest, EachRefusalSaysWhy) {
  see({table(-1.2), table(1.2), wall()}, 2);
  const std::vector<FeatureId> pieces = tables();
  const auto refusal = [&](EditCommand command) { return edit(std::move(command)).refusal; };
  EXPECT_THAT(refusal({.kind = EditKind::kDelete, .targets = {{77, 7}}}),
              HasSubstr("77-7 is not in the map"));
  edit({.kind = EditKind::kDelete, .targets = {pieces[1]}});
  EXPECT_THAT(refusal({.kind = EditKind::kLabel, .targets = {pieces[1]}, .label = "x"}),
              HasSubstr("(delete by ann, edit 1)"));
  undo();
  see({table(0.0, 1.6)}, 1);
  EXPECT_THAT(refusal({.kind = EditKind::kDelete, .targets = {pieces[1]}}),
              HasSubstr("is part of " + to_string(pieces[0])));
  EXPECT_THAT(refusal({.kind = EditKind::kUndo, .edits = {1}}), HasSubstr("undone already"));
  EXPECT_THAT(refusal({.kind = EditKind::kUndo, .edits = {2}}), HasSubstr("undo or redo itself"));
  EXPECT_THAT(refusal({.kind = EditKind::kUndo, .edits = {99}}), HasSubstr("no edit 99"));
  EXPECT_THAT(refusal({.kind = EditKind::kUndo}), HasSubstr("nothing to undo"));
  EXPECT_THAT(refusal({.kind = EditKind::kRestore, .edits = {1}}), HasSubstr("any more"));
  EXPECT_THAT(refusal({.kind = EditKind::kUnlock, .targets = {pieces[0]}}), HasSubstr("not held"));
  EXPECT_THAT(refusal({.kind = EditKind::kDropKeyframe, .keyframe = 9}), HasSubstr("no key frame"));
  EXPECT_THAT(refusal({.kind = EditKind::kMerge, .targets = {pieces[0]}}), HasSubstr("two"));
  Isometry3d skew = Isometry3d::Identity();
  skew.linear()(0, 1) = 0.1;
  EXPECT_THAT(refusal({.kind = EditKind::kMove, .targets = {pieces[0]}, .T_world_moved = skew}),
              HasSubstr("not_rigid"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal({.kind = EditKind::kAdd, .points = {{0, 0, nan}, {1, 0, 0}, {0, 1, 0}}}),
              HasSubstr("not finite"));
  for (const char* label : {"a\nb", "caf\xe9", "\x1b[2J"}) {
    EXPECT_THAT(refusal({.kind = EditKind::kLabel, .targets = pieces, .label = label}),
                HasSubstr("control characters or invalid UTF-8"));
  }
}

TEST_F(EditTest, ACommandThatComesTwiceIsDoneOnce) {
  see({table()}, 2);
  EditCommand command{
      .kind = EditKind::kLabel, .author = "ann", .command = 7, .targets = tables(), .label = "a"};
  const EditResult once = map_.edit(command);
  const std::string hash = hash_of(map_);
  const EditResult twice = map_.edit(command);
  EXPECT_TRUE(twice.is_repeated);
  EXPECT_EQ(twice.edit->number, once.edit->number);
  EXPECT_EQ(hash_of(map_), hash);
  command.author = "bob";
  EXPECT_FALSE(map_.edit(command).is_repeated);
}

TEST_F(EditTest, AnEditThatIsMadeLaterWithAnEarlierPlaceGivesTheSameMap) {
  see({table(), wall()}, 4);
  GeometricMap late = map_;
  Observer copy = observer_;
  const FeatureId id = tables().at(0);
  const EditCommand command{.kind = EditKind::kDelete, .targets = {id}};
  map_.edit(command);
  for (int i = 0; i < 5; ++i) see({table(), wall()});
  for (std::int64_t k = 5; k <= 9; ++k) {
    late.apply(copy.observe(k, {table(), wall()}, camera_at(k)));
  }
  late.edit(command, 4);
  EXPECT_EQ(hash_of(late), hash_of(map_));
}

TEST_F(EditTest, WhatHangsOnARemovedKeyFrameStillFollowsItsCorrection) {
  see({wall()}, 1);
  edit({.kind = EditKind::kAdd, .points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, .label = "ramp"});
  see({wall()}, 3);
  map_.apply(KeyframeRemoval{1});
  const Isometry3d shift(Translation3d(0.0, 0.0, 1.0));
  map_.apply(PoseCorrection{{{1, shift * camera_at(1)}}});
  const auto ramps = tables();
  ASSERT_EQ(ramps.size(), 1U);
  EXPECT_NEAR(feature(ramps[0]).surface.frame.origin.z(), 1.0, 1e-9);
  const std::string corrected = hash_of(map_);
  edit({.kind = EditKind::kLabel, .targets = ramps, .label = "stage"});
  undo();
  EXPECT_EQ(hash_of(map_), corrected);
}

TEST_F(EditTest, OldEditsArePartOfTheBaseOfACompactedMapAndNewOnesStillCanBeUndone) {
  const HistoryConfig small{.copy_every = 2, .max_copies = 16, .max_keyframes = 12};
  GeometricMap compacted(MergeConfig{}, small);
  const auto both = [&](const MapEvent& event) {
    map_.apply(event);
    compacted.apply(event);
  };
  const auto edit_both = [&](EditCommand command) {
    const EditResult there = compacted.edit(command);
    EXPECT_EQ(static_cast<bool>(edit(command).edit), static_cast<bool>(there.edit))
        << there.refusal;
  };
  for (std::int64_t k = 1; k <= 60; ++k) {
    both(observer_.observe(k, {table(), wall()}, camera_at(k)));
    ASSERT_EQ(hash_of(compacted), hash_of(map_)) << k;
    if (k == 3)
      edit_both({.kind = EditKind::kMove,
                 .targets = {tables().at(0)},
                 .T_world_moved = Isometry3d(Translation3d(0, 0, 0.3))});
    if (k == 5) edit_both({.kind = EditKind::kDropKeyframe, .keyframe = 4});
    if (k == 20) edit_both({.kind = EditKind::kLabel, .targets = {tables().at(0)}, .label = "a"});
    if (k % 10 == 8) {
      both(PoseCorrection{{{k - 1, Translation3d(0.002, 0, 0) * camera_at(k - 1)}}});
    }
  }
  ASSERT_TRUE(compacted.history().forgotten_through());
  EXPECT_EQ(compacted.history().edits().entries().size(), 0U);
  EXPECT_THAT(compacted.edit({.kind = EditKind::kUndo, .edits = {1}}).refusal,
              HasSubstr("too old"));
  EXPECT_THAT(compacted.edit({.kind = EditKind::kUndo}).refusal, HasSubstr("nothing to undo"));
  EXPECT_THAT(compacted.edit({.kind = EditKind::kUnlock, .targets = {tables().at(0)}}).refusal,
              HasSubstr("too old"));

  edit_both({.kind = EditKind::kLabel, .targets = {tables().at(0)}, .label = "b"});
  edit_both({.kind = EditKind::kDelete, .targets = {tables().at(0)}});
  EXPECT_EQ(compacted.history().edits().last_number(), 5);
  GeometricMap loaded(compacted.saved());
  EXPECT_EQ(loaded.history().edits().last_number(), 5);
  for (GeometricMap* map : {&map_, &compacted, &loaded}) {
    map->edit({.kind = EditKind::kUndo});
    map->apply(observer_.observe(61, {}, camera_at(61)));
  }
  EXPECT_EQ(hash_of(compacted), hash_of(map_));
  EXPECT_EQ(hash_of(loaded), hash_of(map_));
  EXPECT_EQ(feature(tables().at(0)).label, "b");
}

TEST_F(EditTest, UndoAndRedoGoBackAndForthStepByStep) {
  see({table(), wall()}, 3);
  std::vector<std::string> hashes = {hash_of(map_)};
  const FeatureId id = tables().at(0);
  for (const char* label : {"a", "b", "c"}) {
    edit({.kind = EditKind::kLabel, .targets = {id}, .label = label});
    hashes.push_back(hash_of(map_));
  }
  for (int i = 2; i >= 0; --i) {
    ASSERT_TRUE(undo().edit);
    EXPECT_EQ(hash_of(map_), hashes[static_cast<std::size_t>(i)]);
  }
  for (std::size_t i = 1; i <= 3; ++i) {
    ASSERT_TRUE(edit({.kind = EditKind::kRedo}).edit);
    EXPECT_EQ(hash_of(map_), hashes[i]);
  }
}

}  // namespace
}  // namespace geomap::mapping
