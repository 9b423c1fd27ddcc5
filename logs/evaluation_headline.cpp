// SPDX-License-Identifier: BSD-3-Clause
#include "logs/evaluation_headline.hpp"

#include <fmt/format.h>

#include <utility>

#include "logs/evaluation_bounds.hpp"
#include "logs/evaluation_cells.hpp"
#include "logs/evaluation_costs.hpp"
#include "logs/paper_results.hpp"

namespace geomap::logs {
namespace {

Row headline_row(const std::string& what, const std::string& paper, Cell ours, bool better) {
  ours.strong = better;
  return {{{what}, {paper}, std::move(ours)}, RowKind::kPlain};
}

}  // namespace

Table headline_table(std::span<const RunGroup> groups) {
  Table table;
  table.columns = {{"", false}, {"paper"}, {"geomap"}};
  for (const PaperAccuracy& paper : paper_accuracy()) {
    const RunGroup* group = moments_group_of(groups, {paper.set});
    if (!group || (paper.set != "n0" && paper.set != "n02")) continue;
    const auto add = [&](const char* key, const char* what, double theirs) {
      const FigureKind& kind = figure_kind(key);
      const auto ours = spread_of(*group, kind.member);
      table.rows.push_back(headline_row(fmt::format("{}, {}", set_title(group->set), what),
                                        number_text(theirs, kind.scale, kind.decimals),
                                        spread_cell(ours, kind), ours && ours->mean < theirs));
    };
    add("d_angle", "angle [rad]", paper.d_angle);
    add("d_dist", "distance [mm]", paper.d_dist);
    add("rms_p", "RMS_p [mm]", paper.rms_p);
  }
  if (const RunGroup* group = moments_group_of(groups, {"turn360", "n0"})) {
    const auto time = total_time(*group);
    const double theirs = PaperTimes{}.total;
    table.rows.push_back(headline_row("time per key frame [ms]", number_text(theirs, 1e3, 0),
                                      spread_cell(time, 1e3, 1), time && time->mean < theirs));
  }
  if (const RunGroup* group = moments_group_of(groups, {"n0", "turn360"})) {
    const PaperReduction paper;
    const double theirs = paper.map_bytes / paper.raw_bytes;
    const auto share = map_share(*group);
    table.rows.push_back(headline_row("map, share of the raw data [%]",
                                      number_text(theirs, 100.0, 4), spread_cell(share, 100.0, 4),
                                      share && share->mean < theirs));
  }
  return table;
}

}  // namespace geomap::logs
