// SPDX-License-Identifier: BSD-3-Clause
#include "perception/frustum_icp.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "geometry/angles.hpp"
#include "perception/icp_partners.hpp"
#include "perception/rigid_transform.hpp"
#include "perception/view_overlap.hpp"

namespace geomap::perception {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr std::size_t kCoarseStride = 4;
constexpr int kLeastPartners = 30;
constexpr double kConvergedTranslation = 1e-3, kConvergedAngle = 1e-3;  // [m], [rad]
constexpr double kNearlyDone = 1e-3, kDone = 2e-4;                      // [m], [rad]
constexpr double kLeastDamping = 1e-6;                                  // share of the weight
constexpr int kRounds = 4;
constexpr double kBorder = 4.0;       // around the view, within which surfels are kept [pixel]
constexpr double kCorrelation = 8.0;  // surfels that say no more than one

class Aligner {
 public:
  Aligner(const std::vector<Surfel>& surfels, const SurfaceImage& view,
          const FrustumIcpConfig& config, double hold_sigma)
      : coarse_(surfels, kCoarseStride),
        surfels_(surfels),
        view_(view),
        config_(config),
        hold_sigma_(hold_sigma),
        least_cosine_(std::cos(geometry::radians(config.max_normal_angle_deg))) {}

  Alignment run(const Eigen::Isometry3d& prior) {
    Alignment result;
    result.T_world_camera = prior;
    T_ = start_ = orthonormal(prior);
    if (!approach(result)) return result;
    // What the fine steps cannot bring into the view costs them nothing.
    surfels_.keep_in_view(view_.camera(), T_, kBorder);
    coarse_.keep_in_view(view_.camera(), T_, kBorder);
    // Which directions are observed, and the noise of the normals, show only once the view is
    // aligned. Where the set was wrong, the pose was: once more with the right one.
    IcpSums sums = sum(config_.gate, surfels_);
    for (int round = 0; round < kRounds; ++round) {
      const int before = observed_;
      if (sums.partners < kLeastPartners) return result;
      find_observed(sums,
                    config_.noise_factor * normal_variance(surfels_.squared_normal_differences()));
      if (observed_ == before) break;
      if (!refine(result)) return result;
      sums = sum(config_.gate, surfels_);
    }
    judge(sums, result);
    return result;
  }

 private:
  // Coarse steps, in all directions: from a wrong pose the partners do not tell which are observed.
  // Damped, so that those which are not stay near the prior. @return false when too few partners
  // are left.
  bool approach(Alignment& result) {
    directions_.setIdentity();
    observed_ = 6;
    for (int i = 0; i < std::min(config_.coarse_iterations, config_.max_iterations); ++i) {
      const double gate = std::max(config_.gate, std::ldexp(config_.coarse_gate, -i));
      const IcpSums sums = sum(gate, coarse_);
      radius_ = sums.radius();
      const double damping = sums.weight * std::max(kLeastDamping, config_.least_information);
      if (!advance(sums, damping, false, result)) return false;
    }
    observed_ = -1;  // not known yet
    return true;
  }

  // Within the observed directions, from what the steps before have found in these: with every
  // fourth surfel until the steps are small, then with all.
  bool refine(Alignment& result) {
    keep_observed();
    bool with_all = false;
    for (int i = config_.coarse_iterations; i < config_.max_iterations; ++i) {
      const double gate = std::max(config_.gate, std::ldexp(config_.coarse_gate, -i));
      const IcpSums sums = with_all ? sum(gate, surfels_) : sum(gate, coarse_);
      hold_weight_ = with_all ? kCorrelation : kCorrelation / kCoarseStride;
      if (!advance(sums, 0.0, hold_sigma_ > 0.0, result)) return false;
      const double small = with_all ? kDone : kNearlyDone;
      if (gate > config_.gate || last_step_ >= small || last_angle_ >= small) continue;
      if (with_all) break;
      with_all = true;
    }
    return true;
  }

  bool advance(const IcpSums& sums, double damping, bool is_held, Alignment& result) {
    result.partners = sums.partners;
    ++result.iterations;
    result.converged = false;
    if (sums.partners < kLeastPartners) return false;
    step(sums, damping, is_held);
    result.converged = last_step_ < kConvergedTranslation && last_angle_ < kConvergedAngle;
    return true;
  }

  IcpSums sum(double gate, IcpPartners& surfels) const {
    return surfels.match(view_, T_, gate, least_cosine_);
  }

