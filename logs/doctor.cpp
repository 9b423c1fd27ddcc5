// SPDX-License-Identifier: BSD-3-Clause
#include "logs/doctor.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "geomap/health_t.hpp"
#include "messaging/bus.hpp"
#include "messaging/channels.hpp"
#include "messaging/program.hpp"
#include "messaging/safe_decode.hpp"

namespace geomap::logs {
namespace {

using Level = Finding::Level;
using Clock = messaging::Inbox::Clock;

constexpr long kGoodBuffer = 2'097'152;       // holds several frames [byte]
constexpr std::size_t kFrameBytes = 300'000;  // a larger one than a Kinect's
constexpr int kFrames = 30;

template <typename Number>
Number number_of(const std::string& text, const std::string& name) {
  Number value{};
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size()) {
    throw std::invalid_argument("LCM URL: " + name + " is '" + text + "', which is no number");
  }
  return value;
}

long read_setting(const std::filesystem::path& file) {
  long value = 0;
  std::ifstream(file) >> value;
  return value;
}

// The interface through which packets to the group leave, by the longest matching entry of the
// system's table of routes; empty without a route.
std::string interface_to(const std::string& group) {
  in_addr address{};
  if (inet_pton(AF_INET, group.c_str(), &address) != 1) return {};
  std::ifstream table("/proc/net/route");
  std::string line, best;
  std::uint32_t best_mask = 0;
  std::getline(table, line);  // the names of the columns
  while (std::getline(table, line)) {
    std::istringstream columns(line);
    std::string interface, gateway, flags, references, use, metric;
    std::uint32_t destination = 0, mask = 0;  // in the order of bytes that inet_pton gives
    columns >> interface >> std::hex >> destination >> gateway >> flags >> references >> use >>
        metric >> mask;
    const bool is_longer = best.empty() || ntohl(mask) > best_mask;
    if (columns && (address.s_addr & mask) == destination && is_longer) {
      best = interface;
      best_mask = ntohl(mask);
    }
  }
  return best;
}

bool is_installed(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::stringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (access((folder + "/" + program).c_str(), X_OK) == 0) return true;
  }
  return false;
}

}  // namespace

MulticastUrl parse_multicast_url(const std::string& url) {
  const std::string scheme = "udpm://";
  if (!url.starts_with(scheme)) {
    throw std::invalid_argument("only udpm:// URLs can be examined, not " + url);
  }
  MulticastUrl parsed;
  const std::size_t question = std::min(url.find('?'), url.size());
  const std::string address = url.substr(scheme.size(), question - scheme.size());
  const std::size_t colon = std::min(address.find(':'), address.size());
  if (colon > 0) parsed.group = address.substr(0, colon);
  if (colon < address.size()) parsed.port = number_of<int>(address.substr(colon + 1), "port");
  std::stringstream options(url.substr(std::min(question + 1, url.size())));
  for (std::string option; std::getline(options, option, '&');) {
    const std::size_t equals = std::min(option.find('='), option.size());
    const std::string name = option.substr(0, equals);
    const std::string value = option.substr(std::min(equals + 1, option.size()));
    if (name == "ttl") parsed.ttl = number_of<int>(value, name);
    if (name == "recv_buf_size") parsed.receive_buffer = number_of<long>(value, name);
  }
  return parsed;
}

std::vector<Finding> check_route(const MulticastUrl& url) {
  const std::string interface = interface_to(url.group);
  if (interface.empty()) {
    return {{Level::kFault, "no route to the multicast group " + url.group + ": LCM cannot start",
             "sudo ip link set lo up; sudo ip route add 224.0.0.0/4 dev lo   # one machine"}};
  }
  std::vector<Finding> findings = {
      {Level::kGood, fmt::format("route to {} through {}", url.group, interface), {}}};
  if (url.ttl > 0) {
    findings.push_back(
        {Level::kNote,
         fmt::format("ttl={}: everything that is published leaves through {}", url.ttl, interface),
         "use ttl=0 for what only this machine needs, frames above all"});
  } else if (interface != "lo") {
    findings.push_back({Level::kNote,
                        "ttl=0 keeps messages on this machine as long as the route does not change "
                        "(VPN, cable)",
                        "sudo ip route add " + url.group + "/32 dev lo   # pins it"});
  }
  return findings;
}

