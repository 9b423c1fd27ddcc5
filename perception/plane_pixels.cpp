// SPDX-License-Identifier: BSD-3-Clause
#include "perception/plane_pixels.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace geomap::perception {
namespace {

constexpr int kSide = DepthCells::kSide;
constexpr int kReach = 2;            // cells from which a plane may claim pixels [cell]
constexpr int kMostCandidates = 8;   // planes competing for one cell
// A residual of the plane that the cell's seed names counts this much: without it, labels of two nearly
// coplanar planes would speckle.
constexpr float kOwnAdvantage = 0.6F;
constexpr double kLeastCosine = 0.1;

}  // namespace

// A plane as a linear function of the pixel: inverse depth = a·u + b·v + c.
struct PixelAssigner::Candidate {
  float a = 0.0F, b = 0.0F, c = 0.0F;  // [1/m]
  float least = 0.0F;                  // tolerance along the ray beside the rest [m]
  float handicap = 1.0F;
  std::int16_t label = kNoPlane;
};

PlaneSums& PlaneSums::operator+=(const PlaneSums& other) {
  moments += other.moments;
  pixels += other.pixels;
  for (std::size_t k = 0; k < color.size(); ++k) color[k] += other.color[k];
  return *this;
}

PixelAssigner::PixelAssigner(const geometry::RgbdFrame& frame, const DepthCells& cells,
                             const std::vector<CellNormal>& normals,
                             const DepthTolerance& tolerance, double near, double far,
                             double max_normal_angle)
    : frame_(frame),
      cells_(cells),
      normals_(normals),
      unevenness_(tolerance.unevenness),
      cosine_(std::cos(max_normal_angle)) {
  constexpr std::size_t kDepthValues = 65536;
  inverse_.assign(kDepthValues, 0.0F);
  tolerance_.assign(kDepthValues, 0.0F);
  slope_.assign(kDepthValues, 0.0F);
  weight_.assign(kDepthValues, 0.0);
  const auto first = static_cast<std::size_t>(std::clamp(std::ceil(near * 1000.0), 1.0, 65534.0));
  const auto last = static_cast<std::size_t>(std::clamp(std::floor(far * 1000.0), 0.0, 65534.0));
  for (std::size_t mm = first; mm <= last; ++mm) {
    const double z = 0.001 * static_cast<double>(mm);
    const double sigma = tolerance.noise.sigma(z);
    inverse_[mm] = static_cast<float>(1.0 / z);
    slope_[mm] = static_cast<float>(1.0 / (z * z));
    tolerance_[mm] = static_cast<float>(tolerance.along_ray(z) / (z * z));
    weight_[mm] = 1.0 / (sigma * sigma);
  }
}

PlanePixels PixelAssigner::assign(const std::vector<geometry::Plane>& planes,
                                  const std::vector<std::int16_t>& cell_label,
                                  int row_step) const {
  PlanePixels result;
  label_pixels(planes, cell_label, row_step, result);
  sum_up(planes.size(), row_step, result);
  return result;
}

void PixelAssigner::label_pixels(const std::vector<geometry::Plane>& planes,
                                 const std::vector<std::int16_t>& cell_label, int row_step,
                                 PlanePixels& result) const {
  result.label.assign(frame_.depth.millimetres.size(), kNoPlane);
  std::array<Candidate, kMostCandidates> candidates;
  for (int row = 0; row < cells_.rows(); ++row) {
    for (int column = 0; column < cells_.columns(); ++column) {
      if (cells_.cell(cells_.index(column, row)).count == 0.0) continue;
      const int count = candidates_at(column, row, planes, cell_label, candidates.data());
      if (count > 0) label_cell(column, row, candidates.data(), count, row_step, result);
    }
  }
}

