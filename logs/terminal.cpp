// SPDX-License-Identifier: BSD-3-Clause
#include "logs/terminal.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <sstream>
#include <vector>

namespace geomap::logs {
namespace {

constexpr const char* kHome = "\x1b[H";
constexpr const char* kClearLine = "\x1b[K";
constexpr const char* kClearBelow = "\x1b[J";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

}  // namespace

std::string repaint(const std::string& text, std::size_t columns, std::size_t rows) {
  std::vector<std::string> lines = lines_of(text);
  const std::size_t room = rows > 2 ? rows - 1 : 1;  // the cursor stands in the last row
  if (lines.size() > room) {
    const std::size_t hidden = lines.size() - room + 1;
    lines.resize(room);
    lines.back() = fmt::format(".. {} more lines: a larger window shows them", hidden);
  }
  std::string painted = kHome;
  for (const std::string& line : lines) painted += line.substr(0, columns) + kClearLine + "\n";
  return painted + kClearBelow;
}

void show(const std::string& text) {
  winsize size{};
  const bool is_terminal = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  fmt::print("{}", is_terminal ? repaint(text, size.ws_col, size.ws_row) : text + "\n");
  std::fflush(stdout);
}

}  // namespace geomap::logs
