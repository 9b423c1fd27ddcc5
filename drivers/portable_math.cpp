// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/portable_math.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace geomap::drivers {
namespace {

// 1 - x²/(k(k+1)) (1 - x²/((k+2)(k+3)) (1 - ...)): Taylor's series of the cosine with k = 1, that
// of sin x / x with k = 2. Eight factors leave less than 1e-17 where |x| <= pi/4.
double alternating_series(double x2, int k) {
  double sum = 1.0;
  for (int n = k + 14; n >= k; n -= 2) sum = 1.0 - x2 / (n * (n + 1)) * sum;
  return sum;
}

}  // namespace

SineAndCosine portable_sincos(double angle) {
  // Cody and Waite: pi/2 in three parts, the first two of so few digits that the products with the
  // number of quarter turns are exact.
  constexpr double kFirst = 0x1.921fb544p+0;
  constexpr double kSecond = 0x1.0b4611a6p-34;
  constexpr double kThird = 0x1.3198a2e037073p-69;
  const double turns = std::floor(angle * (2.0 / std::numbers::pi) + 0.5);
  const double x = ((angle - turns * kFirst) - turns * kSecond) - turns * kThird;
  const double sine = x * alternating_series(x * x, 2);
  const double cosine = alternating_series(x * x, 1);
  switch (static_cast<std::int64_t>(turns) & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

Eigen::Matrix3d turned_about_x(double angle) {
  const auto [s, c] = portable_sincos(angle);
  Eigen::Matrix3d R;
  R << 1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c;
  return R;
}

Eigen::Matrix3d turned_about_y(double angle) {
  const auto [s, c] = portable_sincos(angle);
  Eigen::Matrix3d R;
  R << c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c;
  return R;
}

Eigen::Matrix3d turned_about_z(double angle) {
  const auto [s, c] = portable_sincos(angle);
  Eigen::Matrix3d R;
  R << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  return R;
}

double portable_log(double x) {
  // x = m 2^e with m in [√½, √2), and log m = 2 atanh s with s = (m - 1) / (m + 1), |s| < 0.172.
  constexpr auto kBitsOfRootOfHalf = std::bit_cast<std::int64_t>(std::numbers::sqrt2 / 2.0);
  const auto bits = std::bit_cast<std::int64_t>(x);
  const std::int64_t e = (bits - kBitsOfRootOfHalf) >> 52;
  const auto m = std::bit_cast<double>(bits - e * (std::int64_t{1} << 52));
  const double s = (m - 1.0) / (m + 1.0);
  const double s2 = s * s;
  double series = 1.0 / 21.0;  // the next term is below 1e-18
  for (int n = 19; n > 0; n -= 2) series = series * s2 + 1.0 / n;
  return static_cast<double>(e) * std::numbers::ln2 + 2.0 * s * series;
}

}  // namespace geomap::drivers
