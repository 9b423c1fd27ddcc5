// SPDX-License-Identifier: BSD-3-Clause
#include "perception/organized_extractor.hpp"

#include <utility>

#include "geometry/angles.hpp"
#include "perception/extract_surfaces.hpp"
#include "perception/grow_regions.hpp"
#include "perception/region_outline.hpp"

namespace geomap::perception {
namespace {

// A camera's noise is alike in neighbouring pixels and comes in steps: the normals of single cells,
// not averaged over voxels, scatter by so much more of the allowed angle.
constexpr double kNormalScatter = 0.4;
constexpr double kMergeScatter = 0.25;

double scattered(double degrees, double more, const DepthTolerance& tolerance) {
  return geometry::radians(degrees) * (1.0 + more * tolerance.camera_share());
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
  ExtractionSteps steps;
  steps.max_normal_angle = [this](const DepthTolerance& tolerance) {
    return scattered(config_.max_normal_angle_deg, kNormalScatter, tolerance);
  };
  steps.find_regions = [&](const DepthCells& cells, const std::vector<CellNormal>& normals,
                           const DepthTolerance& tolerance) {
    return grow_regions(cells, normals, tolerance, steps.max_normal_angle(tolerance),
                        scattered(config_.max_merge_angle_deg, kMergeScatter, tolerance));
  };
  steps.outline = [&](const PlanePixels&, std::vector<FoundPart>& found,
                      std::vector<std::int16_t>& label) {
    outline_parts(frame, {config_.simplify_tolerance, config_.max_hole_area}, label, found);
  };
  return extract_surfaces(config_, frame, up_camera, steps);
}

}  // namespace geomap::perception
