// SPDX-License-Identifier: BSD-3-Clause
#include "perception/frustum_icp.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "geometry/angles.hpp"
#include "perception/registration_weight.hpp"
#include "perception/rigid_transform.hpp"

namespace geomap::perception {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr std::size_t kCoarseStride = 4;
constexpr int kLeastPartners = 30;
constexpr double kConvergedTranslation = 1e-3, kConvergedAngle = 1e-3;  // [m], [rad]
constexpr double kDoneTranslation = 1e-5, kDoneAngle = 1e-5;
constexpr double kCorrelation = 20.0;  // surfels that say no more than one
constexpr double kNoiseFactor = 2.0;   // information over that of the normals' noise
constexpr int kPatch = 8;              // pixels of the view that overlap is judged by at once

// Normal equations of one step, about the camera's centre in the world's axes.
struct StepSums {
  std::array<double, 21> information{};  // upper triangle, row by row
  std::array<double, 6> vector{};
  double weight = 0.0;
  double squares = 0.0;         // Σ w e²
  double radius_squares = 0.0;  // Σ w |p|²
  int partners = 0;
  int seen_through = 0;  // surfels nearer than the view's surface by more than the gate

  void add(double w, double e, const Eigen::Vector3d& p, const Eigen::Vector3d& n) {
    const Eigen::Vector3d m = p.cross(n);
    const std::array<double, 6> j = {n.x(), n.y(), n.z(), m.x(), m.y(), m.z()};
    for (std::size_t r = 0, k = 0; r < 6; ++r) {
      const double wj = w * j[r];
      for (std::size_t c = r; c < 6; ++c) information[k++] += wj * j[c];
      vector[r] += wj * e;
    }
    weight += w;
    squares += w * e * e;
    radius_squares += w * p.squaredNorm();
    ++partners;
  }
  Matrix6 matrix() const {
    Matrix6 m;
    for (int r = 0, k = 0; r < 6; ++r) {
      for (int c = r; c < 6; ++c, ++k) m(r, c) = m(c, r) = information[static_cast<std::size_t>(k)];
    }
    return m;
  }
  double radius() const { return std::max(0.1, std::sqrt(radius_squares / weight)); }
};

// Which eighths of the view hold a surface, and on which a partner was found.
class Overlap {
 public:
  explicit Overlap(const SurfaceImage& view)
      : columns_((view.width() + kPatch - 1) / kPatch),
        surfaces_(static_cast<std::size_t>(columns_ * ((view.height() + kPatch - 1) / kPatch)), 0),
        found_(surfaces_.size(), 0) {
    for (int v = 0; v < view.height(); ++v) {
      for (int u = 0; u < view.width(); ++u) surfaces_[patch(u, v)] += view.at(u, v).valid();
    }
  }
  void mark(int u, int v) { found_[patch(u, v)] = 1; }
  double share() const {
    int all = 0, found = 0;
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
      all += surfaces_[i];
      found += found_[i] != 0 ? surfaces_[i] : 0;
    }
    return all > 0 ? static_cast<double>(found) / all : 0.0;
  }

 private:
  std::size_t patch(int u, int v) const {
    return static_cast<std::size_t>(v / kPatch * columns_ + u / kPatch);
  }
  int columns_;
  std::vector<int> surfaces_;
  std::vector<char> found_;
};

class Aligner {
 public:
  Aligner(const std::vector<Surfel>& surfels, const SurfaceImage& view,
          const FrustumIcpConfig& config)
      : surfels_(surfels),
        view_(view),
        config_(config),
        least_cosine_(std::cos(geometry::radians(config.max_normal_angle_deg))) {}

  Alignment run(const Eigen::Isometry3d& prior) {
    Alignment result;
    result.T_world_camera = prior;
    if (!iterate(prior, result)) return result;
    // The noise of the normals shows only now that the views are aligned. Where the set of observed
    // directions was wrong, the steps were: once more with the right one.
    const int before = observed_;
    std::vector<double> normals;
    const StepSums sums = sum(config_.gate, 1, nullptr, &normals);
    if (sums.partners < kLeastPartners) return result;
    find_observed(sums, kNoiseFactor * normal_variance(std::move(normals)), 1);
    if (observed_ != before && !iterate(prior, result)) return result;
    judge(result);
    return result;
  }

