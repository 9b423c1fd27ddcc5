// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/event_journal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <functional>
#include <random>
#include <set>

#include "mapping/map_hash.hpp"
#include "mapping/map_journal.hpp"
#include "mapping/scene.hpp"
#include "messaging/log_reader.hpp"
#include "messaging/temporary_folder.hpp"

namespace geomap::mapping {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr JournalLimits kSmall{.events_per_state = 7, .most_spare_bytes = 20'000};

std::shared_ptr<const Observation> view(std::int64_t keyframe) {
  testing::Observer observer(static_cast<std::uint32_t>(keyframe));
  observer.angle_noise = 0.01;
  observer.offset_noise = 0.004;
  observer.outline_noise = 0.02;
  const double side = 0.1 * static_cast<double>(keyframe % 20) - 1.0;
  return observer.observe(keyframe, testing::small_room(),
                          testing::look_at({side, -1.5, 1.4}, {0, 1, 0.7}));
}

/// Views, and now and then a removal or a correction.
std::vector<MapEvent> history(int events) {
  std::vector<MapEvent> history;
  for (std::int64_t i = 1; i <= events; ++i) {
    if (i % 11 == 0) {
      history.emplace_back(KeyframeRemoval{i - 3});
    } else if (i % 13 == 0) {
      history.emplace_back(PoseCorrection{
          {{i - 1, Eigen::Translation3d(0.01, 0, 0) * view(i - 1)->T_world_camera}}});
    } else {
      history.emplace_back(view(i));
    }
  }
  return history;
}

/// Hashes of the map before the first event, and after each.
std::vector<std::string> hashes_of(const std::vector<MapEvent>& events) {
  GeometricMap map(MergeConfig{}, HistoryConfig{});
  std::vector<std::string> hashes = {map_hash(map.features())};
  for (const MapEvent& event : events) {
    map.apply(event);
    hashes.push_back(map_hash(map.features()));
  }
  return hashes;
}

std::size_t events_in(const GeometricMap& map) { return map.history().events().size(); }

class EventJournalTest : public testing::TemporaryFolder {
 protected:
  fs::path folder() const { return path("state"); }

  GeometricMap recovered(const fs::path& from, std::string* report = nullptr) const {
    EventJournal journal(from, kSmall);
    GeometricMap map = journal.open(MergeConfig{}, HistoryConfig{});
    if (report != nullptr) *report = journal.recovery();
    return map;
  }
  GeometricMap recovered() const { return recovered(folder()); }

  /// Applies and stores events from where the journal stands. @param stored after each.
  void store(const std::vector<MapEvent>& events, const JournalLimits& limits,
             const std::function<void(std::size_t)>& stored = {}) const {
    EventJournal journal(folder(), limits);
    GeometricMap map = journal.open(MergeConfig{}, HistoryConfig{});
    for (std::size_t i = events_in(map); i < events.size(); ++i) {
      ASSERT_EQ(map.apply(events[i]).fault, EventFault::kNone);
      journal.add(events[i], map);
      if (stored) stored(i + 1);
    }
    EXPECT_EQ(journal.trouble(), "");
  }

  std::vector<fs::path> journals() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder())) {
      if (entry.path().extension() == ".lcmlog") files.push_back(entry.path());
    }
    return files;
  }
};

TEST_F(EventJournalTest, GivesTheMapBackToTheLastBit) {
  const std::vector<MapEvent> events = history(60);
  const std::vector<std::string> hashes = hashes_of(events);
  GeometricMap map(MergeConfig{}, HistoryConfig{});
  for (std::size_t through : {0U, 1U, 6U, 7U, 8U, 30U, 60U}) {
    store({events.begin(), events.begin() + static_cast<std::ptrdiff_t>(through)}, kSmall);
    map = recovered();
    EXPECT_EQ(map_hash(map.features()), hashes[through]);
    EXPECT_EQ(events_in(map), through);
  }
  // It goes on, and folds again, as if nothing had been.
  GeometricMap reference(MergeConfig{}, HistoryConfig{});
  for (const MapEvent& event : events) reference.apply(event);
  for (const MapEvent& event : {MapEvent(KeyframeRemoval{5}), MapEvent(view(100))}) {
    map.apply(event);
    reference.apply(event);
    EXPECT_EQ(map_hash(map.features()), map_hash(reference.features()));
  }
}