  // Eigenvalues [1/m²] of the information with rotations as lengths, ascending.
  static Eigen::SelfAdjointEigenSolver<Matrix6> decompose(const IcpSums& sums) {
    const Vector6 scale = scale_of(sums.radius());
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
  void find_observed(const IcpSums& sums, double noise_share) {
    const auto solver = decompose(sums);
    const double prior = kCorrelation / (config_.prior_sigma * config_.prior_sigma);
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

  // Gauss-Newton within the observed directions.
  void step(const IcpSums& sums, double damping, bool is_held) {
    last_step_ = last_angle_ = 0.0;
    if (observed_ == 0) return;
    const Eigen::Matrix<double, 6, Eigen::Dynamic> basis =
        scale_of(radius_).asDiagonal() * directions_.leftCols(observed_);
    Eigen::MatrixXd information = basis.transpose() * sums.matrix() * basis;
    information.diagonal().array() += damping;
    Eigen::VectorXd vector = basis.transpose() * Vector6(sums.vector.data());
    if (is_held) hold(information, vector);
    const Vector6 twist = basis * information.ldlt().solve(vector);
    last_step_ = twist.head<3>().norm();
    last_angle_ = twist.tail<3>().norm();
    T_.linear() = turned(T_, twist.tail<3>());
    T_.translation() += twist.head<3>();
    keep_observed();
  }

  // What odometry says of the motion, as one more measurement: it decides where the view tells
  // little. Where the two differ by more than it may be off (Cauchy), it is the odometry that is
  // wrong.
  void hold(Eigen::MatrixXd& information, Eigen::VectorXd& vector) const {
    const double variance = hold_sigma_ * hold_sigma_;
    const Eigen::VectorXd from_start = directions_.leftCols(observed_).transpose() * corrected();
    for (Eigen::Index i = 0; i < from_start.size(); ++i) {
      const double weight = hold_weight_ / (variance + from_start(i) * from_start(i));
      information(i, i) += weight;
      vector(i) -= weight * from_start(i);
    }
  }

  // Turns about different axes add up to one about a third, which may be open. So it is the whole
  // correction of the start that is projected.
  void keep_observed() {
    if (observed_ == 6) return;
    const auto observed = directions_.leftCols(observed_);
    const Vector6 twist =
        scale_of(radius_).asDiagonal() * (observed * (observed.transpose() * corrected())).eval();
    T_.linear() = turned(start_, twist.tail<3>());
    T_.translation() = start_.translation() + twist.head<3>();
  }

  // From the start to the pose so far, rotations as lengths [m].
  Vector6 corrected() const {
    const Eigen::AngleAxisd turn(
        Eigen::Quaterniond(T_.linear() * start_.linear().transpose()).normalized());
    Vector6 twist;
    twist << T_.translation() - start_.translation(), turn.angle() * turn.axis();
    return scale_of(radius_).cwiseInverse().asDiagonal() * twist;
  }

  static Vector6 scale_of(double radius) {  // from lengths to a twist
    Vector6 scale = Vector6::Ones();
    scale.tail<3>().setConstant(1.0 / radius);
    return scale;
  }
  static Eigen::Matrix3d turned(const Eigen::Isometry3d& T, const Eigen::Vector3d& rotation) {
    const double angle = rotation.norm();
    if (!(angle > 0.0)) return T.linear();
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, rotation / angle));
    return (turn * Eigen::Quaterniond(T.linear())).normalized().toRotationMatrix();
  }

  // How good is the final pose? @param sums at it.
  void judge(const IcpSums& sums, Alignment& result) const {
    result.T_world_camera = T_;
    result.partners = sums.partners;
    if (sums.partners == 0) return;
    result.rms = std::sqrt(sums.squares / sums.weight);
    ViewOverlap overlap(view_);
    for (const int pixel : surfels_.pixels()) overlap.mark(pixel);
    result.overlap = overlap.share();
    result.agreement = static_cast<double>(sums.partners) / (sums.partners + sums.seen_through);
    const auto solver = decompose(sums);
    result.conditioning = std::max(0.0, solver.eigenvalues()(0) / solver.eigenvalues()(5));
    result.observed_directions = observed_;
  }

  IcpPartners coarse_, surfels_;
  const SurfaceImage& view_;
  const FrustumIcpConfig& config_;
  double hold_sigma_;
  double hold_weight_ = kCorrelation;
  double least_cosine_;
  Eigen::Isometry3d start_ = Eigen::Isometry3d::Identity();  // the prior, orthonormal
  Eigen::Isometry3d T_ = Eigen::Isometry3d::Identity();      // T_world_camera
  double radius_ = 1.0;
  double last_step_ = 0.0, last_angle_ = 0.0;  // [m], [rad]
  int observed_ = -1;                          // directions; negative: not known yet
  Matrix6 directions_ = Matrix6::Zero();       // its first observed_ columns
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
  if (!(noise_factor >= 0.0)) errors.push_back("noise_factor must not be negative");
  if (!(least_information >= 0.0) || !(least_information < 1.0)) {
    errors.push_back("least_information must be at least 0 and below 1");
  }
  return errors;
}

Alignment align(const std::vector<Surfel>& surfels, const SurfaceImage& view,
                const Eigen::Isometry3d& T_world_camera_prior, const FrustumIcpConfig& config,
                double hold_sigma) {
  if (!is_rigid(T_world_camera_prior)) {
    throw std::invalid_argument("frustum ICP: the prior is not rigid");
  }
  return Aligner(surfels, view, config, hold_sigma).run(T_world_camera_prior);
}

}  // namespace geomap::perception
