// SPDX-License-Identifier: BSD-3-Clause
#include "perception/ransac_extractor.hpp"

namespace geomap::perception {

std::vector<std::string> RansacExtractorConfig::validate() const {
  ConfigChecks check;
  check.messages = ExtractionConfig::validate();
  check.between("voxel_size", voxel_size, 0.005, 0.5);
  check.between("cluster_tolerance", cluster_tolerance, 0.005, 1.0);
  check.between("min_cluster_voxels", min_cluster_voxels, 3, 1e6);
  check.between("ransac_iterations", ransac_iterations, 1, 1e6);
  check.between("alpha", alpha, 0.01, 1.0);
  return check.messages;
}

}  // namespace geomap::perception
