// SPDX-License-Identifier: BSD-3-Clause
#include "perception/icp_loops.hpp"

#include <cmath>

#include "geometry/multiversion.hpp"
#include "perception/registration_weight.hpp"

namespace geomap::perception {

GEOMAP_MULTIVERSION void project_surfels(const InColumns& positions, std::size_t count,
                                         const CameraAxes& camera,
                                         const geometry::CameraModel& model, const OutColumns& arms,
                                         const OutColumns& points, double* u, double* v) {
  const auto [x, y, z] = positions;
  const auto [arm_x, arm_y, arm_z] = arms;
  const auto [point_x, point_y, point_z] = points;
  const CameraAxes c = camera;
  const geometry::CameraModel m = model;
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    const double ax = x[i] - c.centre[0], ay = y[i] - c.centre[1], az = z[i] - c.centre[2];
    const double px = c.axis[0][0] * ax + c.axis[0][1] * ay + c.axis[0][2] * az;
    const double py = c.axis[1][0] * ax + c.axis[1][1] * ay + c.axis[1][2] * az;
    const double pz = c.axis[2][0] * ax + c.axis[2][1] * ay + c.axis[2][2] * az;
    arm_x[i] = ax, arm_y[i] = ay, arm_z[i] = az;
    point_x[i] = px, point_y[i] = py, point_z[i] = pz;
    u[i] = m.fx * px / pz + m.cx + 0.5;
    v[i] = m.fy * py / pz + m.cy + 0.5;
  }
}

GEOMAP_MULTIVERSION void find_pixels(const double* z, const double* u, const double* v,
                                     std::size_t count, int width, int height,
                                     std::int32_t* pixels) {
  const double right = width, bottom = height;
  const std::int32_t nothing = width * height;
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    const bool in_view = (z[i] > SurfaceImage::kNearest) & (u[i] >= 0.0) & (v[i] >= 0.0) &
                         (u[i] < right) & (v[i] < bottom);
    const auto column = static_cast<std::int32_t>(in_view ? u[i] : 0.0);
    const auto row = static_cast<std::int32_t>(in_view ? v[i] : 0.0);
    pixels[i] = in_view ? row * width + column : nothing;
  }
}

GEOMAP_MULTIVERSION void match_surfels(const SurfelColumns& surfels, const InColumns& planes,
                                       const InColumns& facing, std::size_t count,
                                       const CameraAxes& camera, const PartnerLimits& limits,
                                       const PartnerColumns& partners) {
  const auto [px, py, pz] = surfels.points;
  const auto [nx, ny, nz] = surfels.normals;
  const auto [a, b, c] = planes;
  const auto [fx, fy, fz] = facing;
  const CameraAxes axes = camera;
  const PartnerLimits limit = limits;
  const PartnerColumns out = partners;
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    const double x = px[i], y = py[i], z = pz[i], wx = nx[i], wy = ny[i], wz = nz[i];
    const double turned_x = axes.axis[0][0] * wx + axes.axis[0][1] * wy + axes.axis[0][2] * wz;
    const double turned_y = axes.axis[1][0] * wx + axes.axis[1][1] * wy + axes.axis[1][2] * wz;
    const double turned_z = axes.axis[2][0] * wx + axes.axis[2][1] * wy + axes.axis[2][2] * wz;
    // The surfel's viewing ray meets the partner's plane at p / q, see SurfacePixel::on_ray_of().
    const double q = a[i] * x + b[i] * y + c[i] * z;
    const double scale = 1.0 / q;
    const bool meets = q > 0.0;
    const double share = limit.seen_through * z;
    const double nearer = share > limit.gate ? share : limit.gate;
    const double cosine = turned_x * fx[i] + turned_y * fy[i] + turned_z * fz[i];
    const double e = (turned_x * x + turned_y * y + turned_z * z) * (1.0 - scale);
    const bool is_partner = meets & (cosine >= limit.least_cosine) & (std::abs(e) <= limit.gate);
    out.through[i] = meets & (z < z * scale - nearer) ? 1.0 : 0.0;
    out.cosine[i] = is_partner ? cosine : kNoPartner;
    out.residual[i] = is_partner ? e : 0.0;
    out.weight[i] = is_partner ? registration_weight(z, e) : 0.0;
  }
}

GEOMAP_MULTIVERSION void add_partners(const InColumns& arms, const InColumns& normals,
                                      const double* weight, const double* residual,
                                      const double* through, std::size_t count, LaneSums& sums) {
  constexpr std::size_t kLanes = kSumLanes;
  LaneSums sum = sums;
  const auto [x, y, z] = arms;
  const auto [nx, ny, nz] = normals;
  for (std::size_t i = 0; i < count; i += kLanes) {
#pragma GCC ivdep
    for (std::size_t k = 0; k < kLanes; ++k) {
      const double w = weight[i + k], e = residual[i + k];
      const bool is_partner = w > 0.0;  // what is no number must not enter, even with weight 0
      const double ax = is_partner ? x[i + k] : 0.0, ay = is_partner ? y[i + k] : 0.0,
                   az = is_partner ? z[i + k] : 0.0;
      const double j0 = is_partner ? nx[i + k] : 0.0, j1 = is_partner ? ny[i + k] : 0.0,
                   j2 = is_partner ? nz[i + k] : 0.0;
      const double j3 = ay * j2 - az * j1, j4 = az * j0 - ax * j2, j5 = ax * j1 - ay * j0;
      const double w0 = w * j0, w1 = w * j1, w2 = w * j2, w3 = w * j3, w4 = w * j4, w5 = w * j5;
      sum[0][k] += w0 * j0, sum[1][k] += w0 * j1, sum[2][k] += w0 * j2, sum[3][k] += w0 * j3;
      sum[4][k] += w0 * j4, sum[5][k] += w0 * j5, sum[6][k] += w1 * j1, sum[7][k] += w1 * j2;
      sum[8][k] += w1 * j3, sum[9][k] += w1 * j4, sum[10][k] += w1 * j5, sum[11][k] += w2 * j2;
      sum[12][k] += w2 * j3, sum[13][k] += w2 * j4, sum[14][k] += w2 * j5, sum[15][k] += w3 * j3;
      sum[16][k] += w3 * j4, sum[17][k] += w3 * j5, sum[18][k] += w4 * j4, sum[19][k] += w4 * j5;
      sum[20][k] += w5 * j5;
      sum[21][k] += w0 * e, sum[22][k] += w1 * e, sum[23][k] += w2 * e, sum[24][k] += w3 * e;
      sum[25][k] += w4 * e, sum[26][k] += w5 * e;
      sum[27][k] += w, sum[28][k] += w * e * e;
      sum[29][k] += w * (ax * ax + ay * ay + az * az);
      sum[30][k] += is_partner ? 1.0 : 0.0;
      sum[31][k] += through[i + k];
    }
  }
  sums = sum;
}

}  // namespace geomap::perception
