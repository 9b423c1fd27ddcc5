// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "perception/extraction_config.hpp"
#include "perception/plane_extractor.hpp"

namespace geomap::perception {

/// @brief Settings of OrganizedExtractor.
struct OrganizedExtractorConfig : ExtractionConfig {
  double max_hole_area = 0.0025;  // holes below it are filled [m²]

  std::vector<std::string> validate() const;

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& visitor) {
    ExtractionConfig::visit(self, visitor);
    visitor("max_hole_area", self.max_hole_area);
  }
};

/// @brief Planes and outlines from the image grid: sums of cells in one pass over the depth image,
/// regions grown and joined over neighbouring cells on these sums, pixels decided where regions
/// end, outlines with holes traced on the label image.
///
/// Nothing is random: the seed is not used. Pixels without a reading in small holes of a plane are
/// labelled like what surrounds them.
class OrganizedExtractor : public PlaneExtractor {
 public:
  using Config = OrganizedExtractorConfig;

  /// @throws std::invalid_argument with all messages of config.validate().
  explicit OrganizedExtractor(OrganizedExtractorConfig config = {});

  /// @throws std::invalid_argument as ExtractionConfig::require_valid. An empty depth image has no
  /// planes.
  ExtractedPlanes extract(const geometry::RgbdFrame& frame, std::uint64_t seed,
                          const std::optional<Eigen::Vector3d>& up_camera) const override;

 private:
  OrganizedExtractorConfig config_;
};

}  // namespace geomap::perception