int PixelAssigner::candidates_at(int column, int row, const std::vector<geometry::Plane>& planes,
                                 const std::vector<std::int16_t>& cell_label,
                                 Candidate* candidates) const {
  const int own_cell = cells_.index(column, row);
  const std::int16_t own = cell_label[static_cast<std::size_t>(own_cell)];
  const CellNormal& normal = normals_[static_cast<std::size_t>(own_cell)];
  const geometry::CameraModel& camera = frame_.depth_camera;
  int count = 0;
  std::int16_t previous = kNoPlane;
  for (int r = std::max(0, row - kReach); r <= std::min(cells_.rows() - 1, row + kReach); ++r) {
    const int c_end = std::min(cells_.columns() - 1, column + kReach);
    for (int c = std::max(0, column - kReach); c <= c_end; ++c) {
      const std::int16_t label = cell_label[static_cast<std::size_t>(cells_.index(c, r))];
      if (label == previous || label == kNoPlane) continue;
      previous = label;
      const bool is_known = std::any_of(candidates, candidates + count,
                                        [label](const Candidate& k) { return k.label == label; });
      if (is_known || count == kMostCandidates) continue;
      const geometry::Plane& plane = planes[static_cast<std::size_t>(label)];
      if (normal.kind == CellNormal::Kind::kPlanar &&
          normal.normal.dot(plane.normal) < cosine_) {
        continue;
      }
      // On the plane n·p + d = 0 with p = ray/q: q = -n·ray/d.
      const Eigen::Vector3d m = -plane.normal / plane.d;
      const double cosine =
          std::abs(plane.normal.dot(camera.ray(column * kSide + 1.5, row * kSide + 1.5)));
      Candidate& k = candidates[count++];
      k.a = static_cast<float>(m.x() / camera.fx);
      k.b = static_cast<float>(m.y() / camera.fy);
      k.c = static_cast<float>(m.z() - m.x() * camera.cx / camera.fx -
                               m.y() * camera.cy / camera.fy);
      k.least = static_cast<float>(unevenness_ / std::max(kLeastCosine, cosine));
      k.handicap = label == own ? kOwnAdvantage : 1.0F;
      k.label = label;
    }
  }
  return count;
}

void PixelAssigner::label_cell(int column, int row, const Candidate* candidates, int count,
                               int row_step, PlanePixels& result) const {
  const geometry::DepthImage& depth = frame_.depth;
  const int u_end = std::min((column + 1) * kSide, depth.width);
  const int v_end = std::min((row + 1) * kSide, depth.height);
  for (int v = row * kSide; v < v_end; v += row_step) {
    const std::size_t line = static_cast<std::size_t>(v) * static_cast<std::size_t>(depth.width);
    for (int u = column * kSide; u < u_end; ++u) {
      const std::size_t pixel = line + static_cast<std::size_t>(u);
      const std::size_t reading = depth.millimetres[pixel];
      const float q = inverse_[reading];
      if (q == 0.0F) continue;
      float best = 1e9F;
      std::int16_t label = kNoPlane;
      for (int k = 0; k < count; ++k) {
        const Candidate& plane = candidates[k];
        const float predicted =
            plane.a * static_cast<float>(u) + plane.b * static_cast<float>(v) + plane.c;
        const float off = std::abs(predicted - q);
        const float scored = off * plane.handicap;
        const bool is_better =
            off <= tolerance_[reading] + plane.least * slope_[reading] && scored < best;
        best = is_better ? scored : best;
        label = is_better ? plane.label : label;
      }
      result.label[pixel] = label;
    }
  }
}

void PixelAssigner::sum_up(std::size_t planes, int row_step, PlanePixels& result) const {
  result.cells.assign(planes, {});
  result.cell_label.assign(static_cast<std::size_t>(cells_.size()), kNoPlane);
  // Room for about as many cells as the planes cover: these lists are the largest memory in use.
  std::vector<std::size_t> covered(planes, 0);
  for (std::size_t i = 0; i < result.label.size(); i += kSide) {
    if (result.label[i] != kNoPlane) ++covered[static_cast<std::size_t>(result.label[i])];
  }
  for (std::size_t i = 0; i < planes; ++i) {
    result.cells[i].reserve(covered[i] * static_cast<std::size_t>(row_step) / kSide + kSide);
  }
  std::array<std::int16_t, kSide * kSide> labels{};
  for (int row = 0; row < cells_.rows(); ++row) {
    for (int column = 0; column < cells_.columns(); ++column) {
      const int distinct = distinct_labels(column, row, row_step, result.label, labels);
      const int cell = cells_.index(column, row);
      int most = 0;
      for (int k = 0; k < distinct; ++k) {
        const std::int16_t label = labels[static_cast<std::size_t>(k)];
        auto& of_plane = result.cells[static_cast<std::size_t>(label)];
        of_plane.push_back(sum_cell(column, row, label, row_step, result));
        if (of_plane.back().sums.pixels > most) {
          most = of_plane.back().sums.pixels;
          result.cell_label[static_cast<std::size_t>(cell)] = label;
        }
      }
    }
  }
}

