// SPDX-License-Identifier: BSD-3-Clause
#include "logs/map_evaluation_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "geometry/angles.hpp"
#include "logs/number_text.hpp"
#include "logs/paper_results.hpp"
#include "mapping/export_features.hpp"

namespace geomap::logs {
namespace {

using geometry::degrees;

std::optional<double> measure(const std::optional<PlaneErrors>& errors,
                              double PlaneErrors::*member) {
  return errors ? std::optional((*errors).*member) : std::nullopt;
}

std::string name_of(const std::string& file) {
  return mapping::clean_text(std::filesystem::path(file).filename().string());
}

/// A text fit for a cell of a table.
std::string cell(const std::string& text) {
  std::string result;
  for (const char c : mapping::clean_text(text)) result += c == '|' ? "\\|" : std::string(1, c);
  return result;
}

/// A figure of each of the paper's rows as cells, with the unit and digits of ours beside it.
template <typename Figure>
std::string paper_cells(Figure PaperAccuracy::*figure, double scale, int decimals) {
  std::string cells;
  for (const PaperAccuracy& row : paper_accuracy()) {
    cells += fmt::format(" {} |", number_text(row.*figure, scale, decimals));
  }
  return cells;
}

std::string headline_table(const MapEvaluationRun& run) {
  const MapEvaluation& e = run.evaluation;
  const bool beside_paper = !run.against_map;
  std::string text =
      beside_paper
          ? "| | this map | paper: simulated | 5 mm noise | 20 mm noise | clutter | real 1 "
            "| real 2 |\n|---|--:|--:|--:|--:|--:|--:|--:|\n"
          : "| | this map |\n|---|--:|\n";
  std::string dashes;
  for (std::size_t i = 0; i < paper_accuracy().size(); ++i) dashes += " - |";
  const auto row = [&](const char* name, const std::string& value,
                       std::optional<std::string> paper = {}) {
    text += fmt::format("| {} | {} |{}\n", name, value, beside_paper ? paper.value_or(dashes) : "");
  };
  row("d_coeff", number_text(measure(e.errors, &PlaneErrors::coeff), 1.0, 4));
  row("d_angle [rad]", number_text(measure(e.errors, &PlaneErrors::angle), 1.0, 4),
      paper_cells(&PaperAccuracy::d_angle, 1.0, 4));
  row("d_dist [mm]", number_text(measure(e.errors, &PlaneErrors::dist), 1e3, 1),
      paper_cells(&PaperAccuracy::d_dist, 1e3, 1));
  row("d_dist_local [mm]", number_text(measure(e.errors, &PlaneErrors::dist_local), 1e3, 1));
  row("RMS_p [mm]", number_text(measure(e.errors, &PlaneErrors::rms_p), 1e3, 1),
      paper_cells(&PaperAccuracy::rms_p, 1e3, 1));
  row("recall", number_text(e.recall, 1.0, 3));
  row("precision", number_text(e.precision, 1.0, 3));
  row("features per visible component", number_text(e.features_per_component, 1.0, 2));
  row("area IoU", number_text(e.area_iou, 1.0, 3));
  row("outline: mean distance [cm]",
      e.hull_distance ? number_text(e.hull_distance->mean, 100.0, 1) : "-");
  row("outline: largest distance [cm]",
      e.hull_distance ? number_text(e.hull_distance->max, 100.0, 1) : "-");
  row("planes extracted for each feature", number_text(run.reduction_ratio(), 1.0, 2),
      paper_cells(&PaperAccuracy::reduction, 1.0, 2));
  return text;
}

std::string plane_row(const SurfaceEvaluation& plane) {
  const auto hull = plane.hull_distance;
  return fmt::format(
      "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", cell(plane.name),
      plane.features, plane.components ? std::to_string(*plane.components) : "-",
      number_text(measure(plane.errors, &PlaneErrors::angle), degrees(1.0), 2),
      number_text(measure(plane.errors, &PlaneErrors::dist_local), 1e3, 1),
      number_text(measure(plane.errors, &PlaneErrors::dist), 1e3, 1),
      number_text(measure(plane.errors, &PlaneErrors::rms_p), 1e3, 1),
      number_text(plane.visible_area, 1.0, 2), number_text(plane.map_area, 1.0, 2),
      number_text(plane.area_iou(), 1.0, 3), hull ? number_text(hull->mean, 100.0, 1) : "-",
      hull ? number_text(hull->max, 100.0, 1) : "-");
}

std::string plane_table(const std::vector<SurfaceEvaluation>& planes) {
  std::string text =
      "| plane | features | visible parts | angle [°] | d_dist_local [mm] | d_dist [mm] | RMS_p "
      "[mm] | visible [m²] | mapped [m²] | area IoU | outline: mean [cm] | max [cm] |\n"
      "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";
  for (const SurfaceEvaluation& plane : planes) {
    if (plane.seen) text += plane_row(plane);
  }
  const auto unseen = std::count_if(planes.begin(), planes.end(),
                                    [](const SurfaceEvaluation& plane) { return !plane.seen; });
  if (unseen > 0) text += fmt::format("\nPlanes that could not be seen: {}.\n", unseen);
  return text;
}

std::string false_features(const std::vector<FalseFeature>& features) {
  if (features.empty()) return "None.\n";
  std::string text = "| feature | area [m²] |\n|---|--:|\n";
  for (const FalseFeature& feature : features) {
    text += fmt::format("| {} | {:.3f} |\n", to_string(feature.id), feature.area);
  }
  return text;
}

}  // namespace

std::string summary_text(const MapEvaluationRun& run) {
  const MapEvaluation& e = run.evaluation;
  return fmt::format(
      "map: {} of {} features belong to a known surface; recall {}, precision {}\n"
      "planes, on average: {}° and {} mm off, {} mm at the world's origin; vertices {} mm\n"
      "area IoU {}, {} features for each visible part, {} planes extracted for each feature\n",
      e.features_associated, e.features_counted, number_text(e.recall, 1.0, 3),
      number_text(e.precision, 1.0, 3),
      number_text(measure(e.errors, &PlaneErrors::angle), degrees(1.0), 2),
      number_text(measure(e.errors, &PlaneErrors::dist_local), 1e3, 1),
      number_text(measure(e.errors, &PlaneErrors::dist), 1e3, 1),
      number_text(measure(e.errors, &PlaneErrors::rms_p), 1e3, 1), number_text(e.area_iou, 1.0, 3),
      number_text(e.features_per_component, 1.0, 2), number_text(run.reduction_ratio(), 1.0, 2));
}

std::string report_text(const MapEvaluationRun& run) {
  const MapEvaluation& e = run.evaluation;
  std::string text = fmt::format(
      "# Map {} against {}\n\n{} of {} features (at least 0.02 m²) belong to a known surface.\n\n"
      "{}\nErrors are means over these features: d_coeff of all four coefficients, d_dist at the "
      "world's origin, d_dist_local where feature and surface overlap, RMS_p of the outlines' "
      "vertices.",
      name_of(run.map), name_of(run.reference), e.features_associated, e.features_counted,
      headline_table(run));
  if (!run.against_map) text += " The paper's figures are of its own scenes.";
  text += "\n\n## Planes\n\n" + plane_table(e.planes);
  if (e.false_features) text += "\n## False features\n\n" + false_features(*e.false_features);
  return text;
}

}  // namespace geomap::logs
