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
// Of the tolerance of a reading, for the mean of a cell's.
constexpr double kCellShare = 0.5;
// Readings around a cell that decide between planes: up to so far off, every second one [pixel].
constexpr int kAround = 6;
constexpr int kAroundStep = 2;
constexpr int kMostReadings =
    ((kSide + 2 * kAround + 1) / kAroundStep) * ((kSide + 2 * kAround + 1) / kAroundStep);
constexpr float kNoneCost = 0.65F;  // a reading, if no plane is there; within a plane it costs 0.1
constexpr float kEdgeCost = 0.5F;   // that an edge must explain better than one plane
constexpr float kOwnEdge = 0.9F;    // what the seed's plane costs, compared with others

}  // namespace

// A plane as a linear function of the pixel: inverse depth = a·u + b·v + c.
struct PixelLabeler::Candidate {
  float a = 0.0F, b = 0.0F, c = 0.0F;  // [1/m]
  float uneven = 0.0F;                 // tolerance along the ray beside the rest [m]
  float handicap = 1.0F;
  std::int16_t label = kNoPlane;
};

// What the candidates are off the readings around a cell, and where they are.
struct PixelLabeler::Neighbourhood {
  int size = 0;                                                      // readings
  std::array<float, kMostReadings * kMostCandidates> square;         // of the misfit, at most 1
  std::array<float, kMostReadings * kMostCandidates> inverse_depth;  // [1/m]

  // If of two planes the farther or the nearer one is what is seen.
  float cost(int a, int b, bool farther) const {
    float sum = 0.0F;
    for (int i = 0; i < size; ++i) {
      const auto of_a = static_cast<std::size_t>(i * kMostCandidates + a);
      const auto of_b = static_cast<std::size_t>(i * kMostCandidates + b);
      const bool a_is_nearer = inverse_depth[of_a] > inverse_depth[of_b];
      sum += a_is_nearer == farther ? square[of_b] : square[of_a];
    }
    return sum;
  }
};

float PixelLabeler::inverse_depth(const Candidate& plane, int u, int v) {
  return plane.a * static_cast<float>(u) + plane.b * static_cast<float>(v) + plane.c;
}

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
      const int count =
          candidates_at(column, row, planes, cell_label, row_step > 1, candidates.data());
      if (count > 0) label_cell(column, row, candidates.data(), count, row_step, labels);
    }
  }
  return labels;
}

int PixelLabeler::candidates_at(int column, int row, const std::vector<geometry::Plane>& planes,
                                const std::vector<std::int16_t>& cell_label, bool is_quick,
                                Candidate* candidates) const {
  const auto own_cell = static_cast<std::size_t>(cells_.index(column, row));
  const std::int16_t own = cell_label[own_cell];
  int count = 0;
  const auto add = [&](std::int16_t label) {
    const bool is_known = std::any_of(candidates, candidates + count,
                                      [label](const Candidate& k) { return k.label == label; });
    if (is_known || count == kMostCandidates) return;
    candidates[count++] =
        candidate_of(planes[static_cast<std::size_t>(label)], label, label == own, column, row);
  };
  const auto add_neighbours = [&](bool agreeing) {
    std::int16_t previous = kNoPlane;
    for (int r = std::max(0, row - kReach); r <= std::min(cells_.rows() - 1, row + kReach); ++r) {
      const int c_end = std::min(cells_.columns() - 1, column + kReach);
      for (int c = std::max(0, column - kReach); c <= c_end; ++c) {
        const std::int16_t label = cell_label[static_cast<std::size_t>(cells_.index(c, r))];
        if (label == previous || label == kNoPlane) continue;
        previous = label;
        if (agrees(planes[static_cast<std::size_t>(label)], own_cell) == agreeing) add(label);
      }
    }
  };
  add_neighbours(true);
  if (is_quick) return count;
  for (std::size_t i = 0; own == kNoPlane && i < planes.size(); ++i) {
    if (is_on(planes[i], own_cell)) add(static_cast<std::int16_t>(i));
  }
  // Beside an edge the normal is that of one side, and blurred: the other side may compete.
  if (count > 0) add_neighbours(false);
  return count;
}

// Parts of a plane may be too narrow to be found by themselves: the readings of the cell lie on it,
// and its normal agrees.
bool PixelLabeler::is_on(const geometry::Plane& plane, std::size_t cell) const {
  const Eigen::Vector3d point = cells_.cell(static_cast<int>(cell)).mean_point();
  const double cosine = std::abs(plane.normal.dot(point)) / point.z();
  const auto millimetres = static_cast<std::size_t>(std::lround(1000.0 * point.z()));
  const double allowed = kCellShare * (tolerance_[millimetres] * cosine + unevenness_);
  if (std::abs(plane.signed_distance(point)) > allowed) return false;
  return normals_[cell].kind == CellNormal::Kind::kPlanar && agrees(plane, cell);
}

// False where the cell's own normal says otherwise.
bool PixelLabeler::agrees(const geometry::Plane& plane, std::size_t cell) const {
  const CellNormal& normal = normals_[cell];
  return normal.kind != CellNormal::Kind::kPlanar || normal.normal.dot(plane.normal) >= cosine_;
}