 private:
  // @return false when too few partners are left.
  bool iterate(const Eigen::Isometry3d& prior, Alignment& result) {
    T_ = prior;
    T_.linear() = Eigen::Quaterniond(prior.linear()).normalized().toRotationMatrix();
    for (int i = 0; i < config_.max_iterations; ++i) {
      const bool coarse = i < config_.coarse_iterations;
      const std::size_t stride = coarse ? kCoarseStride : 1;
      const double gate = std::max(config_.gate, std::ldexp(config_.coarse_gate, -i));
      const StepSums sums = sum(gate, stride);
      result.partners = sums.partners;
      ++result.iterations;
      if (sums.partners < kLeastPartners) return false;
      if (observed_ < 0) find_observed(sums, 0.0, stride);
      const auto [translation, angle] = step(sums);
      result.converged = translation < kConvergedTranslation && angle < kConvergedAngle;
      const bool settled = gate == config_.gate && !coarse;
      if (settled && translation < kDoneTranslation && angle < kDoneAngle) break;
    }
    return true;
  }

  // @param overlap, normals to be filled, null while only the step matters: what of the view has
  // partners, and the squared differences of the partners' normals.
  StepSums sum(double gate, std::size_t stride, Overlap* overlap = nullptr,
               std::vector<double>* normals = nullptr) const {
    const Eigen::Matrix3d R_camera_world = T_.linear().transpose();
    const Eigen::Vector3d centre = T_.translation();
    StepSums sums;
    for (std::size_t i = 0; i < surfels_.size(); i += stride) {
      const Surfel& surfel = surfels_[i];
      const Eigen::Vector3d arm = surfel.position - centre;
      const Eigen::Vector3d p = R_camera_world * arm;
      const SurfacePixel* pixel = view_.seen_at(p);
      if (pixel == nullptr) continue;
      const auto on_surface = pixel->on_ray_of(p);
      if (!on_surface) continue;
      if (p.z() < on_surface->z() - std::max(gate, kSeenThrough * p.z())) ++sums.seen_through;
      const Eigen::Vector3d n = R_camera_world * surfel.normal;
      const double cosine = n.dot(pixel->normal);
      if (cosine < least_cosine_) continue;
      const double e = n.dot(p - *on_surface);
      if (std::abs(e) > gate) continue;
      const double w = registration_weight(p.z(), e);
      sums.add(w, e, arm, surfel.normal);
      if (normals != nullptr) normals->push_back(2.0 * (1.0 - cosine));
      if (overlap != nullptr) overlap->mark(pixel_u(p), pixel_v(p));
    }
    return sums;
  }
  int pixel_u(const Eigen::Vector3d& p) const {
    return static_cast<int>(view_.camera().fx * p.x() / p.z() + view_.camera().cx + 0.5);
  }
  int pixel_v(const Eigen::Vector3d& p) const {
    return static_cast<int>(view_.camera().fy * p.y() / p.z() + view_.camera().cy + 0.5);
  }

  // Eigenvalues [1/m²] of the information with rotations as lengths, ascending.
  static Eigen::SelfAdjointEigenSolver<Matrix6> decompose(const StepSums& sums) {
    Vector6 scale = Vector6::Ones();
    scale.tail<3>().setConstant(1.0 / sums.radius());
    return Eigen::SelfAdjointEigenSolver<Matrix6>(scale.asDiagonal() * sums.matrix() *
                                                  scale.asDiagonal());
  }

  // What differs between the normals of partners is noise of both, each in two directions. The
  // median, because clutter is not noise: of a normally distributed 2-vector's squared length it
  // is 2 ln 2 of the variance. Half of it is the surfels', the only part that enters information.
  static double normal_variance(std::vector<double> squared_differences) {
    const auto middle =
        squared_differences.begin() + static_cast<std::ptrdiff_t>(squared_differences.size() / 2);
    std::nth_element(squared_differences.begin(), middle, squared_differences.end());
    return 0.5 * *middle / (2.0 * std::numbers::ln2);
  }

