// SPDX-License-Identifier: BSD-3-Clause
#include "logs/evaluation_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "logs/evaluation_bounds.hpp"
#include "logs/evaluation_costs.hpp"
#include "logs/evaluation_headline.hpp"
#include "logs/evaluation_page_json.hpp"
#include "logs/evaluation_plots.hpp"
#include "logs/evaluation_tables.hpp"
#include "mapping/export_file.hpp"

namespace geomap::logs {
namespace {

namespace fs = std::filesystem;

void add_heading(Document& page, const std::string& text) {
  page.blocks.push_back(Heading{2, text});
}

void add_text(Document& page, const std::string& text) { page.blocks.push_back(Paragraph{text}); }

void add_table(Document& page, Table table) {
  if (!table.rows.empty()) page.blocks.push_back(std::move(table));
}

std::string bounds_text(std::span<const BoundResult> bounds) {
  const auto met = std::count_if(bounds.begin(), bounds.end(), [](const auto& b) { return b.met; });
  return fmt::format("{} of {} bounds are met by the worst seed with merging by moments.", met,
                     bounds.size());
}

void add_summary(Document& page, const RunCollection& collection, std::span<const RunGroup> groups,
                 std::span<const BoundResult> bounds) {
  add_heading(page, "At a glance");
  add_text(page, fmt::format(
                     "{} runs. Means over seeds, with the least and the greatest beside them; "
                     "bold where better than the paper's. A run is named by its extractor and its "
                     "merging: by moments, or by the paper's equations.",
                     collection.runs.size()));
  add_table(page, headline_table(groups));
  if (!bounds.empty()) add_text(page, bounds_text(bounds));
}

void add_accuracy(Document& page, std::span<const RunGroup> groups) {
  Table accuracy = accuracy_table(groups);
  if (!accuracy.rows.empty()) {
    add_heading(page, "Table 1: accuracy of the map");
    add_text(page,
             "Errors of the map's features against the true planes. The paper measures "
             "distances at the world's origin; local is where the planes are. The kinect set "
             "stands in for the paper's robot.");
    add_table(page, std::move(accuracy));
  }
  Table further = further_sets_table(groups);
  if (!further.rows.empty()) {
    add_heading(page, "Accuracy in other scenes");
    add_table(page, std::move(further));
  }
  add_heading(page, "What the paper does not measure");
  add_text(page,
           "Recall: true planes found. Precision: features that are true. Features per "
           "component: 1 is neither torn nor doubled. Area IoU: with what the camera saw. "
           "Outline: distance between the outlines.");
  add_table(page, coverage_table(groups));
}

void add_planes(Document& page, std::span<const RunGroup> groups) {
  bool first = true;
  for (const char* set : {"kinect", "redkitchen"}) {
    for (const RunGroup* group : groups_of(groups, set)) {
      if (!group->uses_moments() || planes_of(*group).empty()) continue;
      if (first) {
        add_heading(page, "Tables 2 and 3: plane by plane");
        add_text(page,
                 "The paper's robot saw seven planes labelled by hand; its means are given. Its "
                 "text analyses real_2, while the caption of its Table 3 says real_1.");
      }
      first = false;
      add_table(page, plane_table(*group));
    }
  }
}

void add_costs(Document& page, std::span<const RunGroup> groups) {
  if (const auto timed = first_groups_of(groups, {"turn360", "n0"}); !timed.empty()) {
    add_heading(page, "Table 4: time per key frame");
    add_text(page, fmt::format("Runs: {}. The paper's figures are from an i7 at 2.8 GHz.",
                               set_title(timed.front()->set)));
    add_table(page, time_table(timed));
  }
  if (const auto reduced = first_groups_of(groups, {"n0", "turn360"}); !reduced.empty()) {
    add_heading(page, "Table 5: data reduction");
    add_text(page,
             fmt::format("Runs: {}; shares are of the raw data.", set_title(reduced.front()->set)));
    add_table(page, reduction_table(reduced));
  }
}

void add_figures(Document& page, std::span<const RunGroup> groups) {
  Gallery growth;
  for (const char* set : {"n0", "n02"}) {
    const auto of_set = groups_of(groups, set);
    if (of_set.empty()) continue;
    for (auto& picture : {growth_picture(of_set), reduction_picture(of_set)}) {
      if (picture) growth.pictures.push_back(*picture);
    }
  }
  if (!growth.pictures.empty()) {
    add_heading(page, "Figure 6: growth of the map");
    page.blocks.push_back(std::move(growth));
  }
  Gallery noise;
  for (const char* key : {"d_angle", "d_dist"}) {
    if (auto picture = noise_picture(groups, figure_kind(key))) noise.pictures.push_back(*picture);
  }
  if (!noise.pictures.empty()) {
    add_heading(page, "Error and noise");
    page.blocks.push_back(std::move(noise));
  }
}

std::string read_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error(fmt::format("{}: cannot be read", file.string()));
  return {std::istreambuf_iterator<char>(stream), {}};
}

void add_maps(Document& page, std::span<const RunGroup> groups) {
  Gallery maps;
  maps.wide = true;
  for (const char* set : {"n0", "n02"}) {
    const RunGroup* group = moments_group_of(groups, {set});
    if (!group) continue;
    const Run& run = *group->runs.front();
    const fs::path file = run.folder / "map.svg";
    if (!fs::exists(file)) continue;
    maps.pictures.push_back(
        {fmt::format("map_{}.svg", set), read_text(file),
         fmt::format("Map: {}, {}, {}.", set_title(set), run.variant, run.seed)});
  }
  if (maps.pictures.empty()) return;
  add_heading(page, "Maps");
  page.blocks.push_back(std::move(maps));
}

void add_shortcomings(Document& page, const RunCollection& collection,
                      std::span<const BoundResult> bounds) {
  if (!bounds.empty()) {
    add_heading(page, "Bounds, and what falls short of them");
    add_text(page, bounds_text(bounds));
    add_table(page, bounds_table(bounds));
  }
  if (collection.missing.empty()) return;
  add_heading(page, "Missing");
  add_text(page, "Unfinished runs, left out above, lack these files.");
  Table table;
  table.columns = {{"file", false}};
  for (const std::string& file : collection.missing)
    table.rows.push_back({{{file}}, RowKind::kPlain});
  add_table(page, std::move(table));
}

// Every table and figure of the paper with ours beside it.
Document evaluation_document(const RunCollection& collection, std::span<const RunGroup> groups,
                             std::span<const BoundResult> bounds) {
  Document page;
  page.title = "geomap beside the paper";
  add_summary(page, collection, groups, bounds);
  add_accuracy(page, groups);
  add_planes(page, groups);
  add_costs(page, groups);
  add_figures(page, groups);
  add_maps(page, groups);
  add_shortcomings(page, collection, bounds);
  return page;
}

}  // namespace

EvaluationPageSummary write_evaluation_page(const fs::path& runs, const fs::path& folder) {
  const RunCollection collection = read_runs(runs);
  const std::vector<RunGroup> groups = group_runs(collection);
  const std::vector<BoundResult> bounds = check_bounds(groups);
  const Document page = evaluation_document(collection, groups, bounds);
  fs::create_directories(folder / "pictures");
  for (const Picture* picture : pictures_of(page)) {
    mapping::write_file(folder / "pictures" / picture->name, picture->svg);
  }
  mapping::write_file(folder / "evaluation.html", to_html(page));
  mapping::write_file(folder / "evaluation.md", to_markdown(page));
  mapping::write_file(folder / "benchmark.md", tables_markdown(page));
  mapping::write_file(folder / "evaluation.json", evaluation_page_json(collection, groups, bounds));
  const auto missed =
      std::count_if(bounds.begin(), bounds.end(), [](const auto& b) { return !b.met; });
  return {collection.runs.size(), collection.missing.size(), bounds.size(),
          static_cast<std::size_t>(missed)};
}

}  // namespace geomap::logs