// The planes in a cell, in the order of their first pixels.
int PixelAssigner::distinct_labels(int column, int row, int row_step,
                                   const std::vector<std::int16_t>& label,
                                   std::array<std::int16_t, kSide * kSide>& labels) const {
  const geometry::DepthImage& depth = frame_.depth;
  const int u_end = std::min((column + 1) * kSide, depth.width);
  const int v_end = std::min((row + 1) * kSide, depth.height);
  int distinct = 0;
  std::int16_t previous = kNoPlane;
  for (int v = row * kSide; v < v_end; v += row_step) {
    const std::int16_t* line = label.data() + static_cast<std::ptrdiff_t>(v) * depth.width;
    for (int u = column * kSide; u < u_end; ++u) {
      if (line[u] == previous || line[u] == kNoPlane) continue;
      previous = line[u];
      const auto end = labels.begin() + distinct;
      if (std::find(labels.begin(), end, previous) == end) {
        labels[static_cast<std::size_t>(distinct++)] = previous;
      }
    }
  }
  return distinct;
}

PlaneCell PixelAssigner::sum_cell(int column, int row, std::int16_t label, int row_step,
                                  const PlanePixels& pixels) const {
  const geometry::DepthImage& depth = frame_.depth;
  const geometry::CameraModel& camera = frame_.depth_camera;
  const int u0 = column * kSide, v0 = row * kSide;
  const int u_end = std::min(u0 + kSide, depth.width), v_end = std::min(v0 + kSide, depth.height);
  const bool has_color = frame_.color.width == depth.width && frame_.color.height == depth.height;

  const double per_fx = 1.0 / camera.fx;

  PlaneCell result;
  result.cell = cells_.index(column, row);
  PlaneSums& sums = result.sums;
  // Sums of 1, w, wz and wz² times monomials of the ray (x, y); y is the same along a row.
  double w = 0, wz = 0, wzx = 0, wzy = 0, s = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
  double n = 0, nx = 0, ny = 0, nxx = 0, nxy = 0, nyy = 0;
  for (int v = v0; v < v_end; v += row_step) {
    double row_wz = 0, row_wzx = 0, row_s = 0, row_sx = 0, row_n = 0, row_nx = 0;
    for (int u = u0; u < u_end; ++u) {
      const auto pixel = static_cast<std::size_t>(v * depth.width + u);
      if (pixels.label[pixel] != label) continue;
      result.box.extend(Eigen::Vector2i(u, v));
      const double x = (u - camera.cx) * per_fx;
      const std::size_t reading = depth.millimetres[pixel];
      const double z = 0.001 * static_cast<double>(reading);
      const double a = weight_[reading];
      const double b = a * z;
      const double c = b * z;
      const double cx = c * x;
      w += a;
      row_wz += b;
      row_wzx += b * x;
      row_s += c;
      row_sx += cx;
      sxx += cx * x;
      row_n += 1.0;
      row_nx += x;
      nxx += x * x;
      if (has_color) {
        for (std::size_t k = 0; k < 3; ++k) sums.color[k] += frame_.color.rgb[3 * pixel + k];
      }
    }
    const double y = (v - camera.cy) / camera.fy;
    wz += row_wz;
    wzx += row_wzx;
    wzy += y * row_wz;
    s += row_s;
    sx += row_sx;
    sy += y * row_s;
    sxy += y * row_sx;
    syy += y * y * row_s;
    n += row_n;
    nx += row_nx;
    ny += y * row_n;
    nxy += y * row_nx;
    nyy += y * y * row_n;
  }
  sums.pixels = static_cast<int>(n);
  sums.moments.weight = w;
  sums.moments.first << wzx, wzy, wz;
  sums.moments.second << sxx, sxy, sx, sxy, syy, sy, sx, sy, s;
  sums.moments.noise << nxx, nxy, nx, nxy, nyy, ny, nx, ny, n;
  return result;
}

}  // namespace geomap::perception
