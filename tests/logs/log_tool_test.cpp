// SPDX-License-Identifier: BSD-3-Clause
// geomap-log info, check and repair as their user sees them.
#include <array>
#include <filesystem>
#include <limits>
#include <random>
#include <set>

#include "logs/log_tool_fixture.hpp"

namespace geomap::logs {
namespace {

using messaging::LogEvent;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

/// Noise over a whole header, or over one byte of the magic word or of a length.
void damage_header(std::string& bytes, std::size_t offset, std::mt19937& random) {
  constexpr std::array<std::size_t, 12> kVital = {0, 1, 2, 3, 20, 21, 22, 23, 24, 25, 26, 27};
  if (random() % 3 == 0) {
    for (std::size_t i = 0; i < messaging::kLogHeaderSize; ++i) {
      bytes[offset + i] = static_cast<char>(random());
    }
    return;
  }
  char& byte = bytes[offset + kVital[random() % kVital.size()]];
  byte = static_cast<char>(byte ^ static_cast<char>(1 + random() % 255));
}

TEST_F(LogTool, RepairRecoversEveryEventButThoseWithADamagedHeader) {
  const std::vector<LogEvent> events = read_log(write_log("whole.lcmlog", some_events()));
  const std::vector<std::size_t> offsets = offsets_in(events);
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::set<std::size_t> damaged;
    std::string bytes = read_file(path("whole.lcmlog"));
    while (damaged.size() < 20) {
      const std::size_t number = random() % events.size();
      if (damaged.insert(number).second) damage_header(bytes, offsets[number], random);
    }
    const std::string log = write_file("damaged.lcmlog", bytes);
    EXPECT_EQ(run("check " + log).status, 1);
    EXPECT_EQ(run("repair " + log + " " + path("repaired.lcmlog")).status, 0);

    std::size_t recovered = 0;
    for (const LogEvent& event : read_log(path("repaired.lcmlog"))) {
      const auto number = static_cast<std::size_t>(event.number);
      if (damaged.contains(number)) continue;  // of two damaged in a row the first may look sound
      ASSERT_LT(number, events.size());
      EXPECT_EQ(bytes_of(event), bytes_of(events[number]));
      ++recovered;
    }
    EXPECT_EQ(recovered, events.size() - damaged.size()) << "seed " << seed;
  }
}

TEST_F(LogTool, RepairGivesAWholeLogBackBitForBit) {
  const std::string log = write_log("whole.lcmlog", some_events());
  EXPECT_THAT(run("repair " + log + " " + path("copy.lcmlog")).text,
              HasSubstr("181 events copied, 0 left out; 0 places"));
  EXPECT_EQ(read_file(path("copy.lcmlog")), read_file(log));
}

TEST_F(LogTool, ACutEndIsReportedWithItsPlaceAndRepaired) {
  const std::string whole = read_file(write_log("whole.lcmlog", some_events()));
  const std::size_t last = offsets_in(some_events()).back();
  for (const std::size_t left : {std::size_t{1}, std::size_t{27}, whole.size() - last - 1}) {
    const std::string log = write_file("cut.lcmlog", whole.substr(0, last + left));
    const testing::ProgramRun check = run("check " + log);
    EXPECT_EQ(check.status, 1);
    EXPECT_THAT(check.text, HasSubstr("offset " + std::to_string(last) + ": " +
                                      std::to_string(left) + " bytes of a last event that is cut"));
    run("repair " + log + " " + path("repaired.lcmlog"));
    EXPECT_EQ(read_file(path("repaired.lcmlog")), whole.substr(0, last));
    EXPECT_EQ(run_on("check", "repaired.lcmlog").text, "whole: 180 readable events\n");
  }
}

TEST_F(LogTool, CheckNamesEveryPlaceThatCannotBeRead) {
  std::string bytes = read_file(write_log("whole.lcmlog", some_events()));
  const std::vector<std::size_t> offsets = offsets_in(some_events());
  for (const std::size_t number : {5U, 50U}) bytes[offsets[number]] = 'x';
  const testing::ProgramRun check = run("check " + write_file("damaged.lcmlog", bytes));
  EXPECT_EQ(check.status, 1);
  for (const std::size_t number : {5U, 50U}) {
    EXPECT_THAT(check.text, HasSubstr("offset " + std::to_string(offsets[number]) + ": " +
                                      std::to_string(offsets[number + 1] - offsets[number]) +
                                      " bytes unreadable\n"));
  }
  EXPECT_THAT(check.text, HasSubstr("in 2 places unreadable, 0 no message"));
}

TEST_F(LogTool, CheckNamesEventsThatAreNoMessageOfTheirChannelsType) {
  std::vector<LogEvent> events = some_events();
  events[2].data.pop_back();      // POSE
  events[5].data[0] ^= 1;         // another fingerprint
  events[8].data.back() ^= 0x7f;  // of the acceleration: still a number
  events[11].data = {1, 2};       // not even a fingerprint
  const testing::ProgramRun check = run("check " + write_log("bad.lcmlog", events));
  const std::vector<std::size_t> offsets = offsets_in(events);
  EXPECT_EQ(check.status, 1);
  const auto line = [&](std::size_t number, const std::string& reason) {
    return HasSubstr("offset " + std::to_string(offsets[number]) +
                     ": no bot_core.pose_t on POSE: " + reason + "\n");
  };
  EXPECT_THAT(check.text, AllOf(line(2, "truncated"), line(5, "wrong_type"), line(11, "too_short"),
                                HasSubstr("in 0 places unreadable, 3 no message")));
}

TEST_F(LogTool, HowALogWasRecordedIsRemarkedButNoDamage) {
  std::vector<LogEvent> events = some_events();
  events.erase(events.begin() + 6);  // the second frame
  events[30].log_utime -= 1'500'000;
  const testing::ProgramRun check = run("check " + write_log("gaps.lcmlog", events));
  EXPECT_EQ(check.status, 0);
  EXPECT_EQ(check.text,
            "remark: 1 message missing on RGBD_FRAME by sequence number\n"
            "remark: the log's time goes back 1 time, by at most 1.467 s, first at offset " +
                std::to_string(offsets_in(events)[30]) + "\nwhole: 180 readable events\n");
}

TEST_F(LogTool, InfoListsChannelsWithTypesRatesAndLosses) {
  std::vector<LogEvent> events = some_events();
  events.erase(events.begin() + 6);
  const testing::ProgramRun info = run("info " + write_log("some.lcmlog", events));
  EXPECT_EQ(info.status, 0);
  EXPECT_THAT(
      info.text,
      AllOf(HasSubstr("180 events, 1.97 s, "), HasSubstr("from 1970-01-01 00:16:40.000 UTC\n"),
            ContainsRegex("LCM_SELF_TEST +unknown +1 +- +4 B +4 B +- +-\n"),
            ContainsRegex("POSE +bot_core.pose_t +60 +30.00 +144 B +8.6 kB +4.3 kB/s +-\n"),
            ContainsRegex("RGBD_FRAME +geomap.rgbd_frame_t +59 .* 1\n")));
}

TEST_F(LogTool, NamesAndTimesThatWereDamagedAreShownHarmlessly) {
  std::vector<LogEvent> events = some_events();
  events[3].channel = "\x1b[2J\n";
  events[4].log_utime = std::numeric_limits<std::int64_t>::min();
  events.back().log_utime = std::numeric_limits<std::int64_t>::max();
  const testing::ProgramRun info = run("info " + write_log("odd.lcmlog", events));
  EXPECT_EQ(info.status, 0);
  EXPECT_THAT(info.text, HasSubstr("\n?[2J?  "));
}

TEST_F(LogTool, WhatIsNoLogIsOneLineAndNoFile) {
  write_file("empty.lcmlog", "");
  write_file("zeros.lcmlog", std::string(10'000, '\0'));
  write_file("text.lcmlog", "not a log");
  for (const auto& [name, reason] :
       std::vector<std::pair<std::string, std::string>>{{"empty.lcmlog", "is empty"},
                                                        {"zeros.lcmlog", "is not an LCM log"},
                                                        {"text.lcmlog", "is not an LCM log"},
                                                        {"missing.lcmlog", "No such file"},
                                                        {"", "is a folder"}}) {
    for (const std::string command : {"info", "check", "repair", "cut"}) {
      const bool copies = command == "repair" || command == "cut";
      const testing::ProgramRun result =
          run(command + " " + path(name) + (copies ? " " + path("out.lcmlog") : ""));
      EXPECT_EQ(result.status, 1) << command << " " << name;
      EXPECT_THAT(result.text, AllOf(HasSubstr(reason), ContainsRegex("^geomap-log: [^\n]*\n$")));
      EXPECT_FALSE(std::filesystem::exists(path("out.lcmlog")));
    }
  }
}

/// In a network of its own, so that nothing but the player is recorded.
TEST_F(LogTool, WhatLcmLoggerRecordsIsWhole) {
  const std::string network =
      "unshare -rn sh -c 'ip link set lo up && ip route add 224.0.0.0/4 dev lo && ";
  if (testing::run_program(network + "command -v lcm-logger lcm-logplayer'").status != 0) {
    GTEST_SKIP() << "no lcm-logger, or no network namespace of our own";
  }
  const std::string played = write_log("played.lcmlog", some_events());
  testing::run_program(
      "export LCM_DEFAULT_URL=\"udpm://239.255.76.67:7667?ttl=0&recv_buf_size=2097152\"; " +
      network + "lcm-logger -q " + path("recorded.lcmlog") +
      " & logger=$!; sleep 1; lcm-logplayer " + played +
      "; sleep 0.5; kill -INT $logger; wait $logger'");
  const testing::ProgramRun check = run_on("check", "recorded.lcmlog");
  EXPECT_EQ(check.status, 0) << check.text;
  EXPECT_THAT(run_on("info", "recorded.lcmlog").text,
              ContainsRegex("RGBD_FRAME +geomap.rgbd_frame_t +60 .* 0\n"));
}

}  // namespace
}  // namespace geomap::logs
