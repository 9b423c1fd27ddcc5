// SPDX-License-Identifier: BSD-3-Clause
// geomap-doctor: what keeps a system from working, and the command that mends it.
#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "logs/doctor.hpp"
#include "messaging/program.hpp"

namespace {

using namespace geomap;

int run(const messaging::CommonOptions& common) {
  std::vector<logs::Finding> all;
  const auto add = [&all](const std::vector<logs::Finding>& more) {
    std::printf("%s", logs::to_string(more).c_str());
    std::fflush(stdout);
    all.insert(all.end(), more.begin(), more.end());
  };
  const auto has_fault = [&all] {
    return std::any_of(all.begin(), all.end(), [](const logs::Finding& finding) {
      return finding.level == logs::Finding::Level::kFault;
    });
  };
  std::printf("%s\n", common.lcm_url.c_str());
  add(logs::check_tools());
  if (common.lcm_url.starts_with("udpm:")) {
    const logs::MulticastUrl url = logs::parse_multicast_url(common.lcm_url);
    add(logs::check_route(url));
    if (has_fault()) return 1;  // nothing else can be tried
    add(logs::check_buffers(url, "/proc/sys/net"));
  }
  add(logs::check_loop(common.lcm_url));
  add(logs::check_processes(common.lcm_url, common.channel_prefix));
  return has_fault() ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-doctor",
       .description = "Looks for what keeps a system from working, route, buffers, ttl, loop and "
                      "processes, and prints the command that mends it. Ends with 1 when a fault "
                      "was found.",
       .uses_lcm = true,
       .uses_config = false},
      [](messaging::OptionParser&) {}, run);
}
