// SPDX-License-Identifier: BSD-3-Clause
#include "perception/pixel_labels.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace geomap::perception {
namespace {

constexpr int kSide = DepthCells::kSide;
constexpr int kReach = 2;           // cells from which a plane may claim pixels [cell]
constexpr int kMostCandidates = 8;  // planes competing for one cell
// A residual of the plane that the cell's seed names counts this much: without it, labels of two
// nearly coplanar planes would speckle.
constexpr float kOwnAdvantage = 0.6F;
constexpr double kLeastCosine = 0.1;

}  // namespace

// A plane as a linear function of the pixel: inverse depth = a·u + b·v + c.
struct PixelLabeler::Candidate {
  float a = 0.0F, b = 0.0F, c = 0.0F;  // [1/m]
  float uneven = 0.0F;                 // tolerance along the ray beside the rest [m]
  float handicap = 1.0F;
  std::int16_t label = kNoPlane;
};

PixelLabeler::PixelLabeler(const geometry::RgbdFrame& frame, const DepthCells& cells,
                           const std::vector<CellNormal>& normals, const DepthTolerance& tolerance,
                           double near, double far, double max_normal_angle)
    : frame_(frame),
      cells_(cells),
      normals_(normals),
      unevenness_(tolerance.unevenness),
      cosine_(std::cos(max_normal_angle)) {
  constexpr std::size_t kDepthValues = 65536;
  inverse_.assign(kDepthValues, 0.0F);
  tolerance_.assign(kDepthValues, 0.0F);
  const auto first = static_cast<std::size_t>(std::clamp(std::ceil(near * 1000.0), 1.0, 65534.0));
  const auto last = static_cast<std::size_t>(std::clamp(std::floor(far * 1000.0), 0.0, 65534.0));
  for (std::size_t mm = first; mm <= last; ++mm) {
    const double z = 0.001 * static_cast<double>(mm);
    inverse_[mm] = static_cast<float>(1.0 / z);
    tolerance_[mm] = static_cast<float>(tolerance.along_ray(z));
  }
}

std::vector<std::int16_t> PixelLabeler::label(const std::vector<geometry::Plane>& planes,
                                              const std::vector<std::int16_t>& cell_label,
                                              int row_step) const {
  std::vector<std::int16_t> labels(frame_.depth.millimetres.size(), kNoPlane);
  std::array<Candidate, kMostCandidates> candidates;
  for (int row = 0; row < cells_.rows(); ++row) {
    for (int column = 0; column < cells_.columns(); ++column) {
      if (cells_.cell(cells_.index(column, row)).count == 0.0) continue;
      const int count = candidates_at(column, row, planes, cell_label, candidates.data());
      if (count > 0) label_cell(column, row, candidates.data(), count, row_step, labels);
    }
  }
  return labels;
}

int PixelLabeler::candidates_at(int column, int row, const std::vector<geometry::Plane>& planes,
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
      if (normal.kind == CellNormal::Kind::kPlanar && normal.normal.dot(plane.normal) < cosine_) {
        continue;
      }
      // On the plane n·p + d = 0 with p = ray/q: q = -n·ray/d.
      const Eigen::Vector3d m = -plane.normal / plane.d;
      const double cosine =
          std::abs(plane.normal.dot(camera.ray(column * kSide + 1.5, row * kSide + 1.5)));
      Candidate& k = candidates[count++];
      k.a = static_cast<float>(m.x() / camera.fx);
      k.b = static_cast<float>(m.y() / camera.fy);
      k.c =
          static_cast<float>(m.z() - m.x() * camera.cx / camera.fx - m.y() * camera.cy / camera.fy);
      k.uneven = static_cast<float>(unevenness_ / std::max(kLeastCosine, cosine));
      k.handicap = label == own ? kOwnAdvantage : 1.0F;
      k.label = label;
    }
  }
  return count;
}

void PixelLabeler::label_cell(int column, int row, const Candidate* candidates, int count,
                              int row_step, std::vector<std::int16_t>& labels) const {
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
        const float allowed = (tolerance_[reading] + plane.uneven) * q * q;  // dq = q² dz
        const bool is_better = off <= allowed && scored < best;
        best = is_better ? scored : best;
        label = is_better ? plane.label : label;
      }
      labels[pixel] = label;
    }
  }
}

}  // namespace geomap::perception
