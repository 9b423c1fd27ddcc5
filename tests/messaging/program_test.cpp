// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace geomap::messaging {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::internal::CaptureStderr;
using ::testing::internal::CaptureStdout;
using ::testing::internal::GetCapturedStderr;
using ::testing::internal::GetCapturedStdout;

/// Runs a program as a shell would and keeps what it prints.
class Program : public ::testing::Test {
 protected:
  int run(
      std::vector<const char*> arguments,
      const std::function<int(const CommonOptions&)>& body = [](const auto&) { return 0; }) {
    arguments.insert(arguments.begin(), info_.name.c_str());
    CaptureStdout();
    CaptureStderr();
    const int code =
        run_program(static_cast<int>(arguments.size()), arguments.data(), info_, declare_, body);
    out_ = GetCapturedStdout();
    err_ = GetCapturedStderr();
    return code;
  }

  ProgramInfo info_{"geomap-test", "Tests options.", true, true};
  std::function<void(OptionParser&)> declare_ = [](OptionParser&) {};
  std::string out_;
  std::string err_;
};

TEST_F(Program, ReturnsWhatItsBodyReturns) {
  EXPECT_EQ(run({}, [](const auto&) { return 0; }), 0);
  EXPECT_EQ(run({}, [](const auto&) { return 1; }), 1);
  EXPECT_EQ(err_, "");
}

TEST_F(Program, ReadsTheCommonOptions) {
  CommonOptions common;
  const auto keep = [&](const CommonOptions& options) {
    common = options;
    return 0;
  };
  EXPECT_EQ(run({"--set", "driver_camera.depth.fx=600", "--set", "driver_camera.depth.fy=601", "-l",
                 "memq://", "--channel-prefix", "robot1/"},
                keep),
            0);
  EXPECT_EQ(common.config.get<double>("driver_camera.depth.fx"), 600.0);
  EXPECT_EQ(common.config.get<double>("driver_camera.depth.fy"), 601.0);
  EXPECT_EQ(common.lcm_url, "memq://");
  EXPECT_EQ(common.channel_prefix, "robot1/");
}

TEST_F(Program, TakesTheTransportFromTheEnvironmentOrTheBuiltInDefault) {
  std::string url;
  const auto keep = [&](const CommonOptions& options) {
    url = options.lcm_url;
    return 0;
  };
  unsetenv("LCM_DEFAULT_URL");
  run({}, keep);
  EXPECT_THAT(url, AllOf(HasSubstr("ttl=0"), HasSubstr("recv_buf_size=")));
  setenv("LCM_DEFAULT_URL", "memq://", 1);
  run({}, keep);
  EXPECT_EQ(url, "memq://");
  unsetenv("LCM_DEFAULT_URL");
}

TEST_F(Program, ShowsOnlyTheOptionsThatItHas) {
  EXPECT_EQ(run({"--help"}), 0);
  EXPECT_THAT(out_, AllOf(HasSubstr("Tests options."), HasSubstr("--lcm-url"), HasSubstr("--set")));
  info_.uses_lcm = false;
  info_.uses_config = false;
  EXPECT_EQ(run({"-h"}), 0);
  EXPECT_THAT(out_, AllOf(Not(HasSubstr("--lcm-url")), Not(HasSubstr("--set"))));
  EXPECT_EQ(run({"-l", "memq://"}), 2);
}

TEST_F(Program, PrintsItsVersion) {
  EXPECT_EQ(run({"--version"}), 0);
  EXPECT_EQ(out_, "geomap-test " + version() + "\n");
}

TEST_F(Program, SaysInOneLineWhatWentWrong) {
  EXPECT_EQ(run({}, [](const auto&) -> int { throw std::runtime_error("the log is empty"); }), 1);
  EXPECT_EQ(err_, "geomap-test: the log is empty\n");
}

TEST_F(Program, CallsWrongSettingsAndOptionsWrongUsage) {
  EXPECT_EQ(run({"--set", "no.such.key=1"}), 2);
  EXPECT_THAT(err_, AllOf(HasSubstr("geomap-test: "), HasSubstr("'no.such.key'")));
  EXPECT_EQ(run({"--no-such-option"}), 2);
  EXPECT_THAT(err_, AllOf(HasSubstr("geomap-test: "), HasSubstr("--no-such-option")));
  EXPECT_EQ(run({"-c", "/nowhere/at.all"}), 2);
}

