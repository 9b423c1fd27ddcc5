// SPDX-License-Identifier: BSD-3-Clause
#include "logs/map_evaluation_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "geometry/angles.hpp"
#include "mapping/export_features.hpp"

namespace geomap::logs {
namespace {

using geometry::degrees;

/// A number in fixed notation, or a dash where there is none.
std::string fixed(std::optional<double> value, int digits, double scale = 1.0) {
  return value ? fmt::format("{:.{}f}", scale * *value, digits) : "-";
}

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

/// Figures of the paper (Arbeiter et al. 2012): simulated without noise, with sigma of
/// 5 and 20 mm, with clutter; two real recordings. It does not print every one.
struct PaperFigures {
  const char* angle;
  const char* dist;
  const char* rms_p;
  const char* reduction;
};
constexpr PaperFigures kPaper = {
    "0.0067 | 0.0057 | 0.058 | 0.0056 | 0.069 | 0.066",
    "7.1 | 19.8 | 137 | 8.4 | 102 | 102",
    "5.4 | 24.6 | 21.1 | 4.8 | 42.1 | 31.7",
    "16.14 | | 7.0 | | | ",
};
constexpr const char* kNoPaper = " | | | | | ";

std::string headline_table(const MapEvaluationRun& run) {
  const MapEvaluation& e = run.evaluation;
  const bool beside_paper = !run.against_map;
  std::string text =
      beside_paper
          ? "| | this map | paper: simulated | 5 mm noise | 20 mm noise | clutter | real 1 "
            "| real 2 |\n|---|--:|--:|--:|--:|--:|--:|--:|\n"
          : "| | this map |\n|---|--:|\n";
  const auto row = [&](const char* name, const std::string& value, const char* paper = kNoPaper) {
    text += fmt::format("| {} | {} |", name, value);
    text += beside_paper ? fmt::format(" {} |\n", paper) : "\n";
  };
  row("d_coeff", fixed(measure(e.errors, &PlaneErrors::coeff), 4));
  row("d_angle [rad]", fixed(measure(e.errors, &PlaneErrors::angle), 4), kPaper.angle);
  row("d_dist [mm]", fixed(measure(e.errors, &PlaneErrors::dist), 1, 1e3), kPaper.dist);
  row("d_dist_local [mm]", fixed(measure(e.errors, &PlaneErrors::dist_local), 1, 1e3));
  row("RMS_p [mm]", fixed(measure(e.errors, &PlaneErrors::rms_p), 1, 1e3), kPaper.rms_p);
  row("recall", fixed(e.recall, 3));
  row("precision", fixed(e.precision, 3));
  row("features per visible component", fixed(e.features_per_component, 2));
  row("area IoU", fixed(e.area_iou, 3));
  row("outline: mean distance [cm]",
      e.hull_distance ? fixed(e.hull_distance->mean, 1, 100.0) : "-");
  row("outline: largest distance [cm]",
      e.hull_distance ? fixed(e.hull_distance->max, 1, 100.0) : "-");
  row("planes extracted for each feature", fixed(run.reduction_ratio(), 2), kPaper.reduction);
  return text;
}

std::string plane_row(const SurfaceEvaluation& plane) {
  const auto hull = plane.hull_distance;
  return fmt::format(
      "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", cell(plane.name),
      plane.features, plane.components ? std::to_string(*plane.components) : "-",
      fixed(measure(plane.errors, &PlaneErrors::angle), 2, degrees(1.0)),
      fixed(measure(plane.errors, &PlaneErrors::dist_local), 1, 1e3),
      fixed(measure(plane.errors, &PlaneErrors::dist), 1, 1e3),
      fixed(measure(plane.errors, &PlaneErrors::rms_p), 1, 1e3), fixed(plane.visible_area, 2),
      fixed(plane.map_area, 2), fixed(plane.area_iou(), 3),
      hull ? fixed(hull->mean, 1, 100.0) : "-", hull ? fixed(hull->max, 1, 100.0) : "-");
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
      e.features_associated, e.features_counted, fixed(e.recall, 3), fixed(e.precision, 3),
      fixed(measure(e.errors, &PlaneErrors::angle), 2, degrees(1.0)),
      fixed(measure(e.errors, &PlaneErrors::dist_local), 1, 1e3),
      fixed(measure(e.errors, &PlaneErrors::dist), 1, 1e3),
      fixed(measure(e.errors, &PlaneErrors::rms_p), 1, 1e3), fixed(e.area_iou, 3),
      fixed(e.features_per_component, 2), fixed(run.reduction_ratio(), 2));
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
