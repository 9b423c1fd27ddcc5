// SPDX-License-Identifier: BSD-3-Clause
#include "support/architecture.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string_view>

namespace geomap::testing {
namespace {

namespace fs = std::filesystem;

/// Folders whose headers a folder may include besides its own. What is not listed is forbidden, so
/// the rule leaves no cycle between folders. messaging/ is governed by the rule on LCM.
const std::map<std::string, std::set<std::string>> kMayInclude = {
    {"geometry", {}},
    {"messaging", {"geometry"}},
    {"drivers", {"geometry", "messaging"}},
    {"perception", {"geometry", "messaging"}},
    {"mapping", {"geometry", "messaging"}},
    {"viewer", {"geometry", "messaging", "mapping"}},
    {"logs", {"geometry", "messaging", "drivers", "perception", "mapping"}},
    {"bench",
     {"geometry", "messaging", "drivers", "perception", "mapping", "logs", "support", "viewer"}},
    {"tests",
     {"geometry", "messaging", "drivers", "perception", "mapping", "viewer", "logs", "support"}},
};

constexpr std::array<std::string_view, 5> kGlueSuffixes = {"_process", "_messages", "_client",
                                                           "_journal", "_main"};
const std::set<std::string> kGlueFolders = {"messaging", "logs", "bench", "tests"};
const std::set<std::string> kLcmFolders = {"lcm", "lcmtypes", "geomap", "bot_core", "kinect"};
const std::set<std::string> kHeavyFolders = {"pcl",    "CGAL",     "CLI",
                                             "spdlog", "nlohmann", "yaml-cpp"};

struct Include {
  int line = 0;
  std::string path;
  std::string folder() const { return path.substr(0, path.find('/')); }
};

struct Source {
  std::string path;  // from the root, with '/'
  bool has_spdx = false;
  bool has_pragma_once = false;
  std::vector<Include> includes;

  std::string folder() const { return path.substr(0, path.find('/')); }
  bool is_header() const { return path.ends_with(".hpp"); }
};

/// True for the files that may know LCM: processes, message conversion, clients, journals, mains.
bool is_glue(const std::string& path) {
  if (kGlueFolders.contains(path.substr(0, path.find('/')))) return true;
  const std::string stem = fs::path(path).stem().string();
  return std::any_of(kGlueSuffixes.begin(), kGlueSuffixes.end(),
                     [&](std::string_view suffix) { return stem.ends_with(suffix); });
}

Source read_source(const fs::path& root, const fs::path& file) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"].*)");
  Source source;
  source.path = file.lexically_relative(root).generic_string();
  std::ifstream in(file);
  std::string line;
  std::smatch match;
  for (int number = 1; std::getline(in, line); ++number) {
    if (number == 1) source.has_spdx = line == "// SPDX-License-Identifier: BSD-3-Clause";
    if (line == "#pragma once") source.has_pragma_once = true;
    if (std::regex_match(line, match, kInclude)) source.includes.push_back({number, match[1]});
  }
  return source;
}

std::vector<Source> read_sources(const fs::path& root) {
  std::vector<fs::path> files;
  for (const auto& [folder, allowed] : kMayInclude) {
    if (!fs::is_directory(root / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const auto extension = entry.path().extension();
      if (extension == ".hpp" || extension == ".cpp") files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  std::vector<Source> sources;
  for (const fs::path& file : files) sources.push_back(read_source(root, file));
  return sources;
}

/// What is wrong with one include, or nothing.
std::string fault_of(const Source& source, const Include& include) {
  const std::string folder = include.folder();
  if (source.is_header() && kHeavyFolders.contains(folder)) {
    return "a header must not include <" + include.path + ">: only .cpp files pay for it";
  }
  if (!is_glue(source.path)) {
    const bool lcm = kLcmFolders.contains(folder) || folder == "messaging";
    if (lcm) {
      return "only processes, messages, clients, journals, mains, logs/ and bench/ may know LCM";
    }
    if (kMayInclude.contains(folder) && is_glue(include.path)) {
      return "an algorithm must not include " + include.path + ", which knows LCM";
    }
  }
  const bool ours = kMayInclude.contains(folder) || folder == "support";
  if (ours && folder != source.folder() && !kMayInclude.at(source.folder()).contains(folder)) {
    return source.folder() + "/ must not include " + folder + "/";
  }
  return "";
}

/// Depth-first search for a file that includes itself by way of others.
class CycleSearch {
 public:
  explicit CycleSearch(const std::vector<Source>& sources) {
    for (const Source& source : sources) sources_[source.path] = &source;
  }

  std::vector<std::string> find() {
    for (const auto& [path, source] : sources_) visit(path);
    return cycles_;
  }

 private:
  enum class State { kNew, kOpen, kDone };

  void visit(const std::string& path) {
    State& state = states_[path];
    if (state != State::kNew) return;
    state = State::kOpen;
    for (const Include& include : sources_.at(path)->includes) {
      if (!sources_.contains(include.path)) continue;
      if (states_[include.path] == State::kOpen) {
        cycles_.push_back(path + ":" + std::to_string(include.line) +
                          ": a cycle of includes through " + include.path);
      }
      visit(include.path);
    }
    states_[path] = State::kDone;
  }

  std::map<std::string, const Source*> sources_;
  std::map<std::string, State> states_;
  std::vector<std::string> cycles_;
};

}  // namespace

std::vector<std::string> architecture_breaches(const fs::path& root) {
  const std::vector<Source> sources = read_sources(root);
  std::vector<std::string> breaches;
  for (const Source& source : sources) {
    if (!source.has_spdx) breaches.push_back(source.path + ":1: no SPDX line");
    if (source.is_header() && !source.has_pragma_once) {
      breaches.push_back(source.path + ":1: no #pragma once");
    }
    for (const Include& include : source.includes) {
      const std::string fault = fault_of(source, include);
      if (fault.empty()) continue;
      breaches.push_back(source.path + ":" + std::to_string(include.line) + ": " + fault);
    }
  }
  const auto cycles = CycleSearch(sources).find();
  breaches.insert(breaches.end(), cycles.begin(), cycles.end());
  return breaches;
}

}  // namespace geomap::testing
