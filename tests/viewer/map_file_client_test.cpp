// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/map_file_client.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "mapping/map_hash.hpp"
#include "mapping/map_journal.hpp"
#include "mapping/scene.hpp"
#include "messaging/temporary_folder.hpp"
#include "viewer/example_messages.hpp"

namespace geomap::viewer {
namespace {

using mapping::EditKind;
using ::testing::HasSubstr;
using ::testing::SizeIs;

class MapFileTest : public testing::TemporaryFolder {
 protected:
  MapFileTest() {
    mapping::GeometricMap map({}, {});
    testing::Observer observer;
    for (int i = 1; i <= 3; ++i) {
      map.apply(observer.observe(i, testing::boards(4), testing::camera_at(i)));
    }
    mapping::save_map(path("map.lcmlog"), map);
    source_ = open_map_file(path("map.lcmlog"));
    update();
  }
  bool update() { return source_->update(scene_, Clock::now()); }
  Outcome edit(mapping::EditCommand command) {
    command.author = "ann";
    command.command = ++command_;
    source_->edit(command);
    const auto outcomes = source_->take_outcomes();
    EXPECT_THAT(outcomes, SizeIs(1));
    EXPECT_EQ(outcomes.at(0).command, command_);
    return outcomes.at(0);
  }

  std::unique_ptr<MapSource> source_;
  SceneModel scene_;
  std::int64_t command_ = 0;
};

TEST_F(MapFileTest, ShowsTheMapAndItsKeyFramesOnce) {
  EXPECT_EQ(scene_.map.features.size(), 4u);
  EXPECT_EQ(scene_.track.keyframes.size(), 3u);
  EXPECT_TRUE(scene_.map.is_current);
  EXPECT_FALSE(update());
  EXPECT_EQ(source_->title(), "map.lcmlog");
  EXPECT_FALSE(source_->is_live());
}

TEST_F(MapFileTest, AnEditIsDoneAtOnceAndCanBeUndone) {
  const mapping::FeatureId victim = scene_.map.features.begin()->first;
  const std::string before = source_->snapshot(scene_).hash;
  EXPECT_TRUE(edit({.kind = EditKind::kDelete, .targets = {victim}}).is_done);
  EXPECT_TRUE(update());
  EXPECT_FALSE(scene_.map.features.contains(victim));
  EXPECT_THAT(scene_.map.vetoes, SizeIs(1));
  ASSERT_THAT(source_->history(), SizeIs(1));
  EXPECT_TRUE(source_->history()[0].keeps_out);
  EXPECT_TRUE(edit({.kind = EditKind::kUndo}).is_done);
  update();
  EXPECT_TRUE(scene_.map.features.contains(victim));
  EXPECT_EQ(source_->history()[0].state, HistoryEntry::State::kUndone);
  EXPECT_EQ(source_->snapshot(scene_).hash, before);
}

TEST_F(MapFileTest, ARefusalSaysWhyAndChangesNothing) {
  const Outcome outcome = edit({.kind = EditKind::kDelete, .targets = {{99, 0}}});
  EXPECT_FALSE(outcome.is_done);
  EXPECT_FALSE(outcome.text.empty());
  EXPECT_FALSE(update());
}

TEST_F(MapFileTest, SavesExactlyWhatIsShownWhereItIsTold) {
  edit({.kind = EditKind::kDelete, .targets = {scene_.map.features.begin()->first}});
  const std::int64_t number = source_->save(path("other.lcmlog"));
  const auto outcomes = source_->take_outcomes();
  ASSERT_THAT(outcomes, SizeIs(1));
  EXPECT_EQ(outcomes[0].command, number);
  EXPECT_TRUE(outcomes[0].is_done) << outcomes[0].text;
  const mapping::SavedMap saved = mapping::load_map(path("other.lcmlog"));
  EXPECT_EQ(mapping::map_hash(saved.contents.features, saved.contents.vetoes),
            source_->exact_snapshot(scene_).hash);
  EXPECT_EQ(source_->default_save_name(), path("map.lcmlog"));
}

TEST_F(MapFileTest, ASaveThatFailsSaysWhere) {
  source_->save(path("no/such/folder.lcmlog"));
  const auto outcomes = source_->take_outcomes();
  ASSERT_THAT(outcomes, SizeIs(1));
  EXPECT_FALSE(outcomes[0].is_done);
  EXPECT_THAT(outcomes[0].text, HasSubstr("no/such"));
}

TEST_F(MapFileTest, WhatIsNoMapIsRefusedInOneLine) {
  EXPECT_THROW(open_map_file(path("missing.lcmlog")), std::runtime_error);
  EXPECT_THROW(open_map_file(write_file("text.lcmlog", "hello")), std::runtime_error);
}

}  // namespace
}  // namespace geomap::viewer