  // @param noise_share of the whole weight that noise feigns.
  void find_observed(const StepSums& sums, double noise_share, std::size_t stride) {
    const auto solver = decompose(sums);
    const double prior =
        kCorrelation / (static_cast<double>(stride) * config_.prior_sigma * config_.prior_sigma);
    const double least =
        std::max(prior, sums.weight * std::max(noise_share, config_.least_information));
    radius_ = sums.radius();
    observed_ = 0;
    directions_.setZero();
    for (int i = 0; i < 6; ++i) {
      if (solver.eigenvalues()(i) <= least) continue;
      directions_.col(observed_++) = solver.eigenvectors().col(i);
    }
  }

  // Gauss-Newton within the observed directions. @return length [m] and angle [rad] of the step.
  std::pair<double, double> step(const StepSums& sums) {
    if (observed_ == 0) return {0.0, 0.0};
    Vector6 scale = Vector6::Ones();
    scale.tail<3>().setConstant(1.0 / radius_);
    const Eigen::Matrix<double, 6, Eigen::Dynamic> basis =
        scale.asDiagonal() * directions_.leftCols(observed_);
    const Eigen::MatrixXd information = basis.transpose() * sums.matrix() * basis;
    const Eigen::VectorXd vector = basis.transpose() * Vector6(sums.vector.data());
    const Vector6 twist = basis * information.ldlt().solve(vector);
    const double angle = twist.tail<3>().norm();
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    if (angle > 0.0) {
      turn = Eigen::AngleAxisd(angle, twist.tail<3>() / angle).toRotationMatrix();
    }
    T_.linear() = Eigen::Quaterniond(turn * T_.linear()).normalized().toRotationMatrix();
    T_.translation() += twist.head<3>();
    return {twist.head<3>().norm(), angle};
  }

  // Once more at the final pose: how good is it?
  void judge(Alignment& result) const {
    Overlap overlap(view_);
    const StepSums sums = sum(config_.gate, 1, &overlap);
    result.T_world_camera = T_;
    result.partners = sums.partners;
    if (sums.partners == 0) return;
    result.rms = std::sqrt(sums.squares / sums.weight);
    result.overlap = overlap.share();
    result.agreement = static_cast<double>(sums.partners) / (sums.partners + sums.seen_through);
    const auto solver = decompose(sums);
    result.conditioning = std::max(0.0, solver.eigenvalues()(0) / solver.eigenvalues()(5));
    result.observed_directions = observed_;
  }

  static constexpr double kSeenThrough = 0.04;  // share of the depth

  const std::vector<Surfel>& surfels_;
  const SurfaceImage& view_;
  const FrustumIcpConfig& config_;
  double least_cosine_;
  Eigen::Isometry3d T_ = Eigen::Isometry3d::Identity();  // T_world_camera
  double radius_ = 1.0;
  int observed_ = -1;                     // directions; negative: not known yet
  Matrix6 directions_ = Matrix6::Zero();  // its first observed_ columns
};

}  // namespace

std::vector<std::string> FrustumIcpConfig::validate() const {
  std::vector<std::string> errors;
  if (max_iterations < 1 || max_iterations > 1000) {
    errors.push_back("max_iterations must be between 1 and 1000");
  }
  if (coarse_iterations < 0) errors.push_back("coarse_iterations must not be negative");
  if (!(gate > 0.0) || !(coarse_gate >= gate) || !(coarse_gate <= 10.0)) {
    errors.push_back("gates must obey 0 < gate <= coarse_gate <= 10 m");
  }
  if (!(max_normal_angle_deg > 0.0) || !(max_normal_angle_deg <= 90.0)) {
    errors.push_back("max_normal_angle_deg must be above 0 and at most 90");
  }
  if (!(prior_sigma > 0.0)) errors.push_back("prior_sigma must be above 0 m");
  if (!(least_information >= 0.0) || !(least_information < 1.0)) {
    errors.push_back("least_information must be at least 0 and below 1");
  }
  return errors;
}

Alignment align(const std::vector<Surfel>& surfels, const SurfaceImage& view,
                const Eigen::Isometry3d& T_world_camera_prior, const FrustumIcpConfig& config) {
  if (!is_rigid(T_world_camera_prior)) {
    throw std::invalid_argument("frustum ICP: the prior is not rigid");
  }
  return Aligner(surfels, view, config).run(T_world_camera_prior);
}

}  // namespace geomap::perception
