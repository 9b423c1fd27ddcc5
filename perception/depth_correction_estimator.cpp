// SPDX-License-Identifier: BSD-3-Clause
#include "perception/depth_correction_estimator.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "perception/registration_weight.hpp"

namespace geomap::perception {
namespace {

constexpr int kStep = 2;  // between the pixels that are compared
constexpr int kLeastMeasurements = 100;
constexpr double kLeastCosine = 0.87;  // between the normals of a pair: 30 degrees
constexpr double kGate = 0.08;         // distance along the normal of a pair [m]

using Vector6 = Eigen::Matrix<double, 6, 1>;
constexpr int kTerms = geometry::DepthCorrection::kTerms;

// Normal equations over (relative pose, coefficients).
struct PairSums {
  Eigen::Matrix<double, 6, 6> pose = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, kTerms> cross = Eigen::Matrix<double, 6, kTerms>::Zero();
  Eigen::Matrix<double, kTerms, kTerms> terms = Eigen::Matrix<double, kTerms, kTerms>::Zero();
  Vector6 pose_vector = Vector6::Zero();
  geometry::DepthCorrection::Terms terms_vector = geometry::DepthCorrection::Terms::Zero();
  int count = 0;

  void add(double weight, const Vector6& j, const geometry::DepthCorrection::Terms& k,
           double residual) {
    pose.noalias() += weight * j * j.transpose();
    cross.noalias() += weight * j * k.transpose();
    terms.noalias() += weight * k * k.transpose();
    pose_vector += weight * residual * j;
    terms_vector += weight * residual * k;
    ++count;
  }
};

geometry::DepthCorrection::Terms terms_at(const Eigen::Vector3d& p) {
  return geometry::DepthCorrection::terms(p.x() / p.z(), p.y() / p.z());
}

}  // namespace

std::vector<std::string> DepthCorrectionConfig::validate() const {
  std::vector<std::string> errors;
  if (!(sigma > 0.0) || !(sigma <= 0.1)) errors.push_back("sigma must be above 0, at most 0.1");
  if (!(linear_sigma > 0.0) || !(linear_sigma <= 0.1)) {
    errors.push_back("linear_sigma must be above 0, at most 0.1");
  }
  if (!(least_change >= 0.0)) errors.push_back("least_change must not be negative");
  if (!(refresh_change >= 0.0)) errors.push_back("refresh_change must not be negative");
  if (refresh_count < 0) errors.push_back("refresh_count must not be negative");
  if (!(correlation >= 1.0)) errors.push_back("correlation must be at least 1");
  return errors;
}

DepthCorrectionEstimator::DepthCorrectionEstimator(const DepthCorrectionConfig& config)
    : config_(config) {
  const auto errors = config.validate();
  if (!errors.empty()) throw std::invalid_argument("depth correction: " + errors.front());
}

int DepthCorrectionEstimator::add(const View& view_a, const View& view_b) {
  const SurfaceImage &a = view_a.surfaces, &b = view_b.surfaces;
  const Eigen::Isometry3d T_b_a = view_b.T_world_camera.inverse() * view_a.T_world_camera;
  PairSums sums;
  for (int v = 0; v < a.height(); v += kStep) {
    for (int u = 0; u < a.width(); u += kStep) {
      const SurfacePixel& from = a.at(u, v);
      if (!from.valid()) continue;
      const Eigen::Vector3d p = T_b_a * from.point;
      const SurfacePixel* onto = b.seen_at(p);
      if (onto == nullptr) continue;
      const Eigen::Vector3d& n = onto->normal;
      if (n.dot(T_b_a.linear() * from.normal) < kLeastCosine) continue;
      const auto on_surface = onto->on_ray_of(p);
      if (!on_surface) continue;
      // e = n·(p_a + h_a t_a·c - p_b - h_b t_b·c): t the terms, h = n·p.
      const double e = n.dot(p - *on_surface);
      if (std::abs(e) > kGate) continue;
      const Terms k_b = n.dot(*on_surface) * terms_at(*on_surface);
      const Terms k_a = n.dot(T_b_a.linear() * from.point) * terms_at(from.point);
      Vector6 j;
      j << n, p.cross(n);
      sums.add(registration_weight(std::max(p.z(), from.point.z()), e), j, k_b - k_a,
               e + k_b.dot(view_b.applied.coefficients()) - k_a.dot(view_a.applied.coefficients()));
    }
  }
  if (sums.count < kLeastMeasurements) return 0;
  const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> pose(
      sums.pose + 1e-9 * sums.pose.trace() * Eigen::Matrix<double, 6, 6>::Identity());
  information_ +=
      (sums.terms - sums.cross.transpose() * pose.solve(sums.cross)) / config_.correlation;
  vector_ += (sums.terms_vector - sums.cross.transpose() * pose.solve(sums.pose_vector)) /
             config_.correlation;
  return sums.count;
}

DepthCorrectionEstimator::Information DepthCorrectionEstimator::posterior() const {
  Terms prior = Terms::Constant(1.0 / (config_.sigma * config_.sigma));
  prior.head<geometry::DepthCorrection::kLinearTerms>().setConstant(
      1.0 / (config_.linear_sigma * config_.linear_sigma));
  Information total = information_;
  total.diagonal() += prior;
  return total;
}

double DepthCorrectionEstimator::largest_sigma(const geometry::CameraModel& camera) const {
  constexpr int kSamples = 9;  // along each axis
  const auto total = posterior().ldlt();
  double largest = 0.0;
  for (int row = 0; row < kSamples; ++row) {
    for (int column = 0; column < kSamples; ++column) {
      const Eigen::Vector3d ray = camera.ray(column * (camera.width - 1.0) / (kSamples - 1),
                                             row * (camera.height - 1.0) / (kSamples - 1));
      const Terms terms = geometry::DepthCorrection::terms(ray.x(), ray.y());
      largest = std::max(largest, std::sqrt(terms.dot(total.solve(terms))));
    }
  }
  return largest;
}

geometry::DepthCorrection DepthCorrectionEstimator::estimate() const {
  return geometry::DepthCorrection(posterior().ldlt().solve(vector_));
}

}  // namespace geomap::perception
