// SPDX-License-Identifier: BSD-3-Clause
// Registration: accuracy and time beside PCL, time by stage, time in a growing map.
#include "registration_bench.hpp"

#include <charconv>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace {

using geomap::bench::RegistrationBenchSettings;

constexpr const char* kUsage =
    "registration_bench [pairs|profile|growth] [--seeds N] [--pcl-seeds N] [--step N]\n"
    "                   [--set KEY=VALUE]...\n"
    "  pairs    kitchen frames --step apart from a pose 5 cm and 3 degrees off, beside PCL\n"
    "  profile  time of a key frame by stage\n"
    "  growth   the same view against maps of 1, 10 and 100 rooms\n"
    "  --set    a number of the sections registration, point_map, keyframes, depth_correction\n"
    "Without a name all three are run. The kitchen is looked for under GEOMAP_DATA.\n";

template <typename Value>
bool parse(std::string_view text, Value& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

void set(RegistrationBenchSettings& settings, std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  bool done = false;
  const auto visitor = [&](std::string_view key, auto& member) {
    using Member = std::remove_reference_t<decltype(member)>;
    if constexpr (std::is_arithmetic_v<Member> && !std::is_same_v<Member, bool>) {
      if (equals == std::string_view::npos || key != assignment.substr(0, equals)) return;
      done = parse(assignment.substr(equals + 1), member);
    }
  };
  auto& tracker = settings.tracker;
  std::remove_reference_t<decltype(tracker.registration)>::visit(tracker.registration, visitor);
  std::remove_reference_t<decltype(tracker.point_map)>::visit(tracker.point_map, visitor);
  std::remove_reference_t<decltype(tracker.keyframes)>::visit(tracker.keyframes, visitor);
  std::remove_reference_t<decltype(tracker.depth_correction)>::visit(tracker.depth_correction,
                                                                     visitor);
  if (!done) throw std::invalid_argument("cannot set " + std::string(assignment));
}

// @return what is to be run; empty: everything.
std::string read_arguments(int argc, char** argv, RegistrationBenchSettings& settings) {
  std::string part;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const auto value = [&]() -> std::string_view { return ++i < argc ? argv[i] : ""; };
    const auto number = [&](int& member) {
      if (!parse(value(), member) || member < 0) throw std::invalid_argument(argument);
    };
    if (argument == "--seeds") {
      number(settings.seeds);
    } else if (argument == "--pcl-seeds") {
      number(settings.pcl_seeds);
    } else if (argument == "--step") {
      number(settings.step);
    } else if (argument == "--set") {
      set(settings, value());
    } else if (argument == "pairs" || argument == "profile" || argument == "growth") {
      part = argument;
    } else {
      throw std::invalid_argument("unknown argument " + argument);
    }
  }
  if (settings.step == 0) throw std::invalid_argument("--step 0");
  return part;
}

}  // namespace

int main(int argc, char** argv) {
  RegistrationBenchSettings settings;
  try {
    const std::string part = read_arguments(argc, argv, settings);
    if (part.empty() || part == "pairs") bench_pairs(settings);
    if (part.empty() || part == "profile") bench_profile(settings);
    if (part.empty() || part == "growth") bench_growth(settings);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n%s", error.what(), kUsage);
    return 2;
  }
  return 0;
}