TEST_F(EventJournalTest, IsALogOfMapEvents) {
  store(history(20), {});
  messaging::LogReader reader(journals().at(0).string());
  int events = 0;
  while (const auto event = reader.next()) events += event->channel == "MAP_EVENT";
  EXPECT_EQ(events, 20);
  const SavedMap saved = load_map(journals().at(0));  // and a map, for every other program
  EXPECT_EQ(map_hash(saved.contents.features), hashes_of(history(20)).back());
}

TEST_F(EventJournalTest, DoesNotGrowForEver) {
  store(history(20), kSmall);
  GeometricMap map = recovered();
  EventJournal journal(folder(), kSmall);
  map = journal.open(MergeConfig{}, HistoryConfig{});
  std::uintmax_t largest = 0;
  for (int i = 0; i < 400; ++i) {  // a removal a key frame: the map stays as it is
    const MapEvent event = PoseCorrection{{{1, view(1)->T_world_camera}}};
    map.apply(event);
    journal.add(event, map);
    if (i % 50 == 0) {
      journal.replace(GeometricMap(MergeConfig{}, HistoryConfig{}));
      journal.replace(map);
    }
    ASSERT_EQ(journals().size(), 1U);
    largest = std::max(largest, fs::file_size(journals()[0]));
  }
  save_map(path("whole.lcmlog"), map);
  EXPECT_LT(largest, 3 * fs::file_size(path("whole.lcmlog")) + 40'000);
}

/// Copies the journal, cut off at `size`, and recovers it.
TEST_F(EventJournalTest, ATornJournalGivesWhatIsWholeInIt) {
  const std::vector<MapEvent> events = history(24);
  const std::vector<std::string> hashes = hashes_of(events);
  std::vector<std::uintmax_t> sizes;  // of the file after each event
  const JournalLimits limits{.events_per_state = 7, .most_spare_bytes = 1 << 20};
  store(events, limits, [&](std::size_t) { sizes.push_back(fs::file_size(journals().at(0))); });
  const std::string whole = read_file(journals().at(0).string());
  ASSERT_EQ(whole.size(), sizes.back());
  std::uintmax_t empty = 0;
  {
    fs::create_directories(path("empty"));
    EventJournal journal(path("empty"));
    journal.open(MergeConfig{}, HistoryConfig{});
    empty = fs::file_size(path("empty") + "/journal-000001.lcmlog");
  }
  std::set<std::size_t> cuts;
  for (std::size_t at = sizes[events.size() - 4]; at <= whole.size(); ++at) cuts.insert(at);
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) cuts.insert(empty + random() % (whole.size() - empty));

  const fs::path torn = path("torn");
  fs::create_directories(torn);
  for (const std::size_t cut : cuts) {
    std::ofstream(torn / "journal-000001.lcmlog", std::ios::binary) << whole.substr(0, cut);
    std::string report;
    const GeometricMap map = recovered(torn, &report);
    const std::size_t count = events_in(map);
    // A record may be whole before the state behind it is: sizes are those after both.
    const auto acknowledged =
        static_cast<std::size_t>(std::upper_bound(sizes.begin(), sizes.end(), cut) - sizes.begin());
    ASSERT_GE(count, acknowledged) << cut;
    ASSERT_LE(count, acknowledged + 1) << cut;
    ASSERT_EQ(map_hash(map.features()), hashes[count]) << cut;
    const bool is_torn = cut != (acknowledged == 0 ? empty : sizes[acknowledged - 1]);
    if (is_torn && count == acknowledged) {
      ASSERT_THAT(report, HasSubstr("torn"));
    }
    if (cut % 16 != 0) continue;
    // What was torn is gone: the next event can be read again.
    EventJournal journal(torn, limits);
    GeometricMap goes_on = journal.open(MergeConfig{}, HistoryConfig{});
    goes_on.apply(MapEvent(view(500)));
    journal.add(view(500), goes_on);
    ASSERT_EQ(journal.trouble(), "");
    const LoadedJournal stored = load_journal(torn / "journal-000001.lcmlog");
    ASSERT_EQ(stored.torn + stored.damaged, 0);
  }
}