std::vector<Finding> check_buffers(const MulticastUrl& url, const std::filesystem::path& settings) {
  std::vector<Finding> findings;
  const long most = read_setting(settings / "core" / "rmem_max");
  const long by_default = read_setting(settings / "core" / "rmem_default");
  const long granted = url.receive_buffer > 0 ? std::min(url.receive_buffer, most) : by_default;
  if (granted >= kGoodBuffer) {
    findings.push_back({Level::kGood, fmt::format("receive buffer of {} bytes", granted), {}});
  } else if (url.receive_buffer >= kGoodBuffer) {
    findings.push_back({Level::kFault,
                        fmt::format("the system grants a receive buffer of {} bytes only: frames "
                                    "will be lost",
                                    most),
                        fmt::format("sudo sysctl -w net.core.rmem_max={}", kGoodBuffer)});
  } else {
    findings.push_back(
        {Level::kFault,
         fmt::format("receive buffer of {} bytes: most frames above 200 kB will be lost", granted),
         fmt::format("export LCM_DEFAULT_URL='{}'", messaging::kDefaultLcmUrl)});
  }
  const long fragments = read_setting(settings / "ipv4" / "ipfrag_high_thresh");
  constexpr long kGoodFragments = 134'217'728;
  if (url.ttl > 0 && fragments < kGoodFragments) {
    findings.push_back(
        {Level::kNote, "on a link that loses packets, half received messages block later ones",
         fmt::format("sudo sysctl -w net.ipv4.ipfrag_time=2 net.ipv4.ipfrag_high_thresh={}",
                     kGoodFragments)});
  }
  return findings;
}

std::vector<Finding> check_loop(const std::string& url) {
  const std::string channel = "GEOMAP_DOCTOR";
  messaging::Bus bus({url, "", true});
  bus.subscribe(channel, messaging::Keep::kEvery);
  bus.start();
  const std::vector<std::uint8_t> frame(kFrameBytes, 1);
  int received = 0;
  for (int i = 0; i < kFrames; ++i) {
    bus.publish_bytes(channel, frame);
    if (bus.take(Clock::now() + std::chrono::milliseconds(33))) ++received;
  }
  while (bus.take(Clock::now() + std::chrono::milliseconds(300))) ++received;
  const std::string what =
      fmt::format("{} of {} messages of {} kB came back", received, kFrames, kFrameBytes / 1000);
  if (received == kFrames) return {{Level::kGood, what, {}}};
  return {{Level::kFault, what, "see the findings above; a firewall may also drop multicast"}};
}

std::vector<Finding> check_processes(const std::string& url, const std::string& channel_prefix) {
  messaging::Bus bus({url, channel_prefix, false});
  bus.subscribe(messaging::channels::kHealth, messaging::Keep::kEvery);
  bus.start();
  std::map<std::string, geomap::health_t> heard;
  const auto end = Clock::now() + std::chrono::milliseconds(1500);
  while (const auto message = bus.take(end)) {
    auto health =
        messaging::safe_decode<geomap::health_t>(message->data.data(), message->data.size());
    if (health.message) heard[health.message->process] = *health.message;
  }
  std::vector<Finding> findings;
  for (const auto& [process, health] : heard) {
    const bool is_good = health.level == geomap::health_t::GOOD;
    findings.push_back({is_good ? Level::kGood : Level::kFault,
                        is_good ? process + " is well" : process + ": " + health.message,
                        {}});
  }
  if (findings.empty()) {
    findings.push_back({Level::kNote, "no geomap process is heard", "scripts/up --help"});
  }
  return findings;
}

std::vector<Finding> check_tools() {
  std::vector<Finding> findings;
  for (const char* program : {"lcm-logger", "lcm-logplayer"}) {
    if (is_installed(program)) continue;
    findings.push_back({Level::kFault, std::string(program) + " is not installed",
                        "sudo apt-get install liblcm-bin"});
  }
  if (!std::filesystem::exists("/usr/share/java/lcm.jar")) {
    findings.push_back({Level::kNote,
                        "LCM's Java library is not installed: no tcpq, only geomap-spy --text",
                        "sudo apt-get install liblcm-java libjchart2d-java default-jre"});
  }
  if (findings.empty()) findings.push_back({Level::kGood, "LCM's programs are installed", {}});
  return findings;
}

std::string to_string(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& finding : findings) {
    const char* level = finding.level == Level::kGood   ? "good "
                        : finding.level == Level::kNote ? "note "
                                                        : "FAULT";
    text += fmt::format("{}  {}\n", level, finding.what);
    if (!finding.remedy.empty()) text += fmt::format("         {}\n", finding.remedy);
  }
  return text;
}

}  // namespace geomap::logs
