// SPDX-License-Identifier: BSD-3-Clause
#include "perception/surface_rows.hpp"

#include <cmath>

#include "geometry/multiversion.hpp"
#include "geometry/rgbd_frame.hpp"

namespace geomap::perception {
namespace {

constexpr double kSameSurface = 0.06;  // relative depth difference within a window
constexpr double kLeastFill = 0.6;     // of a window

// Moments of a window's pixels that lie on its surface: place (u, v) from the centre, and g, what
// the inverse depth differs by from the centre's.
struct WindowSums {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0, g = 0, gx = 0, gy = 0, gg = 0;

  // Constants, so that the compiler need not multiply by 0 and 1.
  template <int du, int dv>
  [[gnu::always_inline]] void add(double difference, double same) {
    const double w = std::abs(difference) <= same ? 1.0 : 0.0;  // an absent reading is q = 0
    const double value = w * difference;
    n += w;
    g += value;
    gg += value * difference;
    if constexpr (du != 0) x += w * du, xx += w * (du * du), gx += value * du;
    if constexpr (dv != 0) y += w * dv, yy += w * (dv * dv), gy += value * dv;
    if constexpr (du * dv != 0) xy += w * (du * dv);
  }
};

template <int dv, int... du>
[[gnu::always_inline]] inline void add_pixels(const double* row, double q0, double same,
                                              WindowSums& sums) {
  (sums.add<du, dv>(row[du] - q0, same), ...);
}

struct Fit {
  double a, b, q;  // q = 0: none
};

[[gnu::always_inline]] inline Fit solve(const WindowSums& s, double pixels, double q0,
                                        double largest_rms) {
  const double mx = s.x / s.n, my = s.y / s.n, mg = s.g / s.n;
  const double cxx = s.xx - s.x * mx, cxy = s.xy - s.x * my, cyy = s.yy - s.y * my;
  const double cgx = s.gx - s.g * mx, cgy = s.gy - s.g * my, cgg = s.gg - s.g * mg;
  const double determinant = cxx * cyy - cxy * cxy;
  const double a = (cgx * cyy - cgy * cxy) / determinant;
  const double b = (cgy * cxx - cgx * cxy) / determinant;
  const double squares = cgg - a * cgx - b * cgy;  // may be negative by rounding
  const double q = q0 + mg - a * mx - b * my;
  const bool fits = (s.n >= kLeastFill * pixels) & (determinant > 1e-3 * cxx * cyy) &
                    (squares <= (s.n - 3.0) * largest_rms * largest_rms) & (q > 0.0);
  return {a, b, fits ? q : 0.0};
}

}  // namespace

GEOMAP_MULTIVERSION void invert_depth(const std::uint16_t* __restrict millimetres, int count,
                                      double nearest, double farthest, double* __restrict inverse) {
  for (int u = 0; u < count; ++u) {
    const int mm = millimetres[u];
    const double depth = mm;
    const bool in_range = (mm != geometry::DepthImage::kNoReading) &
                          (mm != geometry::DepthImage::kInvalid) & (depth >= nearest) &
                          (depth <= farthest);
    inverse[u] = in_range ? 1e3 / depth : 0.0;
  }
}

GEOMAP_MULTIVERSION void fit_windows(const double* __restrict inverse, int stride, int count,
                                     const geometry::DepthNoise& noise, double flat_rms,
                                     const WindowFits& fits) {
  double* __restrict slope_u = fits.slope_u;
  double* __restrict slope_v = fits.slope_v;
  double* __restrict centre = fits.centre;
  const geometry::DepthNoise sensor = noise;  // a copy that no store can reach
#pragma GCC ivdep
  for (int u = 0; u < count; ++u) {
    const double* row = inverse + u;
    const double q0 = row[0], same = kSameSurface * q0;
    const double largest_rms = flat_rms * sensor.sigma(1.0 / q0) * q0 * q0;
    WindowSums sums;
    add_pixels<-1, -1, 0, 1>(row - stride, q0, same, sums);
    add_pixels<0, -1, 0, 1>(row, q0, same, sums);
    add_pixels<1, -1, 0, 1>(row + stride, q0, same, sums);
    const Fit small = solve(sums, 9.0, q0, largest_rms);
    add_pixels<-2, -2, -1, 0, 1, 2>(row - 2 * stride, q0, same, sums);
    add_pixels<-1, -2, 2>(row - stride, q0, same, sums);
    add_pixels<0, -2, 2>(row, q0, same, sums);
    add_pixels<1, -2, 2>(row + stride, q0, same, sums);
    add_pixels<2, -2, -1, 0, 1, 2>(row + 2 * stride, q0, same, sums);
    const Fit large = solve(sums, 25.0, q0, largest_rms);
    const bool is_flat = large.q > 0.0;
    slope_u[u] = is_flat ? large.a : small.a;
    slope_v[u] = is_flat ? large.b : small.b;
    centre[u] = is_flat ? large.q : small.q;
  }
}

GEOMAP_MULTIVERSION void place_surfaces(const WindowFits& fits, int count,
                                        const double* __restrict ray_x, double ray_y, double fx,
                                        double fy, double least_cosine, const SurfaceRow& row) {
  const double* __restrict slope_u = fits.slope_u;
  const double* __restrict slope_v = fits.slope_v;
  const double* __restrict centre = fits.centre;
  double* __restrict a = row.inverse_depth[0], * __restrict b = row.inverse_depth[1], * __restrict c = row.inverse_depth[2];
  double* __restrict nx = row.normal[0], * __restrict ny = row.normal[1], * __restrict nz = row.normal[2];
  double* __restrict px = row.point[0], * __restrict py = row.point[1], * __restrict pz = row.point[2];
#pragma GCC ivdep
  for (int u = 0; u < count; ++u) {
    const double x = ray_x[u], q = centre[u];
    const double qa = slope_u[u] * fx, qb = slope_v[u] * fy;
    const double qc = q - qa * x - qb * ray_y;
    const double length = std::sqrt(qa * qa + qb * qb + qc * qc);
    const double ray_length = std::sqrt(x * x + ray_y * ray_y + 1.0);
    // n·ray is -q / length: the surface is seen from its front.
    const bool is_seen = (q > 0.0) & (q >= least_cosine * ray_length * length);
    a[u] = is_seen ? qa : 0.0;
    b[u] = is_seen ? qb : 0.0;
    c[u] = is_seen ? qc : 0.0;
    nx[u] = is_seen ? -qa / length : 0.0;
    ny[u] = is_seen ? -qb / length : 0.0;
    nz[u] = is_seen ? -qc / length : 0.0;
    px[u] = is_seen ? x / q : 0.0;
    py[u] = is_seen ? ray_y / q : 0.0;
    pz[u] = is_seen ? 1.0 / q : 0.0;
  }
}

}  // namespace geomap::perception
