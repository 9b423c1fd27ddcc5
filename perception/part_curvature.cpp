// SPDX-License-Identifier: BSD-3-Clause
#include "perception/part_curvature.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace geomap::perception {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

constexpr int kLeastCells = 12;
// A depth camera's noise is alike in neighbouring cells: so many count as one.
constexpr double kCorrelatedCells = 4.0;

// Sums of a weighted least-squares fit of 1, s, t, s²/2, s·t, t²/2.
struct QuadricSums {
  Matrix6d information = Matrix6d::Zero();
  Vector6d right = Vector6d::Zero();
  double squares = 0.0;
  double weight = 0.0;
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();

  void add(double s, double t, double height, double w) {
    Vector6d basis;
    basis << 1.0, s, t, 0.5 * s * s, s * t, 0.5 * t * t;
    information += w * basis * basis.transpose();
    right += w * height * basis;
    squares += w * height * height;
    weight += w;
    const Eigen::Vector2d at(s, t);
    second += w * at * at.transpose();
  }
};

}  // namespace

std::optional<PartCurvature> curvature_of(const PlanePart& part, const geometry::PlaneFit& fit) {
  if (part.size() < kLeastCells) return std::nullopt;
  const Eigen::Vector3d s_axis = fit.plane.normal.unitOrthogonal();
  const Eigen::Vector3d t_axis = fit.plane.normal.cross(s_axis);
  // In units of the part's size: the sums stay comparable.
  const double unit = std::sqrt(fit.extent.x());
  QuadricSums sums;
  for (const PlaneCell* cell : part) {
    const Eigen::Vector3d from =
        cell->sums.moments.first / cell->sums.moments.weight - fit.centroid;
    sums.add(s_axis.dot(from) / unit, t_axis.dot(from) / unit, fit.plane.normal.dot(from),
             cell->sums.pixels);
  }
  const Eigen::FullPivLU<Matrix6d> solver(sums.information / sums.weight);
  if (solver.rcond() < 1e-9) return std::nullopt;
  const Vector6d quadric = solver.solve(sums.right / sums.weight);
  const double left = std::max(0.0, sums.squares - quadric.dot(sums.right)) / sums.weight;
  const double independent = std::max(1.0, static_cast<double>(part.size() - 6) / kCorrelatedCells);
  const Matrix6d covariance = left / independent * solver.inverse();

  Eigen::Matrix2d bend;
  bend << quadric[3], quadric[4], quadric[4], quadric[5];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> principal(bend);
  const int most = std::abs(principal.eigenvalues()[0]) > principal.eigenvalues()[1] ? 0 : 1;
  const Eigen::Vector2d direction = principal.eigenvectors().col(most);
  Vector6d gradient = Vector6d::Zero();  // of that eigenvalue
  gradient.tail<3>() << direction.x() * direction.x(), 2.0 * direction.x() * direction.y(),
      direction.y() * direction.y();

  PartCurvature curvature;
  const double per_unit = std::abs(principal.eigenvalues()[most]);
  curvature.value = per_unit / (unit * unit);
  curvature.sigma = std::sqrt(std::max(0.0, gradient.dot(covariance * gradient))) / (unit * unit);
  // Of an evenly filled strip the half length squared is three times the variance.
  curvature.sagitta = 1.5 * per_unit * direction.dot(sums.second * direction) / sums.weight;
  return curvature;
}

}  // namespace geomap::perception
