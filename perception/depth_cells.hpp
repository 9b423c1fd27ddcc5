// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "geometry/camera_model.hpp"
#include "geometry/plane.hpp"
#include "geometry/rgbd_frame.hpp"

namespace geomap::perception {

/// @brief Sums over pixels from which a plane is fitted to inverse depth q = 1/z.
///
/// A plane's inverse depth is linear in the viewing ray (x, y, 1): q = A x + B y + C. A depth
/// sensor's noise lies along the ray, so this fit, unlike one to points, is not tilted by noise,
/// and needs no eigenvectors.
struct InverseDepthSums {
  double count = 0.0;
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;  // of the rays
  double q = 0.0, qx = 0.0, qy = 0.0, qq = 0.0;           // q [1/m]

  InverseDepthSums& operator+=(const InverseDepthSums& other);

  double mean_depth() const { return count / q; }  // harmonic [m]
  /// Point [m] at the mean ray and mean depth; on a plane if all pixels are. Needs count > 0.
  Eigen::Vector3d mean_point() const { return Eigen::Vector3d(x, y, count) / q; }
};

/// @brief The best plane through pixels.
struct InverseDepthFit {
  Eigen::Vector3d coefficients;  // (A, B, C) [1/m]
  double rms = 0.0;  // of inverse depth about the plane, three degrees of freedom off [1/m]

  /// Unit normal towards the camera.
  Eigen::Vector3d normal() const { return -coefficients.normalized(); }
  /// Inverse depth [1/m] predicted on a ray.
  double at(double x, double y) const {
    return coefficients.x() * x + coefficients.y() * y + coefficients.z();
  }
};

/// @brief Fits a plane; nothing for fewer than six pixels or pixels on one line.
std::optional<InverseDepthFit> fit_plane(const InverseDepthSums& sums);

/// @brief Sums of square cells of a depth image.
///
/// Row by row, and within a row sum by sum: what is done to all cells of a row runs over contiguous
/// numbers.
class DepthCells {
 public:
  static constexpr int kSide = 4;  // of a cell [pixel]
  /// The sums of InverseDepthSums, in its order, and those of depth z and z² [m], [m²] times the
  /// rays: of the points (z x, z y, z) and their products.
  enum Sum : int {
    kCount,
    kX,
    kY,
    kXX,
    kXY,
    kYY,
    kQ,
    kQX,
    kQY,
    kQQ,
    kInverseSums,
    kZ = kInverseSums,
    kZX,
    kZY,
    kZZ,
    kZZX,
    kZZY,
    kZZXX,
    kZZXY,
    kZZYY,
    kSums
  };

  /// @brief Reads every pixel once. Readings outside [near, far] [m] count as none. Cells at the
  /// right and lower border may be incomplete.
  DepthCells(const geometry::DepthImage& depth, const geometry::CameraModel& camera, double near,
             double far);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  int size() const { return columns_ * rows_; }
  int index(int column, int row) const { return row * columns_ + column; }

  InverseDepthSums cell(int column, int row) const;
  InverseDepthSums cell(int i) const { return cell(i % columns_, i / columns_); }

  /// @brief One of the sums of all cells of a row.
  const double* row(int r, Sum sum) const {
    return sums_.get() + static_cast<std::ptrdiff_t>(r * kSums + sum) * columns_;
  }

  /// @brief Sums over the cells of columns [c0, c1) and rows [r0, r1), cut off at the border.
  InverseDepthSums window(int c0, int r0, int c1, int r1) const;

 private:
  int columns_ = 0;
  int rows_ = 0;
  std::unique_ptr<double[]> sums_;  // rows x kSums x columns
};

}  // namespace geomap::perception
