// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "perception/extraction_config.hpp"
#include "perception/plane_extractor.hpp"

namespace geomap::perception {

/// @brief Settings of RansacExtractor.
struct RansacExtractorConfig : ExtractionConfig {
  double voxel_size = 0.04;         // [m], growing with depth where pixels become sparse
  double cluster_tolerance = 0.06;  // [m], growing likewise
  int min_cluster_voxels = 8;
  int ransac_iterations = 300;  // at most, per plane
  double alpha = 0.06;          // of the concave hull: largest circumscribed circle, radius [m]

  std::vector<std::string> validate() const;

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& visitor) {
    ExtractionConfig::visit(self, visitor);
    visitor("voxel_size", self.voxel_size);
    visitor("cluster_tolerance", self.cluster_tolerance);
    visitor("min_cluster_voxels", self.min_cluster_voxels);
    visitor("ransac_iterations", self.ransac_iterations);
    visitor("alpha", self.alpha);
  }
};

/// @brief The paper's plane extraction (Arbeiter et al. 2012): voxel filter, Euclidean clusters,
/// RANSAC planes until nothing is left, concave hull by alpha shape.
///
/// Mended where the paper's recipe hurts: tolerances follow the depth noise; a plane's points must
/// agree in their normals; planes are fitted to all pixels, weighted by noise, not to voxels; a
/// plane whose hull has several rings is kept with its holes and parts; inliers far apart become
/// separate planes.
class RansacExtractor : public PlaneExtractor {
 public:
  using Config = RansacExtractorConfig;

  /// @throws std::invalid_argument with all messages of config.validate().
  explicit RansacExtractor(RansacExtractorConfig config = {});

  /// @throws std::invalid_argument as ExtractionConfig::require_valid. An empty depth image has no
  /// planes.
  ExtractedPlanes extract(const geometry::RgbdFrame& frame, std::uint64_t seed,
                          const std::optional<Eigen::Vector3d>& up_camera) const override;

 private:
  RansacExtractorConfig config_;
};

}  // namespace geomap::perception
