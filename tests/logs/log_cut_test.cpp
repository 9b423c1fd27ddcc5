// SPDX-License-Identifier: BSD-3-Clause
// geomap-log cut as its user sees it.
#include <filesystem>
#include <tuple>

#include "logs/log_tool_fixture.hpp"

namespace geomap::logs {
namespace {

using messaging::LogEvent;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

class LogToolCut : public LogTool {
 protected:
  void SetUp() override { log_ = write_log("log.lcmlog", some_events()); }

  testing::ProgramRun cut(const std::string& options) {
    return run("cut " + log_ + " " + path("part.lcmlog") + " " + options);
  }
  std::string part(const std::string& options) {
    const testing::ProgramRun result = cut(options);
    EXPECT_EQ(result.status, 0) << result.text;
    return read_file(path("part.lcmlog"));
  }
  std::vector<LogEvent> events_of(const std::string& options) {
    part(options);
    return read_log(path("part.lcmlog"));
  }

  std::string log_;
};

TEST_F(LogToolCut, WithoutLimitsIsTheLog) { EXPECT_EQ(part(""), read_file(log_)); }

TEST_F(LogToolCut, AMomentBelongsToThePartThatItBegins) {
  // 333330 us is exactly the tenth frame's time after the first event.
  const std::string before = part("--to 0.33333");
  const std::string behind = part("--from 0.33333");
  EXPECT_EQ(before + behind, read_file(log_));
  EXPECT_EQ(events_of("--from 0.33333").front().log_utime, 1'000'333'330);
  EXPECT_EQ(part("--to-utime 1000333330"), before);
  EXPECT_EQ(part("--from-utime 1000333330"), behind);
  EXPECT_EQ(events_of("--from 0.33333 --to-utime 1000333331").size(), 3U);
}

TEST_F(LogToolCut, ChannelsAreChosenByTheirWholeName) {
  for (const LogEvent& event : events_of("--channels 'POSE|RGBD.*'")) {
    EXPECT_THAT(event.channel, ::testing::AnyOf("POSE", "RGBD_FRAME"));
  }
  EXPECT_EQ(events_of("--channels 'POSE|RGBD.*' --not-channels '.*FRAME'").size(), 60U);
  EXPECT_EQ(events_of("--not-channels POS").size(), 181U);
}

TEST_F(LogToolCut, KeepsEventsWhoseTimeGoesBackIntoTheRange) {
  std::vector<LogEvent> events = some_events();
  events.back().log_utime = events.front().log_utime;
  log_ = write_log("back.lcmlog", events);
  EXPECT_EQ(events_of("--to 0.01").size(), 5U);
}

TEST_F(LogToolCut, WishesThatMakeNoSenseAreSaidAndNothingIsWritten) {
  for (const auto& [options, status, reason] :
       std::vector<std::tuple<const char*, int, const char*>>{
           {"--from 2 --to 1", 2, "ends before it begins"},
           {"--from 1 --from-utime 5", 2, "exclude each other"},
           {"--from nan", 2, "--from"},
           {"--channels '('", 2, "no regular expression"},
           {"--channels NOBODY", 1, "no event is left"},
           {"--from 1e300", 1, "no event is left"}}) {
    const testing::ProgramRun result = cut(options);
    EXPECT_EQ(result.status, status) << options;
    EXPECT_THAT(result.text, AllOf(HasSubstr(reason), ContainsRegex("^geomap-log: [^\n]*\n$")));
    EXPECT_FALSE(std::filesystem::exists(path("part.lcmlog")));
    EXPECT_FALSE(std::filesystem::exists(path("part.lcmlog.part")));
  }
}

TEST_F(LogToolCut, TheLogItselfIsNeverOverwritten) {
  namespace fs = std::filesystem;
  const std::string before = read_file(log_);
  fs::create_symlink(log_, path("link.lcmlog"));
  fs::create_hard_link(log_, path("hard.lcmlog"));
  fs::create_hard_link(log_, path("new.lcmlog.part"));
  for (const char* out :
       {"log.lcmlog", "link.lcmlog", "hard.lcmlog", "new.lcmlog", "./log.lcmlog"}) {
    for (const std::string command : {"cut ", "repair "}) {
      const testing::ProgramRun result = run(command + log_ + " " + path(out));
      EXPECT_EQ(result.status, 2) << out;
      EXPECT_THAT(result.text, HasSubstr("choose another name"));
      EXPECT_EQ(read_file(log_), before);
    }
  }
}

TEST_F(LogToolCut, AnOlderOutputStaysWhenTheNewOneFails) {
  write_file("part.lcmlog", "older");
  cut("--channels NOBODY");
  EXPECT_EQ(read_file(path("part.lcmlog")), "older");
}

}  // namespace
}  // namespace geomap::logs