/// Feeds a child process that stores events, one after the other, until it is killed.
TEST_F(EventJournalTest, AProcessKilledAtAnyMomentLosesNothingItHasAcknowledged) {
  const std::vector<MapEvent> events = history(400);
  const std::vector<std::string> hashes = hashes_of(events);
  std::mt19937 random(2);
  std::size_t known = 0;
  int kills = 0;
  for (; kills < 100; ++kills) {
    int acknowledgements[2];
    ASSERT_EQ(pipe(acknowledgements), 0);
    const pid_t child = fork();
    if (child == 0) {
      close(acknowledgements[0]);
      store(events, kSmall, [&](std::size_t count) {
        if (write(acknowledgements[1], &count, sizeof count) != sizeof count) _exit(1);
      });
      _exit(0);
    }
    close(acknowledgements[1]);
    usleep(static_cast<useconds_t>(random() % 30'000));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    std::size_t acknowledged = known;
    while (read(acknowledgements[0], &acknowledged, sizeof acknowledged) == sizeof acknowledged) {
    }
    close(acknowledgements[0]);
    const GeometricMap map = recovered();
    known = events_in(map);
    ASSERT_GE(known, acknowledged);
    ASSERT_LE(known, acknowledged + 1);
    ASSERT_EQ(map_hash(map.features()), hashes[known]);
    if (known == events.size()) fs::remove_all(folder()), known = 0;
  }
}

/// While alive, no file of this process may grow beyond a size.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(std::uintmax_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

TEST_F(EventJournalTest, WithoutRoomTheMapGoesOnAndIsStoredLater) {
  const std::vector<MapEvent> events = history(60);
  const std::vector<std::string> hashes = hashes_of(events);
  store({events.begin(), events.begin() + 20}, {});
  {
    EventJournal journal(folder(), {});
    GeometricMap map = journal.open(MergeConfig{}, HistoryConfig{});
    const auto add = [&](std::size_t i) {
      map.apply(events[i]);
      journal.add(events[i], map);
    };
    {
      const FileSizeLimit limit(fs::file_size(journals().at(0)) + 3'000);
      for (std::size_t i = 20; i < 40; ++i) add(i);
      EXPECT_THAT(journal.trouble(), HasSubstr("not stored"));
      EXPECT_THAT(journal.trouble(), HasSubstr("journal-000001.lcmlog"));
      journal.retry(map);
      EXPECT_NE(journal.trouble(), "");
      // As if it were killed now: what was stored is there, and no torn record.
      const LoadedJournal stored = load_journal(journals().at(0));
      EXPECT_GE(stored.saved.events.size() + stored.later.size(), 20U);
      EXPECT_EQ(stored.torn, 0);
    }
    journal.retry(map);
    EXPECT_EQ(journal.trouble(), "");
    for (std::size_t i = 40; i < 60; ++i) add(i);
    EXPECT_EQ(journal.trouble(), "");
  }
  EXPECT_EQ(map_hash(recovered().features()), hashes.back());
}

TEST_F(EventJournalTest, AMapThatIsReplacedWithoutRoomIsStoredLater) {
  const std::vector<MapEvent> events = history(20);
  store(events, {});
  {
    EventJournal journal(folder(), {});
    journal.open(MergeConfig{}, HistoryConfig{});
    GeometricMap other(MergeConfig{}, HistoryConfig{});
    other.apply(view(7));
    {
      const FileSizeLimit limit(100);
      journal.replace(other);
      EXPECT_NE(journal.trouble(), "");
      EXPECT_EQ(map_hash(load_map(journals().at(0)).contents.features), hashes_of(events).back());
      other.apply(view(8));
      journal.add(view(8), other);
      EXPECT_NE(journal.trouble(), "");
    }
    journal.retry(other);
    EXPECT_EQ(journal.trouble(), "");
  }
  EXPECT_EQ(map_hash(recovered().features()), hashes_of({view(7), view(8)}).back());
}

TEST_F(EventJournalTest, OneFolderServesOneProcess) {
  const EventJournal journal(folder());
  try {
    EventJournal second(folder());
    FAIL() << "not refused";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr(folder().string()));
    EXPECT_THAT(error.what(), HasSubstr("another process"));
  }
}

TEST_F(EventJournalTest, OtherSettingsOfMergingFoldTheMapAnew) {
  GeometricMap edited(MergeConfig{}, HistoryConfig{});
  for (const MapEvent& event : history(20)) edited.apply(event);
  edited.edit({.kind = EditKind::kDelete, .targets = {edited.features().begin()->first}});
  edited.edit(
      {.kind = EditKind::kLabel, .targets = {edited.features().begin()->first}, .label = "wall"});
  edited.edit({.kind = EditKind::kUndo});
  const std::vector<MapEvent> events = edited.history().events();
  store(events, {});
  MergeConfig narrow;
  narrow.gap = 0.001;
  GeometricMap expected(narrow, HistoryConfig{});
  for (const MapEvent& event : events) expected.apply(event);
  for (const char* times : {"folded anew", ""}) {
    EventJournal journal(folder());
    const GeometricMap map = journal.open(narrow, HistoryConfig{});
    EXPECT_EQ(map_hash(map.features(), map.vetoes()),
              map_hash(expected.features(), expected.vetoes()));
    EXPECT_EQ(map.history().edits().entries().size(), 3U);
    EXPECT_EQ(map.vetoes().size(), 1U);
    EXPECT_THAT(journal.recovery(), HasSubstr(times));
  }
}

TEST_F(EventJournalTest, ACompactedMapKeepsItsBase) {
  HistoryConfig small;
  small.copy_every = 2;
  small.max_keyframes = 8;
  GeometricMap map(MergeConfig{}, small);
  {
    EventJournal journal(folder(), kSmall);
    map = journal.open(MergeConfig{}, small);
    for (std::int64_t i = 1; i <= 40; ++i) {
      map.apply(view(i));
      journal.add(view(i), map);
    }
    ASSERT_TRUE(map.history().forgotten_through());
  }
  EventJournal journal(folder(), kSmall);
  EXPECT_EQ(map_hash(journal.open(MergeConfig{}, small).features()), map_hash(map.features()));
}

TEST_F(EventJournalTest, ADamagedMapIsNotOverwritten) {
  store(history(20), {});
  const fs::path file = journals().at(0);
  std::string bytes = read_file(file.string());
  bytes[100] ^= 1;  // in its first MAP_STATE
  std::ofstream(file, std::ios::binary) << bytes;
  EventJournal journal(folder(), kSmall);
  EXPECT_THROW(journal.open(MergeConfig{}, HistoryConfig{}), std::runtime_error);
  EXPECT_EQ(read_file(file.string()), bytes);
}

TEST_F(EventJournalTest, NamesOfMapsArePlain) {
  const EventJournal journal(folder());
  EXPECT_EQ(journal.file_of("office-2.a"), folder() / "office-2.a.lcmlog");
  for (const std::string name : {"", ".", "..", "../map", "a/b", "/etc/passwd", ".hidden", "a b",
                                 "journal-000001", "a\n", "\xc3\xa4"}) {
    EXPECT_THROW(journal.file_of(name), std::invalid_argument) << name;
  }
  EXPECT_THROW(journal.file_of(std::string(65, 'a')), std::invalid_argument);
}

}  // namespace
}  // namespace geomap::mapping