TEST_F(Program, ReadsOptionsOfEveryKind) {
  std::string log;
  std::string out = "result";
  double rate = 1.5;
  int threads = 2;
  std::int64_t seed = 0;
  bool loud = false;
  std::string mode = "slow";
  std::vector<double> up;
  std::vector<std::string> channels;
  declare_ = [&](OptionParser& options) {
    options.positional("LOG", log, "log to read");
    options.option("-o,--output", out, "folder");
    options.option("--rate", rate, "rate");
    options.option("--threads", threads, "threads");
    options.option("--seed", seed, "seed");
    options.option("--channel", channels, "channel");
    options.numbers("--up", up, 3, "direction");
    options.flag("--loud", loud, "loud");
    options.choice("--mode", mode, {"slow", "fast"}, "mode");
  };
  EXPECT_EQ(run({"--rate", "2.5", "a.lcmlog", "--threads=4", "--seed", "12345678901234", "--loud",
                 "--mode", "fast", "--up", "0,-1,0.5", "--channel", "A", "--channel", "B"}),
            0);
  EXPECT_EQ(log, "a.lcmlog");
  EXPECT_EQ(out, "result");
  EXPECT_EQ(rate, 2.5);
  EXPECT_EQ(threads, 4);
  EXPECT_EQ(seed, 12345678901234);
  EXPECT_TRUE(loud);
  EXPECT_EQ(mode, "fast");
  EXPECT_THAT(up, ElementsAre(0.0, -1.0, 0.5));
  EXPECT_THAT(channels, ElementsAre("A", "B"));

  EXPECT_EQ(run({}), 2);  // no LOG
  EXPECT_THAT(err_, HasSubstr("LOG"));
  EXPECT_EQ(run({"a.lcmlog", "--mode", "medium"}), 2);
  EXPECT_EQ(run({"a.lcmlog", "--rate", "quick"}), 2);
  EXPECT_EQ(run({"a.lcmlog", "--up", "1,2"}), 2);
  EXPECT_EQ(run({"a.lcmlog", "b.lcmlog"}), 2);
}

TEST_F(Program, RequiredOptionsMustBeGiven) {
  std::string out;
  declare_ = [&](OptionParser& options) { options.required("-o", out, "folder"); };
  EXPECT_EQ(run({}), 2);
  EXPECT_EQ(run({"-o", "here"}), 0);
  EXPECT_EQ(out, "here");
}

TEST_F(Program, TakesSeveralArgumentsOrNone) {
  std::vector<std::string> logs;
  std::string extra = "default";
  declare_ = [&](OptionParser& options) { options.positionals("LOGS", logs, "logs"); };
  EXPECT_EQ(run({"a", "b", "c"}), 0);
  EXPECT_THAT(logs, ElementsAre("a", "b", "c"));
  declare_ = [&](OptionParser& options) { options.optional_positional("EXTRA", extra, "extra"); };
  EXPECT_EQ(run({}), 0);
  EXPECT_EQ(extra, "default");
}

TEST_F(Program, CommandsHaveOptionsOfTheirOwn) {
  std::string command;
  std::string log;
  bool deep = false;
  declare_ = [&](OptionParser& options) {
    options.command("info", "What is in a log.", command,
                    [&](OptionParser& own) { own.positional("LOG", log, "log"); });
    options.command("check", "Is it whole.", command, [&](OptionParser& own) {
      own.positional("LOG", log, "log");
      own.flag("--deep", deep, "decode too");
    });
  };
  EXPECT_EQ(run({"check", "a.lcmlog", "--deep", "--set", "driver_camera.depth.fx=1"}), 0);
  EXPECT_EQ(command, "check");
  EXPECT_EQ(log, "a.lcmlog");
  EXPECT_TRUE(deep);
  EXPECT_EQ(run({"info", "a.lcmlog", "--deep"}), 2);
  EXPECT_EQ(run({}), 2);
  EXPECT_EQ(run({"cut"}), 2);
}

TEST_F(Program, ASignalAsksItToStop) {
  bool before = true;
  bool after = false;
  run({}, [&](const auto&) {
    before = stop_requested();
    std::raise(SIGINT);
    after = stop_requested();
    return 0;
  });
  EXPECT_FALSE(before);
  EXPECT_TRUE(after);
}

}  // namespace
}  // namespace geomap::messaging
