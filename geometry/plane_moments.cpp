// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane_moments.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace geomap::geometry {
namespace {

// Points closer together than this across their second direction span no plane [m].
constexpr double kLeastExtent = 1e-5;

// Both triangles from the upper one: the sums stay symmetric to the last bit, so that 16 numbers
// hold all of them.
Eigen::Matrix3d symmetric(const Eigen::Matrix3d& m) { return m.selfadjointView<Eigen::Upper>(); }

// Largest share a of the noise term that leaves scatter - a·noise positive semi-definite, at
// most 1. a is the smallest generalised eigenvalue of (scatter, noise), found from the largest of
// (noise, scatter), whose right-hand side is made definite by a term far below any sensor's noise.
double noise_share(const Eigen::Matrix3d& scatter, const Eigen::Matrix3d& noise) {
  const Eigen::Matrix3d definite =
      scatter + (1e-12 * scatter.trace() + 1e-18) * Eigen::Matrix3d::Identity();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d> solver(noise, definite,
                                                                         Eigen::EigenvaluesOnly);
  const double largest = solver.eigenvalues()(2);
  return largest > 1.0 ? 1.0 / largest : 1.0;
}

}  // namespace

double PlaneFit::sigma_angle() const {
  return std::sqrt(std::max(covariance(0, 0), covariance(1, 1)));
}

double PlaneFit::sigma_offset(const Eigen::Vector3d& at) const {
  const Eigen::Vector3d arm = at - centroid;
  const Eigen::Vector3d jacobian(arm.dot(axes.col(0)), arm.dot(axes.col(1)), 1.0);
  return std::sqrt(jacobian.dot(covariance * jacobian));
}

void PlaneMoments::add(const Eigen::Vector3d& p_camera, double sigma_z) {
  const double w = 1.0 / (sigma_z * sigma_z);
  const Eigen::Vector3d ray = p_camera / p_camera.z();
  weight += w;
  first += w * p_camera;
  second += symmetric(w * p_camera * p_camera.transpose());
  noise += symmetric(ray * ray.transpose());  // w σ_z² = 1
}

PlaneMoments& PlaneMoments::operator+=(const PlaneMoments& other) {
  weight += other.weight;
  first += other.first;
  second += other.second;
  noise += other.noise;
  return *this;
}

PlaneMoments PlaneMoments::scaled(double factor) const {
  return {weight * factor, first * factor, second * factor, noise * factor};
}

PlaneMoments PlaneMoments::capped(double max_weight) const {
  return weight > max_weight ? scaled(max_weight / weight) : *this;
}

PlaneMoments PlaneMoments::transformed(const Eigen::Isometry3d& T_target_source) const {
  const Eigen::Matrix3d R = T_target_source.linear();
  const Eigen::Vector3d t = T_target_source.translation();
  const Eigen::Vector3d turned = R * first;
  PlaneMoments result;
  result.weight = weight;
  result.first = turned + weight * t;
  result.second = symmetric(R * second * R.transpose() + turned * t.transpose() +
                            t * turned.transpose() + weight * t * t.transpose());
  result.noise = symmetric(R * noise * R.transpose());
  return result;
}

std::optional<PlaneFit> PlaneMoments::fit(const Eigen::Vector3d& side) const {
  if (!(weight > 0.0)) return std::nullopt;
  const Eigen::Vector3d mean = centroid();
  const Eigen::Matrix3d scatter = second / weight - mean * mean.transpose();
  const Eigen::Matrix3d expected_noise = noise / weight;
  if (!scatter.allFinite() || !expected_noise.allFinite()) return std::nullopt;

  const double share = noise_share(scatter, expected_noise);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter - share * expected_noise);
  const Eigen::Vector3d values = solver.eigenvalues();  // ascending
  if (!(values(1) > kLeastExtent * kLeastExtent)) return std::nullopt;

  PlaneFit fit;
  Eigen::Vector3d normal = solver.eigenvectors().col(0).normalized();
  if (normal.dot(side) < 0.0) normal = -normal;
  fit.plane = Plane::through(mean, normal);
  fit.centroid = mean;
  fit.axes.col(0) = solver.eigenvectors().col(2);
  fit.axes.col(1) = normal.cross(fit.axes.col(0));
  fit.axes.col(2) = normal;
  fit.extent = {values(2), values(1)};
  fit.rms = std::sqrt(std::max(0.0, normal.dot(scatter * normal)));
  fit.covariance.diagonal() << 1.0 / (weight * values(2)), 1.0 / (weight * values(1)), 1.0 / weight;
  return fit;
}

std::array<double, 16> PlaneMoments::to_array() const {
  const auto& s = second;
  const auto& n = noise;
  return {weight,  first(0), first(1), first(2), s(0, 0), s(0, 1), s(0, 2), s(1, 1),
          s(1, 2), s(2, 2),  n(0, 0),  n(0, 1),  n(0, 2), n(1, 1), n(1, 2), n(2, 2)};
}

PlaneMoments PlaneMoments::from_array(const std::array<double, 16>& v) {
  PlaneMoments m;
  m.weight = v[0];
  m.first << v[1], v[2], v[3];
  m.second << v[4], v[5], v[6], v[5], v[7], v[8], v[6], v[8], v[9];
  m.noise << v[10], v[11], v[12], v[11], v[13], v[14], v[12], v[14], v[15];
  return m;
}

}  // namespace geomap::geometry
