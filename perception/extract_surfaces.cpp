// SPDX-License-Identifier: BSD-3-Clause
#include "perception/extract_surfaces.hpp"

#include <chrono>
#include <utility>

#include "perception/pixel_labels.hpp"

namespace geomap::perception {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// The planes that are large enough with their outlines; labels are numbered anew.
std::vector<geometry::PlaneObservation> take_covered(const ExtractionConfig& config,
                                                     const geometry::CameraModel& camera,
                                                     std::vector<FoundPart> found,
                                                     std::vector<std::int16_t>& label) {
  std::vector<geometry::PlaneObservation> planes;
  std::vector<std::int16_t> number(found.size() + 1, kNoPlane);  // kNoPlane keeps its own
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!covers_enough(camera, found[i].observation, found[i].part, config)) continue;
    number[i + 1] = static_cast<std::int16_t>(planes.size());
    planes.push_back(std::move(found[i].observation));
  }
  if (planes.size() == found.size()) return planes;
  static_assert(kNoPlane == -1);
  for (std::int16_t& l : label) l = number[static_cast<std::size_t>(l + 1)];
  return planes;
}

}  // namespace

ExtractedPlanes extract_surfaces(const ExtractionConfig& config, const geometry::RgbdFrame& frame,
                                 const std::optional<Eigen::Vector3d>& up_camera,
                                 const ExtractionSteps& steps) {
  config.require_valid(frame, up_camera);
  ExtractedPlanes result;
  if (frame.depth.empty()) return result;

  const Clock::time_point start = Clock::now();
  const geometry::CameraModel& camera = frame.depth_camera;
  const DepthCells cells(frame.depth, camera, config.min_depth, config.max_depth);
  const DepthTolerance tolerance = config.tolerance_of(cells);
  const std::vector<CellNormal> normals = estimate_normals(cells, camera, tolerance);
  const CellRegions regions = steps.find_regions(cells, normals, tolerance);
  const PlanePixels pixels = collect_pixels(
      frame, cells,
      label_pixels(frame, cells, normals, tolerance, regions,
                   {config.min_depth, config.max_depth, steps.max_normal_angle(tolerance)}),
      regions.planes.size());
  std::vector<FoundPart> found =
      find_parts(config, frame, cells, tolerance, regions.planes, pixels, up_camera);
  result.noise = tolerance.noise;
  result.extraction_seconds = seconds_since(start);

  const Clock::time_point hull_start = Clock::now();
  result.label = label_parts(found, pixels.label, frame.depth.width);
  steps.outline(pixels, found, result.label);
  result.planes = take_covered(config, camera, std::move(found), result.label);
  result.hull_seconds = seconds_since(hull_start);
  return result;
}

}  // namespace geomap::perception
