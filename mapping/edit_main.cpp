// SPDX-License-Identifier: BSD-3-Clause
// geomap-edit: the operator's commands from a shell.
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "geometry/angles.hpp"
#include "mapping/clean_text.hpp"
#include "mapping/edit_messages.hpp"
#include "mapping/edit_session_client.hpp"
#include "mapping/edit_text.hpp"
#include "mapping/feature_filter.hpp"
#include "mapping/local_time.hpp"
#include "mapping/operator_name.hpp"
#include "mapping/parse_number.hpp"
#include "messaging/program.hpp"

namespace {

using namespace geomap;
using mapping::clean_text;
using mapping::EditCommand;
using mapping::EditKind;
using mapping::FeatureId;
using mapping::ViewFeature;
using Features = std::map<FeatureId, ViewFeature>;
using Json = nlohmann::ordered_json;

// What the command line says.
struct Arguments {
  std::string command;
  std::vector<std::string> words;  // without a name: features, numbers, corners
  std::vector<double> translate = {0, 0, 0}, axis = {0, 0, 1}, about, from, to;
  double along_normal = 0.0, rotate_deg = 0.0, patience = 5.0;
  std::string map, out, author, label, where;
  bool is_json = false, is_dry_run = false;
};

std::int64_t whole_number(const std::string& text) {
  const auto number = mapping::parse_number<std::int64_t>(text);
  if (!number) throw std::invalid_argument("'" + text + "' is no number");
  return *number;
}

Eigen::Vector3d parse_corner(const std::string& text) {
  Eigen::Vector3d corner;
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  for (int i = 0; i < 3; ++i) {
    const auto [stop, error] = std::from_chars(at, end, corner[i]);
    const bool is_last = i == 2;
    if (error != std::errc() || (is_last ? stop != end : stop == end || *stop != ',')) {
      throw std::invalid_argument("'" + text + "' is no corner: write X,Y,Z in metres");
    }
    at = stop + 1;
  }
  return corner;
}

Eigen::Vector3d vector(const std::vector<double>& v) { return {v.at(0), v.at(1), v.at(2)}; }

// The motion of `move`: first turned about a point, then shifted.
Eigen::Isometry3d motion(const Arguments& arguments, const ViewFeature& first) {
  const mapping::FeatureFacts facts = mapping::facts_of(first);
  const Eigen::Vector3d about = arguments.about.empty() ? facts.centroid : vector(arguments.about);
  const Eigen::Vector3d axis = vector(arguments.axis);
  if (!(axis.norm() > 1e-6)) throw std::invalid_argument("--axis must not be zero");
  const Eigen::Vector3d normal = mapping::surface_of(first).plane.normal;
  return Eigen::Translation3d(vector(arguments.translate) + arguments.along_normal * normal) *
         Eigen::Translation3d(about) *
         Eigen::AngleAxisd(geometry::radians(arguments.rotate_deg), axis.normalized()) *
         Eigen::Translation3d(-about);
}

std::vector<FeatureId> find_features(const std::vector<std::string>& names,
                                     const Features& features) {
  std::vector<FeatureId> ids;
  for (const std::string& name : names) ids.push_back(mapping::find_feature(name, features));
  return ids;
}

std::vector<std::int64_t> parse_numbers(const std::vector<std::string>& words) {
  std::vector<std::int64_t> numbers;
  for (const std::string& word : words) numbers.push_back(whole_number(word));
  return numbers;
}

EditCommand command_of(const Arguments& arguments, const Features& features) {
  EditCommand command;
  command.utime = command.command = mapping::CommandNumbers().next();
  command.author = arguments.author;
  const std::vector<std::string>& words = arguments.words;
  const std::string& name = arguments.command;
  const auto targets = [&](EditKind kind) {
    command.kind = kind;
    command.targets = find_features(words, features);
  };
  const auto numbers = [&](EditKind kind) {
    command.kind = kind;
    command.edits = parse_numbers(words);
  };
  const auto corners = [&](std::size_t first) {
    for (std::size_t i = first; i < words.size(); ++i) {
      command.points.push_back(parse_corner(words[i]));
    }
  };
  if (name == "delete") targets(EditKind::kDelete);
  if (name == "merge") targets(EditKind::kMerge);
  if (name == "lock") targets(EditKind::kLock);
  if (name == "unlock") targets(EditKind::kUnlock);
  if (name == "restore") numbers(EditKind::kRestore);
  if (name == "undo") numbers(EditKind::kUndo);
  if (name == "redo") numbers(EditKind::kRedo);
  if (name == "move") {
    targets(EditKind::kMove);
    command.T_world_moved = motion(arguments, features.at(command.targets.front()));
  } else if (name == "label") {
    if (words.size() < 2) throw std::invalid_argument("label needs a feature and a text");
    command.kind = EditKind::kLabel;
    command.targets = find_features({words.begin(), words.end() - 1}, features);
    command.label = words.back();
  } else if (name == "split") {
    targets(EditKind::kSplit);
    if (arguments.from.empty() || arguments.to.empty()) {
      throw std::invalid_argument("split needs --from X,Y,Z and --to X,Y,Z");
    }
    command.points = {vector(arguments.from), vector(arguments.to)};
  } else if (name == "cut") {
    command.kind = EditKind::kCut;
    command.targets = find_features({words.front()}, features);
    corners(1);
  } else if (name == "add") {
    command.kind = EditKind::kAdd;
    command.label = arguments.label;
    corners(0);
  } else if (name == "drop-keyframe") {
    command.kind = EditKind::kDropKeyframe;
    command.keyframe = whole_number(words.front());
  }
  return command;
}

int print_history(const std::vector<geomap::map_edit_record_t>& records, bool is_json) {
  Json list = Json::array();
  for (const geomap::map_edit_record_t& record : records) {
    const std::string state = mapping::state_name(record);
    if (is_json) {
      Json vetoes = Json::array();
      for (const auto& veto : record.vetoes) {
        vetoes.push_back(mapping::to_string(FeatureId{veto.id.keyframe, veto.id.plane}));
      }
      list.push_back({{"number", record.number},
                      {"utime", record.edit_utime},
                      {"author", clean_text(record.author)},
                      {"text", clean_text(record.text)},
                      {"state", state},
                      {"reason", clean_text(record.reason)},
                      {"vetoes", std::move(vetoes)}});
      continue;
    }
    const std::string reason = clean_text(record.reason);
    fmt::print("{:>4}  {}  {:<8} {}  ({}){}\n", record.number,
               mapping::local_time(record.edit_utime, "%F %T"), state, clean_text(record.text),
               clean_text(record.author), reason.empty() ? "" : ": " + reason);
  }
  if (is_json) fmt::print("{}\n", list.dump(1));
  if (!is_json && records.empty()) fmt::print("no edits\n");
  return 0;
}

int run(Arguments arguments, const messaging::CommonOptions& common) {
  if (arguments.author.empty()) arguments.author = mapping::operator_name();
  const auto is_wanted = arguments.where.empty() ? [](const ViewFeature&) { return true; }
                                                 : mapping::parse_filter(arguments.where);
  const auto session =
      arguments.map.empty()
          ? mapping::edit_live(common.lcm_url, common.channel_prefix, arguments.patience)
          : mapping::edit_file(arguments.map,
                               arguments.out.empty() ? arguments.map : arguments.out);
  if (arguments.command == "history") return print_history(session->history(), arguments.is_json);
  const Features features = session->features();
  if (arguments.command == "list") {
    fmt::print("{}", arguments.is_json ? mapping::feature_json(features, is_wanted)
                                       : mapping::feature_table(features, is_wanted));
    return 0;
  }
  const geomap::map_edit_reply_t reply =
      session->edit(command_of(arguments, features), arguments.is_dry_run);
  if (arguments.is_json) {
    fmt::print("{}\n", Json{{"done", reply.done != 0},
                            {"edit", reply.edit},
                            {"after", reply.utime},
                            {"text", clean_text(reply.text)}}
                           .dump(1));
    return reply.done != 0 ? 0 : 1;
  }
  if (reply.done == 0) throw std::runtime_error(clean_text(reply.text));
  fmt::print("{}\n", clean_text(reply.text));
  return 0;
}

void declare(messaging::OptionParser& parser, Arguments& a) {
  using Declare = std::function<void(messaging::OptionParser&)>;
  const auto command = [&](const std::string& name, const std::string& help, const Declare& more) {
    parser.command(name, help, a.command, [&](messaging::OptionParser& p) {
      p.option("--map", a.map, "a saved map to edit, instead of a running mapper's");
      p.flag("--json", a.is_json, "for programs");
      p.option("--timeout", a.patience, "to wait for a mapper's answer [s]");
      more(p);
    });
  };
  const auto edit = [&](const std::string& name, const std::string& help, const Declare& more) {
    command(name, help, [&](messaging::OptionParser& p) {
      p.option("-o,--output", a.out, "where the edited --map is saved; by default over itself");
      p.flag("--dry-run", a.is_dry_run, "only say what it would do");
      p.option("--author", a.author, "who does it; by default user@host");
      more(p);
    });
  };
  const auto features = [&](messaging::OptionParser& p) {
    p.positionals("FEATURE", a.words, "number as in list, or id, or the end of an id");
  };
  const auto numbers = [&](messaging::OptionParser& p) {
    p.optional_positionals("EDIT", a.words, "numbers as in history");
  };
  command("list", "the features of the map", [&](messaging::OptionParser& p) {
    p.option("--where", a.where,
             "only some, for example 'area>0.5 and label=table'; fields: area, height, slope, "
             "observations, rms, held, label");
  });
  command("history", "all edits, and what has become of them", [](messaging::OptionParser&) {});
  edit("delete", "take features out and keep their surfaces out", features);
  edit("move", "move features and hold them there", [&](messaging::OptionParser& p) {
    p.numbers("--translate", a.translate, 3, "shift, world frame [m]");
    p.option("--along-normal", a.along_normal, "shift along the first feature's normal [m]");
    p.option("--rotate-deg", a.rotate_deg, "turn, before the shift");
    p.numbers("--axis", a.axis, 3, "of the turn, world frame");
    p.numbers("--about", a.about, 3,
              "point that the turn leaves alone; by default the first feature's centroid [m]");
    features(p);
  });
  edit("merge", "make one feature of several", features);
  edit("split", "cut a feature in two along a line", [&](messaging::OptionParser& p) {
    p.numbers("--from", a.from, 3, "a point of the line, world frame [m]");
    p.numbers("--to", a.to, 3, "another one [m]");
    features(p);
  });
  edit("cut", "take a polygon out of a feature and keep it out", [&](messaging::OptionParser& p) {
    p.positionals("FEATURE", a.words, "the feature, then the corners X,Y,Z in the world [m]");
  });
  edit("add", "put in a polygon drawn by hand", [&](messaging::OptionParser& p) {
    p.option("--label", a.label, "what it is");
    p.positionals("CORNER", a.words,
                  "X,Y,Z in the world [m], counter-clockwise as seen from the visible side");
  });
  edit("label", "say what features are: FEATURE... TEXT", [&](messaging::OptionParser& p) {
    p.positionals("FEATURE", a.words,
                  "features, then wall, floor, ceiling, table, door or what you like; '' for none");
  });
  edit("lock", "hold features as they are", features);
  edit("unlock", "let go of held features: they are again what is observed", features);
  edit("drop-keyframe", "take out everything that a key frame contributed",
       [&](messaging::OptionParser& p) {
         p.positionals("KEYFRAME", a.words, "its id: the number before the - of a feature's id");
       });
  edit("restore", "let surfaces come back that delete or cut keeps out", numbers);
  edit("undo", "make edits as if they had never been; by default the newest", numbers);
  edit("redo", "make undone edits again; by default the last undone", numbers);
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-edit",
       .description = "Corrects a geometric map: that of a running geomap-mapper, or a saved one.",
       .uses_lcm = true,
       .uses_config = false},
      [&](messaging::OptionParser& parser) { declare(parser, arguments); },
      [&](const messaging::CommonOptions& common) { return run(arguments, common); });
}
