// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map_journal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "mapping/map_hash.hpp"
#include "mapping/map_messages.hpp"
#include "mapping/scene.hpp"
#include "messaging/encode.hpp"
#include "messaging/log_reader.hpp"

namespace geomap::mapping {
namespace {

namespace fs = std::filesystem;

class MapJournal : public ::testing::Test {
 protected:
  MapJournal() {
    folder_ = fs::temp_directory_path() /
              (std::string("geomap_journal_") +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  ~MapJournal() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name = "map.lcmlog") const { return folder_ / name; }

  static std::shared_ptr<const Observation> view(int i) {
    testing::Observer observer(static_cast<std::uint32_t>(i));
    observer.angle_noise = 0.01;
    observer.offset_noise = 0.004;
    observer.outline_noise = 0.02;
    return observer.observe(1000 + i, testing::small_room(),
                            testing::look_at({0.1 * i - 1.0, -1.5, 1.4}, {0, 1, 0.7}));
  }

  static GeometricMap map_with_history(const HistoryConfig& history = {}) {
    GeometricMap map(MergeConfig{}, history);
    for (int i = 0; i < 20; ++i) map.apply(view(i));
    map.apply(KeyframeRemoval{1003});
    map.apply(
        PoseCorrection{{{1005, Eigen::Translation3d(0.001, 0, 0) * view(5)->T_world_camera}}});
    return map;
  }

  static std::string contents(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

 private:
  fs::path folder_;
};

TEST_F(MapJournal, ASavedMapIsTheSameWhenLoadedToTheLastBit) {
  const GeometricMap map = map_with_history();
  save_map(file(), map);
  const GeometricMap loaded(load_map(file()));
  EXPECT_EQ(map_hash(loaded.features()), map_hash(map.features()));
  EXPECT_EQ(loaded.revision(), map.revision());
  EXPECT_EQ(loaded.history().events().size(), map.history().events().size());
  save_map(file("again.lcmlog"), loaded);
  EXPECT_EQ(contents(file("again.lcmlog")), contents(file()));
}

TEST_F(MapJournal, ALoadedMapGoesOnAsIfItHadNeverBeenSaved) {
  GeometricMap map = map_with_history();
  save_map(file(), map);
  GeometricMap loaded(load_map(file()));
  const std::vector<MapEvent> more = {view(30), KeyframeRemoval{1000}, view(31),
                                      KeyframeRemoval{1012}};
  for (const MapEvent& event : more) {
    map.apply(event);
    loaded.apply(event);
    EXPECT_EQ(map_hash(loaded.features()), map_hash(map.features()));
  }
}

TEST_F(MapJournal, ACompactedMapKeepsItsBase) {
  HistoryConfig small;
  small.copy_every = 2;
  small.max_keyframes = 8;
  GeometricMap map = map_with_history(small);
  ASSERT_TRUE(map.history().forgotten_through());
  save_map(file(), map);
  GeometricMap loaded(load_map(file()));
  EXPECT_EQ(loaded.apply(KeyframeRemoval{1000}).fault, EventFault::kCompacted);
  map.apply(KeyframeRemoval{1019});
  loaded.apply(KeyframeRemoval{1019});
  EXPECT_EQ(map_hash(loaded.features()), map_hash(map.features()));
}

TEST_F(MapJournal, DamagedFilesAreRefusedWithALineThatNamesThem) {
  save_map(file(), map_with_history());
  const std::string whole = contents(file());
  const auto complaint = [&](const std::string& bytes) -> std::string {
    std::ofstream(file("bad.lcmlog"), std::ios::binary) << bytes;
    try {
      load_map(file("bad.lcmlog"));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(complaint(whole.substr(0, whole.size() / 2)), ::testing::HasSubstr("bad.lcmlog"));
  EXPECT_THAT(complaint("not a log"), ::testing::HasSubstr("bad.lcmlog"));
  EXPECT_THAT(complaint(""), ::testing::HasSubstr("bad.lcmlog"));
  std::string flipped = whole;  // one bit of a coordinate in the stored state
  flipped[flipped.size() - 600] = static_cast<char>(flipped[flipped.size() - 600] ^ 1);
  EXPECT_THAT(complaint(flipped), ::testing::HasSubstr("bad.lcmlog"));
  EXPECT_THROW(load_map(file("missing.lcmlog")), std::runtime_error);
}

TEST_F(MapJournal, AFailedSaveLeavesTheOldFile) {
  save_map(file(), map_with_history());
  const std::string before = contents(file());
  fs::create_directory(file().string() + ".part");  // in the way of the temporary file
  EXPECT_THROW(save_map(file(), map_with_history()), std::runtime_error);
  EXPECT_EQ(contents(file()), before);
}

TEST_F(MapJournal, EveryEventIsALogEventOfItsOwn) {
  save_map(file(), map_with_history());
  messaging::LogReader reader(file().string());
  int events = 0, states = 0;
  while (const auto event = reader.next()) {
    events += event->channel == "MAP_EVENT";
    states += event->channel == "MAP_STATE";
  }
  EXPECT_EQ(events, 22);
  EXPECT_EQ(states, 1);
}

}  // namespace
}  // namespace geomap::mapping
