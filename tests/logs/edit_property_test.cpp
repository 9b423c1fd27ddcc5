// SPDX-License-Identifier: BSD-3-Clause
// Edits of all kinds on the simulated kitchen, mixed with further key frames, from a journal too:
// undo of all of them gives the map that never had them.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "logs/simulated_sweep.hpp"
#include "mapping/event_journal.hpp"
#include "mapping/map_journal.hpp"
#include "mapping/random_operator.hpp"
#include "mapping/scene.hpp"

namespace geomap::logs {
namespace {

using mapping::EditKind;
using mapping::GeometricMap;
using testing::hash_of;

constexpr std::uint32_t kSequences = 200;
constexpr int kEdits = 8;                  // of each
constexpr std::size_t kFirst = 40;         // key frames before the first edit
constexpr std::size_t kLast = kFirst + 6;  // after the last one

/// Copies between and behind edits.
mapping::HistoryConfig close_copies() {
  mapping::HistoryConfig history;
  history.copy_every = 3;
  return history;
}

class EditProperty : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const testing::TemporaryFolder folder;
    testing::replay_sweep(folder, "kitchen", 0.005, 4.0);
    events_ = mapping::load_map(folder / "out" / "map.lcmlog").events;
    ASSERT_GT(events_.size(), kLast);
    begun_ = std::make_unique<GeometricMap>(folded(kFirst));
    expected_ = hash_of(folded(kLast));
  }
  static void TearDownTestSuite() {
    begun_.reset();
    events_.clear();
  }

  static GeometricMap folded(std::size_t count) {
    GeometricMap map(mapping::MergeConfig{}, close_copies());
    for (std::size_t i = 0; i < count; ++i) map.apply(events_[i]);
    return map;
  }

  /// Edits, each now and then followed by a key frame; all are in at the end.
  static void edit_while_mapping(testing::RandomOperator& ann, GeometricMap& map) {
    for (std::size_t i = kFirst; i < kLast; ++i) {
      ann.edit(map, kEdits / static_cast<int>(kLast - kFirst) + 1);
      map.apply(events_[i]);
    }
  }

  static std::vector<mapping::MapEvent> events_;
  static std::unique_ptr<GeometricMap> begun_;  // of the first key frames
  static std::string expected_;                 // without an edit
};

std::vector<mapping::MapEvent> EditProperty::events_;
std::unique_ptr<GeometricMap> EditProperty::begun_;
std::string EditProperty::expected_;

TEST_F(EditProperty, UndoOfAllEditsGivesTheMapThatNeverHadThem) {
  std::map<EditKind, int> kinds;
  int changed = 0;
  for (std::uint32_t seed = 0; seed < kSequences; ++seed) {
    testing::RandomOperator ann(seed);
    GeometricMap map = *begun_;
    edit_while_mapping(ann, map);
    if (hash_of(map) != expected_) ++changed;
    for (const auto& [number, entry] : map.history().edits().entries()) ++kinds[entry.edit->kind];
    const bool in_random_order = seed % 2 == 1;
    ASSERT_TRUE(ann.undo_all(map, in_random_order)) << seed;
    ASSERT_EQ(hash_of(map), expected_) << seed;
  }
  EXPECT_GT(changed, static_cast<int>(kSequences * 3 / 4));
  EXPECT_EQ(kinds.size(), static_cast<std::size_t>(mapping::kLastEditKind) + 1);  // every one
}

// A kill leaves what was synced: the journal is left as it is, without a word of farewell.
TEST_F(EditProperty, AlsoWhenTheMapperIsStartedAnewInBetween) {
  for (std::uint32_t seed = 0; seed < kSequences / 2; ++seed) {
    const testing::TemporaryFolder folder;
    testing::RandomOperator ann(1000 + seed);
    auto journal = std::make_unique<mapping::EventJournal>(folder / "state");
    GeometricMap map = journal->open(mapping::MergeConfig{}, close_copies());
    map = *begun_;
    journal->replace(map);
    const auto edit_and_store = [&](mapping::EditCommand command) {
      const mapping::EditResult result = map.edit(command);
      if (result.edit && !result.is_repeated) journal->add(result.edit, map);
    };
    const std::size_t restart = kFirst + seed % (kLast - kFirst);
    for (std::size_t i = kFirst; i < kLast; ++i) {
      for (int k = 0; k < 3; ++k) edit_and_store(ann.next(map));
      if (i == restart) {
        const std::string before = hash_of(map);
        const auto entries = map.history().edits().entries().size();
        journal.reset();
        journal = std::make_unique<mapping::EventJournal>(folder / "state");
        map = journal->open(mapping::MergeConfig{}, close_copies());
        ASSERT_EQ(hash_of(map), before) << seed;
        ASSERT_EQ(map.history().edits().entries().size(), entries) << seed;
      }
      map.apply(events_[i]);
      journal->add(events_[i], map);
    }
    ASSERT_TRUE(ann.undo_all(map, seed % 2 == 0)) << seed;
    ASSERT_EQ(hash_of(map), expected_) << seed;
  }
}

TEST_F(EditProperty, AtEachStepTheMapIsWhatFoldingAllItsEventsAnewGives) {
  for (std::uint32_t seed = 0; seed < kSequences / 10; ++seed) {
    testing::RandomOperator ann(2000 + seed);
    GeometricMap map = *begun_;
    for (std::size_t i = kFirst; i < kLast; ++i) {
      for (int step = 0; step < 4; ++step) {
        ann.edit(map, 1);
        GeometricMap anew = map;
        anew.fold_anew();
        ASSERT_EQ(hash_of(map), hash_of(anew)) << seed << ", " << i << ", " << step;
        ASSERT_EQ(map.idle_edits(), anew.idle_edits()) << seed << ", " << i << ", " << step;
      }
      map.apply(events_[i]);
    }
  }
}

TEST_F(EditProperty, ADroppedKeyFrameIsAsIfItHadNeverBeen) {
  const GeometricMap whole = folded(50);
  const std::string before = hash_of(whole);
  for (std::size_t dropped = 0; dropped < 50; ++dropped) {
    const auto& observation =
        *std::get<std::shared_ptr<const mapping::Observation>>(events_[dropped]);
    GeometricMap map = whole;
    ASSERT_TRUE(map.edit({.kind = EditKind::kDropKeyframe, .keyframe = observation.keyframe}).edit);
    GeometricMap without(mapping::MergeConfig{}, close_copies());
    for (std::size_t i = 0; i < 50; ++i) {
      if (i != dropped) without.apply(events_[i]);
    }
    ASSERT_EQ(hash_of(map), hash_of(without)) << dropped;
    map.edit({.kind = EditKind::kUndo});
    ASSERT_EQ(hash_of(map), before) << dropped;
  }
}

TEST_F(EditProperty, ASavedMapWithEditsIsTheSameWhenLoadedAndCanBeUndone) {
  const testing::TemporaryFolder folder;
  testing::RandomOperator ann(77);
  GeometricMap map = *begun_;
  edit_while_mapping(ann, map);
  mapping::save_map(folder / "map.lcmlog", map);
  GeometricMap loaded(mapping::load_map(folder / "map.lcmlog"));
  EXPECT_EQ(hash_of(loaded), hash_of(map));
  EXPECT_EQ(loaded.idle_edits(), map.idle_edits());
  ASSERT_TRUE(ann.undo_all(loaded, true));
  EXPECT_EQ(hash_of(loaded), expected_);
}

}  // namespace
}  // namespace geomap::logs
