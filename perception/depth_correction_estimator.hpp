// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "geometry/depth_correction.hpp"
#include "perception/surface_image.hpp"

namespace geomap::perception {

struct DepthCorrectionConfig {
  bool enabled = true;
  double sigma = 0.004;         // expected size of the correction at the border, share of the depth
  double linear_sigma = 0.003;  // of its linear terms, which look almost like a turn of the camera
  double least_change = 0.001;  // below this, a new estimate is not applied
  // Key frames in the map get a better correction a few at a time, so that no frame waits.
  double refresh_change = 0.003;  // below this, a key frame is left as it is
  int refresh_count = 1;          // at most, with each new key frame
  double correlation = 80.0;      // measurements that say no more than one: neighbours err alike

  std::vector<std::string> validate() const;

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& visitor) {
    visitor("enabled", self.enabled);
    visitor("sigma", self.sigma);
    visitor("linear_sigma", self.linear_sigma);
    visitor("least_change", self.least_change);
    visitor("refresh_change", self.refresh_change);
    visitor("refresh_count", self.refresh_count);
    visitor("correlation", self.correlation);
  }
};

/// @brief Learns the camera's fixed depth error from pairs of views of the same surfaces.
///
/// A point of the world that two views see at different places of the image is off by different
/// shares of its depth. Their distance along the normal is linear in the polynomial's coefficients
/// and in the error of the views' relative pose; the pose is marginalised out (Schur complement),
/// so nothing depends on how well the views were aligned. Information of all pairs adds up, against
/// a zero-mean prior on the coefficients: what the data do not support stays zero. Deterministic.
class DepthCorrectionEstimator {
 public:
  /// @throws std::invalid_argument when the configuration is not valid.
  explicit DepthCorrectionEstimator(const DepthCorrectionConfig& config = {});

  /// @brief A view as it was aligned. `applied`: the correction its surfaces were made with.
  struct View {
    const SurfaceImage& surfaces;
    const Eigen::Isometry3d& T_world_camera;
    const geometry::DepthCorrection& applied;
  };

  /// @brief Adds what two views say.
  /// @return measurements used: 0 when the views share too little.
  int add(const View& a, const View& b);

  /// @brief The largest standard deviation of the correction over the image of a camera, a share of
  /// the depth: where nothing was seen that tells, it is that of the prior.
  double largest_sigma(const geometry::CameraModel& camera) const;

  /// @brief The most probable correction.
  geometry::DepthCorrection estimate() const;

 private:
  using Terms = geometry::DepthCorrection::Terms;
  using Information =
      Eigen::Matrix<double, geometry::DepthCorrection::kTerms, geometry::DepthCorrection::kTerms>;

  Information posterior() const;  // information of data and prior

  DepthCorrectionConfig config_;
  Information information_ = Information::Zero();
  Terms vector_ = Terms::Zero();  // information times coefficients
};

}  // namespace geomap::perception
