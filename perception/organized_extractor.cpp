// SPDX-License-Identifier: BSD-3-Clause
#include "perception/organized_extractor.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "geometry/angles.hpp"
#include "perception/grow_regions.hpp"
#include "perception/pixel_labels.hpp"
#include "perception/plane_observation.hpp"
#include "perception/plane_parts.hpp"
#include "perception/plane_pixels.hpp"
#include "perception/region_outline.hpp"

namespace geomap::perception {
namespace {

using geometry::PlaneObservation;
using geometry::radians;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// A camera's noise is alike in neighbouring pixels and comes in steps: the normals of single cells,
// not averaged over voxels, scatter by so much more of the allowed angle.
constexpr double kNormalScatter = 0.4;
constexpr double kMergeScatter = 0.25;

double scattered(double degrees, double more, const DepthTolerance& tolerance) {
  return radians(degrees) * (1.0 + more * tolerance.camera_share());
}

// Outlines of the surfaces, and what is still worth reporting with them.
std::vector<FoundPart> outline(const OrganizedExtractorConfig& config,
                               const geometry::RgbdFrame& frame, std::vector<FoundPart> found,
                               std::vector<std::int16_t>& label) {
  std::vector<geometry::PlanarPolygon> surfaces;
  for (const FoundPart& f : found) {
    surfaces.push_back(f.observation.surface);
  }
  outline_regions(frame, {config.simplify_tolerance, config.max_hole_area}, label, surfaces);
  std::vector<std::int16_t> number(found.size(), kNoPlane);
  std::vector<FoundPart> kept;
  for (std::size_t i = 0; i < found.size(); ++i) {
    found[i].observation.surface.polygon = std::move(surfaces[i].polygon);
    if (!covers_enough(frame.depth_camera, found[i].observation, found[i].part, config)) continue;
    number[i] = static_cast<std::int16_t>(kept.size());
    kept.push_back(std::move(found[i]));
  }
  for (std::int16_t& l : label) {
    if (l >= 0) l = number[static_cast<std::size_t>(l)];
  }
  return kept;
}

}  // namespace

std::vector<std::string> OrganizedExtractorConfig::validate() const {
  ConfigChecks check;
  check.messages = ExtractionConfig::validate();
  check.between("max_hole_area", max_hole_area, 0.0, 1.0);
  return check.messages;
}

OrganizedExtractor::OrganizedExtractor(OrganizedExtractorConfig config)
    : config_(std::move(config)) {
  require_no_faults("organized extractor", config_.validate());
}

ExtractedPlanes OrganizedExtractor::extract(const geometry::RgbdFrame& frame, std::uint64_t,
                                            const std::optional<Eigen::Vector3d>& up_camera) const {
  config_.require_valid(frame, up_camera);
  ExtractedPlanes result;
  if (frame.depth.empty()) return result;

  const Clock::time_point start = Clock::now();
  const DepthCells cells(frame.depth, frame.depth_camera, config_.min_depth, config_.max_depth);
  const DepthTolerance tolerance = config_.tolerance_of(cells);
  const double max_normal_angle =
      scattered(config_.max_normal_angle_deg, kNormalScatter, tolerance);
  const auto normals = estimate_normals(cells, frame.depth_camera, tolerance);
  const CellRegions regions =
      grow_regions(cells, normals, tolerance, max_normal_angle,
                   scattered(config_.max_merge_angle_deg, kMergeScatter, tolerance));
  const PixelLabeler labeler(frame, cells, normals, tolerance, config_.min_depth, config_.max_depth,
                             max_normal_angle);
  const PlanePixels pixels = collect_pixels(
      frame, cells, labeler.label(regions.planes, regions.cell_label), regions.planes.size());
  std::vector<FoundPart> found =
      find_parts(config_, frame, cells, tolerance, regions.planes, pixels, up_camera);
  result.noise = tolerance.noise;
  result.extraction_seconds = seconds_since(start);

  const Clock::time_point hull_start = Clock::now();
  result.label = label_parts(found, pixels.label, frame.depth.width);
  for (FoundPart& f : outline(config_, frame, std::move(found), result.label)) {
    result.planes.push_back(std::move(f.observation));
  }
  result.hull_seconds = seconds_since(hull_start);
  return result;
}

}  // namespace geomap::perception