PixelLabeler::Candidate PixelLabeler::candidate_of(const geometry::Plane& plane, std::int16_t label,
                                                   bool is_own, int column, int row) const {
  const geometry::CameraModel& camera = frame_.depth_camera;
  // On the plane n·p + d = 0 with p = ray/q: q = -n·ray/d.
  const Eigen::Vector3d m = -plane.normal / plane.d;
  const double cosine =
      std::abs(plane.normal.dot(camera.ray(column * kSide + 1.5, row * kSide + 1.5)));
  Candidate k;
  k.a = static_cast<float>(m.x() / camera.fx);
  k.b = static_cast<float>(m.y() / camera.fy);
  k.c = static_cast<float>(m.z() - m.x() * camera.cx / camera.fx - m.y() * camera.cy / camera.fy);
  k.uneven = static_cast<float>(unevenness_ / std::max(kLeastCosine, cosine));
  k.handicap = is_own ? kOwnAdvantage : 1.0F;
  k.label = label;
  return k;
}

void PixelLabeler::label_cell(int column, int row, const Candidate* candidates, int count,
                              int row_step, std::vector<std::int16_t>& labels) const {
  const geometry::DepthImage& depth = frame_.depth;
  const int u_end = std::min((column + 1) * kSide, depth.width);
  const int v_end = std::min((row + 1) * kSide, depth.height);
  bool is_clear = true;  // one plane has all
  for (int v = row * kSide; v < v_end; v += row_step) {
    const std::size_t line = static_cast<std::size_t>(v) * static_cast<std::size_t>(depth.width);
    for (int u = column * kSide; u < u_end; ++u) {
      const std::size_t pixel = line + static_cast<std::size_t>(u);
      if (inverse_[depth.millimetres[pixel]] == 0.0F) continue;
      float best = 1e9F;
      std::int16_t label = kNoPlane;
      for (int k = 0; k < count; ++k) {
        const float off = misfit(candidates[k], u, v);
        if (off > 1.0F) continue;
        is_clear &= label == kNoPlane;
        const float scored = off * candidates[k].handicap;
        const bool is_better = scored < best;
        best = is_better ? scored : best;
        label = is_better ? candidates[k].label : label;
      }
      labels[pixel] = label;
      is_clear &= label != kNoPlane;
    }
  }
  if (!is_clear && row_step == 1) settle_cell(column, row, candidates, count, labels);
}

// What a reading is off a plane, over what it may be.
float PixelLabeler::misfit(const Candidate& plane, int u, int v) const {
  const std::size_t reading = frame_.depth.at(u, v);
  const float q = inverse_[reading];
  return std::abs(inverse_depth(plane, u, v) - q) /
         ((tolerance_[reading] + plane.uneven) * q * q);  // dq = q² dz
}

// Where several planes are possible, as beside the line in which two of them meet, a single reading
// with its noise says little. What the readings around fit best decides: one plane everywhere, two
// that meet in an edge, of which the farther one is seen where it bulges (a box from outside), the
// nearer one where it recedes (a room's corner), or none, as where a plane cuts through clutter.
void PixelLabeler::settle_cell(int column, int row, const Candidate* candidates, int count,
                               std::vector<std::int16_t>& labels) const {
  const Neighbourhood around = neighbourhood(column, row, candidates, count);
  int first = -1, second = -1;  // none
  bool farther = false;
  float least = kNoneCost * static_cast<float>(around.size);
  for (int i = 0; i < count; ++i) {
    const float alone =
        around.cost(i, i, false) * (candidates[i].handicap < 1.0F ? kOwnEdge : 1.0F);
    if (alone < least) {
      least = alone;
      first = second = i;
    }
    for (int j = 0; j < i; ++j) {
      for (const bool is_convex : {false, true}) {
        const float cost = around.cost(i, j, is_convex) + kEdgeCost;
        if (cost >= least) continue;
        least = cost;
        first = i;
        second = j;
        farther = is_convex;
      }
    }
  }
  const geometry::DepthImage& depth = frame_.depth;
  for (int v = row * kSide; v < std::min((row + 1) * kSide, depth.height); ++v) {
    for (int u = column * kSide; u < std::min((column + 1) * kSide, depth.width); ++u) {
      if (inverse_[depth.at(u, v)] == 0.0F) continue;
      std::int16_t& label =
          labels[static_cast<std::size_t>(v) * static_cast<std::size_t>(depth.width) +
                 static_cast<std::size_t>(u)];
      label = kNoPlane;
      if (first < 0) continue;
      const bool first_is_nearer =
          inverse_depth(candidates[first], u, v) > inverse_depth(candidates[second], u, v);
      const Candidate& seen = candidates[first_is_nearer == farther ? second : first];
      if (misfit(seen, u, v) <= 1.0F) label = seen.label;
    }
  }
}

PixelLabeler::Neighbourhood PixelLabeler::neighbourhood(int column, int row,
                                                        const Candidate* candidates,
                                                        int count) const {
  const geometry::DepthImage& depth = frame_.depth;
  Neighbourhood around;
  const int u_end = std::min((column + 1) * kSide + kAround, depth.width);
  const int v_end = std::min((row + 1) * kSide + kAround, depth.height);
  for (int v = std::max(0, row * kSide - kAround); v < v_end; v += kAroundStep) {
    for (int u = std::max(0, column * kSide - kAround); u < u_end; u += kAroundStep) {
      if (inverse_[depth.at(u, v)] == 0.0F) continue;
      for (int k = 0; k < count; ++k) {
        const float off = misfit(candidates[k], u, v);
        const auto at = static_cast<std::size_t>(around.size * kMostCandidates + k);
        around.square[at] = std::min(1.0F, off * off);
        around.inverse_depth[at] = inverse_depth(candidates[k], u, v);
      }
      ++around.size;
    }
  }
  return around;
}

}  // namespace geomap::perception
