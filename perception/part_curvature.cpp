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

// In the plane: where cells are from the centroid along the part's own axes.
struct PartAxes {
  Eigen::Vector3d s, t;  // unit, the longer one first
  Eigen::Vector2d size;  // standard deviation along them [m]
};

PartAxes axes_of(const std::vector<CellPoint>& part, const geometry::PlaneFit& fit) {
  const Eigen::Vector3d u = fit.plane.normal.unitOrthogonal();
  const Eigen::Vector3d v = fit.plane.normal.cross(u);
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  double weight = 0.0;
  for (const CellPoint& cell : part) {
    const Eigen::Vector3d from = cell.mean - fit.centroid;
    const Eigen::Vector2d at(u.dot(from), v.dot(from));
    second += cell.pixels * at * at.transpose();
    weight += cell.pixels;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> principal(second / weight);
  const Eigen::Vector2d along = principal.eigenvectors().col(1);
  const Eigen::Vector2d across = principal.eigenvectors().col(0);
  return {along.x() * u + along.y() * v, across.x() * u + across.y() * v,
          principal.eigenvalues().reverse().cwiseMax(0.0).cwiseSqrt()};
}

// Sums of a weighted least-squares fit of 1, s, t, s²/2, s·t, t²/2.
struct QuadricSums {
  Matrix6d information = Matrix6d::Zero();
  Vector6d right = Vector6d::Zero();
  double squares = 0.0;
  double weight = 0.0;

  void add(double s, double t, double height, double w) {
    Vector6d basis;
    basis << 1.0, s, t, 0.5 * s * s, s * t, 0.5 * t * t;
    information += w * basis * basis.transpose();
    right += w * height * basis;
    squares += w * height * height;
    weight += w;
  }
};

}  // namespace

std::optional<PartCurvature> curvature_of(const std::vector<CellPoint>& part,
                                          const geometry::PlaneFit& fit) {
  if (part.size() < kLeastCells) return std::nullopt;
  const PartAxes axes = axes_of(part, fit);
  if (!(axes.size.minCoeff() > 0.0)) return std::nullopt;
  QuadricSums sums;  // in units of the part's size: they stay comparable
  for (const CellPoint& cell : part) {
    const Eigen::Vector3d from = cell.mean - fit.centroid;
    sums.add(axes.s.dot(from) / axes.size.x(), axes.t.dot(from) / axes.size.y(),
             fit.plane.normal.dot(from), cell.pixels);
  }
  const Eigen::FullPivLU<Matrix6d> solver(sums.information / sums.weight);
  if (solver.rcond() < 1e-9) return std::nullopt;
  const Vector6d quadric = solver.solve(sums.right / sums.weight);
  const double left = std::max(0.0, sums.squares - quadric.dot(sums.right)) / sums.weight;
  const double independent = std::max(1.0, static_cast<double>(part.size() - 6) / kCorrelatedCells);
  const Matrix6d covariance = left / independent * solver.inverse();

  Eigen::Matrix2d bend;
  bend << quadric[3], quadric[4], quadric[4], quadric[5];
  const Eigen::Vector2d per_metre = axes.size.cwiseInverse();
  bend = per_metre.asDiagonal() * bend * per_metre.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> principal(bend);
  const int most = std::abs(principal.eigenvalues()[0]) > principal.eigenvalues()[1] ? 0 : 1;
  const Eigen::Vector2d direction = principal.eigenvectors().col(most);
  const Eigen::Vector2d scaled = direction.cwiseProduct(per_metre);
  Vector6d gradient = Vector6d::Zero();  // of that eigenvalue
  gradient.tail<3>() << scaled.x() * scaled.x(), 2.0 * scaled.x() * scaled.y(),
      scaled.y() * scaled.y();

  PartCurvature curvature;
  curvature.value = std::abs(principal.eigenvalues()[most]);
  curvature.sigma = std::sqrt(std::max(0.0, gradient.dot(covariance * gradient)));
  // Of an evenly filled strip the half length squared is three times the variance.
  curvature.sagitta = 1.5 * curvature.value * direction.cwiseProduct(axes.size).squaredNorm();
  return curvature;
}

}  // namespace geomap::perception
