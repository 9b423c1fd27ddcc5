// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace geomap::logs {

/// @brief One thing that was looked at.
struct Finding {
  enum class Level { kGood, kNote, kFault };
  Level level = Level::kGood;
  std::string what;    // was found
  std::string remedy;  // the command that mends it; empty where nothing is to be done
};

/// @brief What is to be known of an LCM URL of multicast: udpm://GROUP:PORT?ttl=N&recv_buf_size=N
struct MulticastUrl {
  std::string group = "239.255.76.67";
  int port = 7667;
  int ttl = 0;
  long receive_buffer = 0;  // [byte]; 0: the system's default
};

/// @brief Reads a URL; missing parts are LCM's defaults. @throws std::invalid_argument for another
/// scheme, or a number that is none.
MulticastUrl parse_multicast_url(const std::string& url);

/// @brief Can messages leave, and how far? @return the route, and what the ttl means on it.
std::vector<Finding> check_route(const MulticastUrl& url);

/// @brief Do frames fit the receive buffers? @param settings usually /proc/sys/net.
std::vector<Finding> check_buffers(const MulticastUrl& url, const std::filesystem::path& settings);

/// @brief Publishes messages of a frame's size and counts those that come back.
std::vector<Finding> check_loop(const std::string& url);

/// @brief Which geomap processes are heard, and how they fare.
std::vector<Finding> check_processes(const std::string& url, const std::string& channel_prefix);

/// @brief Which programs of LCM are installed.
std::vector<Finding> check_tools();

/// @brief For people, a line each, with the remedy below.
std::string to_string(const std::vector<Finding>& findings);

}  // namespace geomap::logs
