// SPDX-License-Identifier: BSD-3-Clause
#include "perception/pixel_labels.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/multiversion.hpp"

namespace geomap::perception {
namespace {

constexpr int kSide = DepthCells::kSide;
constexpr int kReach = 2;           // cells from which a plane may claim pixels [cell]
constexpr int kMostCandidates = 8;  // planes competing for one cell
// A residual of the plane that the cell's seed names counts this much: without it, labels of two
// nearly coplanar planes would speckle.
constexpr float kOwnAdvantage = 0.6F;
constexpr double kLeastCosine = 0.1;
// Readings around a cell that decide between planes: up to so far off, every second one [pixel].
constexpr int kAround = 6;
constexpr int kAroundStep = 2;
constexpr float kNoneCost = 0.65F;  // a reading, if no plane is there; within a plane it costs 0.1
constexpr float kEdgeCost = 0.5F;   // that an edge must explain better than one plane
constexpr float kOwnEdge = 0.9F;    // what the seed's plane costs, compared with others

constexpr int kLanes = 16;
constexpr int kMostReadings = 64;  // a multiple of the lanes, and what lies around a cell at most
static_assert(kMostReadings >=
              ((kSide + 2 * kAround) / kAroundStep) * ((kSide + 2 * kAround) / kAroundStep));

// What readings are off a plane, squared, over what they may be, at most 1; and the plane's inverse
// depth. Elements beyond the readings have weight 0 and count nothing.
GEOMAP_MULTIVERSION void compare(const float* __restrict u, const float* __restrict v,
                                 const float* __restrict q, const float* __restrict tolerance,
                                 const float* __restrict weight, int size, float a, float b,
                                 float c, float uneven, float* __restrict square,
                                 float* __restrict predicted) {
  for (int i = 0; i < size; ++i) {
    predicted[i] = a * u[i] + b * v[i] + c;
    const float off = (predicted[i] - q[i]) / (tolerance[i] + uneven * q[i] * q[i]);
    square[i] = weight[i] * std::min(1.0F, off * off);
  }
}

// Sum of what readings are off the nearer of two planes; in a fixed order. What they are off the
// farther one is the rest of both planes' sums.
GEOMAP_MULTIVERSION float cost_of_nearer(const float* __restrict square_a,
                                         const float* __restrict square_b,
                                         const float* __restrict depth_a,
                                         const float* __restrict depth_b, int size) {
  std::array<float, kLanes> sums{};
  for (int block = 0; block < size; block += kLanes) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const int i = block + lane;
      // Read before the choice: GCC 12 masks all of a block's loads for AVX2 by its first half.
      const float a = square_a[i], b = square_b[i];
      sums[static_cast<std::size_t>(lane)] += depth_a[i] > depth_b[i] ? a : b;
    }
  }
  float sum = 0.0F;
  for (const float part : sums) sum += part;
  return sum;
}

GEOMAP_MULTIVERSION float sum_of(const float* __restrict square, int size) {
  std::array<float, kLanes> sums{};
  for (int block = 0; block < size; block += kLanes) {
    for (int lane = 0; lane < kLanes; ++lane) {
      sums[static_cast<std::size_t>(lane)] += square[block + lane];
    }
  }
  float sum = 0.0F;
  for (const float part : sums) sum += part;
  return sum;
}

// For each lane how many planes its reading is on, and the one it is least off; -1 for none.
GEOMAP_MULTIVERSION void take_better(const float* __restrict square, float handicap, int plane,
                                     float* __restrict best, int* __restrict which,
                                     int* __restrict on) {
  for (int i = 0; i < kLanes; ++i) {
    const bool is_on = square[i] < 1.0F;
    const float scored = is_on ? square[i] * handicap : 1e9F;
    const bool is_better = scored < best[i];
    on[i] += static_cast<int>(is_on);
    best[i] = is_better ? scored : best[i];
    which[i] = is_better ? plane : which[i];
  }
}

// label[c] where the five around it are the same, else kMixed.
constexpr std::int16_t kMixed = -2;
GEOMAP_MULTIVERSION void same_in_five(const std::int16_t* __restrict a,
                                      const std::int16_t* __restrict b,
                                      const std::int16_t* __restrict c,
                                      const std::int16_t* __restrict d,
                                      const std::int16_t* __restrict e, int size,
                                      std::int16_t* __restrict same) {
  for (int i = 0; i < size; ++i) {
    const bool all = (a[i] == c[i]) & (b[i] == c[i]) & (d[i] == c[i]) & (e[i] == c[i]);
    same[i] = all ? c[i] : kMixed;
  }
}

// Per cell its label where all around, within the reach, have the same; else kMixed.
std::vector<std::int16_t> inner_cells(const DepthCells& cells,
                                      const std::vector<std::int16_t>& label) {
  static_assert(kReach == 2);
  const int columns = cells.columns(), rows = cells.rows();
  std::vector<std::int16_t> across(label.size()), inner(label.size());
  std::vector<std::int16_t> padded(static_cast<std::size_t>(columns + 2 * kReach));
  const auto row_of = [columns](std::vector<std::int16_t>& image, int r) {
    return image.data() + static_cast<std::ptrdiff_t>(r) * columns;
  };
  for (int r = 0; r < rows; ++r) {
    const std::int16_t* line = label.data() + static_cast<std::ptrdiff_t>(r) * columns;
    std::fill_n(padded.begin(), kReach, line[0]);
    std::copy_n(line, columns, padded.begin() + kReach);
    std::fill_n(padded.end() - kReach, kReach, line[columns - 1]);
    const std::int16_t* p = padded.data();
    same_in_five(p, p + 1, p + 2, p + 3, p + 4, columns, row_of(across, r));
  }
  for (int r = 0; r < rows; ++r) {
    const auto at = [&](int step) { return row_of(across, std::clamp(r + step, 0, rows - 1)); };
    same_in_five(at(-2), at(-1), at(0), at(1), at(2), columns, row_of(inner, r));
  }
  return inner;
}

// Labels a row of pixels that one plane has to itself. `first` is the number of the first pixel.
GEOMAP_MULTIVERSION void label_row(const std::uint16_t* __restrict millimetres, int first,
                                   int count, float a, float row_c, float uneven,
                                   const float* __restrict inverse,
                                   const float* __restrict tolerance, std::int16_t plane,
                                   std::int16_t* __restrict label) {
  for (int i = 0; i < count; ++i) {
    const float q = inverse[millimetres[i]];
    const float off = std::abs(a * static_cast<float>(first + i) + row_c - q);
    const bool is_on = off <= tolerance[millimetres[i]] + uneven * q * q;
    label[i] = is_on ? plane : kNoPlane;
  }
}

}  // namespace

// A plane as a linear function of the pixel: inverse depth = a·u + b·v + c.
struct PixelLabeler::ImagePlane {
  float a = 0.0F, b = 0.0F, c = 0.0F;  // [1/m]
  Eigen::Vector3d normal;
  double distance = 0.0;  // from the camera [m]

  // Tolerance along the ray beside the rest [m], where the plane's inverse depth is q.
  float uneven(double unevenness, float q) const {
    const double cosine = distance * static_cast<double>(q);  // |n·ray|
    return static_cast<float>(unevenness / std::max(kLeastCosine, cosine));
  }
  float at(int u, int v) const { return a * static_cast<float>(u) + b * static_cast<float>(v) + c; }
};

struct PixelLabeler::Candidates {
  int count = 0;
  std::array<const ImagePlane*, kMostCandidates> plane;
  std::array<std::int16_t, kMostCandidates> label;
  std::array<float, kMostCandidates> uneven;  // [m]
  int own = -1;                               // which one the cell's seed names
};

// Readings, and what the candidates are off them.
struct PixelLabeler::Readings {
  int size = 0;   // readings
  int lanes = 0;  // with what fills up the last lanes
  alignas(64) std::array<float, kMostReadings> u, v, q, tolerance, weight;
  alignas(64) std::array<std::array<float, kMostReadings>, kMostCandidates> square, predicted;

  void compare_with(const Candidates& candidates) {
    for (int k = 0; k < candidates.count; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const ImagePlane& plane = *candidates.plane[at];
      compare(u.data(), v.data(), q.data(), tolerance.data(), weight.data(), lanes, plane.a,
              plane.b, plane.c, candidates.uneven[at], square[at].data(), predicted[at].data());
    }
  }
  float cost(int plane) const {
    return sum_of(square[static_cast<std::size_t>(plane)].data(), lanes);
  }
  // If of two planes the nearer one is what is seen.
  float cost_of_nearer_of(int a, int b) const {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    return cost_of_nearer(square[i].data(), square[j].data(), predicted[i].data(),
                          predicted[j].data(), lanes);
  }
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
  tolerance_.assign(kDepthValues, -1.0F);  // nothing is on a plane there
  const auto first = static_cast<std::size_t>(std::clamp(std::ceil(near * 1000.0), 1.0, 65534.0));
  const auto last = static_cast<std::size_t>(std::clamp(std::floor(far * 1000.0), 0.0, 65534.0));
  for (std::size_t mm = first; mm <= last; ++mm) {
    const double z = 0.001 * static_cast<double>(mm);
    inverse_[mm] = static_cast<float>(1.0 / z);
    tolerance_[mm] = static_cast<float>(tolerance.along_ray(z) / (z * z));  // dq = q² dz
  }
}

PixelLabeler::ImagePlane PixelLabeler::in_image(const geometry::Plane& plane) const {
  const geometry::CameraModel& camera = frame_.depth_camera;
  // On the plane n·p + d = 0 with p = ray/q: q = -n·ray/d.
  const Eigen::Vector3d m = -plane.normal / plane.d;
  ImagePlane result;
  result.a = static_cast<float>(m.x() / camera.fx);
  result.b = static_cast<float>(m.y() / camera.fy);
  result.c =
      static_cast<float>(m.z() - m.x() * camera.cx / camera.fx - m.y() * camera.cy / camera.fy);
  result.normal = plane.normal;
  result.distance = plane.d;
  return result;
}

std::vector<std::int16_t> PixelLabeler::label(const std::vector<geometry::Plane>& planes,
                                              const std::vector<std::int16_t>& cell_label) const {
  std::vector<ImagePlane> in_images;
  in_images.reserve(planes.size());
  for (const geometry::Plane& plane : planes) in_images.push_back(in_image(plane));
  std::vector<std::int16_t> labels(frame_.depth.millimetres.size(), kNoPlane);
  const std::vector<std::int16_t> inner = inner_cells(cells_, cell_label);
  for (int row = 0; row < cells_.rows(); ++row) {
    const std::int16_t* inner_row = inner.data() + cells_.index(0, row);
    for (int column = 0; column < cells_.columns(); ++column) {
      const std::int16_t own = inner_row[column];
      if (own == kNoPlane) continue;  // nothing near
      const int first = column;
      while (own != kMixed && column < cells_.columns() && inner_row[column] == own) ++column;
      if (column > first) {
        label_inner(first, column, row, in_images[static_cast<std::size_t>(own)], own, labels);
        --column;
        continue;
      }
      if (cells_.row(row, DepthCells::kCount)[column] == 0.0) continue;
      const Candidates candidates = candidates_at(column, row, in_images, cell_label);
      if (candidates.count > 0) label_cell(column, row, candidates, labels);
    }
  }
  return labels;
}

void PixelLabeler::label_inner(int first, int last, int row, const ImagePlane& plane,
                               std::int16_t label, std::vector<std::int16_t>& labels) const {
  const geometry::DepthImage& depth = frame_.depth;
  const int u_end = std::min(last * kSide, depth.width);
  const int v_end = std::min((row + 1) * kSide, depth.height);
  // Stretches short enough for one slope.
  constexpr int kStretch = 32;
  for (int v = row * kSide; v < v_end; ++v) {
    const std::ptrdiff_t line = static_cast<std::ptrdiff_t>(v) * depth.width;
    for (int u = first * kSide; u < u_end; u += kStretch) {
      const int count = std::min(kStretch, u_end - u);
      label_row(depth.millimetres.data() + line + u, u, count, plane.a,
                plane.b * static_cast<float>(v) + plane.c,
                plane.uneven(unevenness_, plane.at(u + count / 2, v)), inverse_.data(),
                tolerance_.data(), label, labels.data() + line + u);
    }
  }
}

PixelLabeler::Candidates PixelLabeler::candidates_at(
    int column, int row, const std::vector<ImagePlane>& planes,
    const std::vector<std::int16_t>& cell_label) const {
  const auto own_cell = static_cast<std::size_t>(cells_.index(column, row));
  std::array<std::int16_t, (2 * kReach + 1) * (2 * kReach + 1)> near{};
  std::size_t distinct = 0;
  const int c0 = std::max(0, column - kReach), c1 = std::min(cells_.columns(), column + kReach + 1);
  for (int r = std::max(0, row - kReach); r <= std::min(cells_.rows() - 1, row + kReach); ++r) {
    std::int16_t previous = kNoPlane;
    for (int c = c0; c < c1; ++c) {
      const std::int16_t label = cell_label[static_cast<std::size_t>(cells_.index(c, r))];
      if (label == previous || label == kNoPlane) continue;
      previous = label;
      const auto end = near.begin() + static_cast<std::ptrdiff_t>(distinct);
      if (std::find(near.begin(), end, label) == end) near[distinct++] = label;
    }
  }
  Candidates found;
  const int u = column * kSide + kSide / 2, v = row * kSide + kSide / 2;
  // Beside an edge the normal is that of one side, and blurred: the other side may compete.
  for (const bool agreeing : {true, false}) {
    for (std::size_t i = 0; i < distinct && found.count < kMostCandidates; ++i) {
      const ImagePlane& plane = planes[static_cast<std::size_t>(near[i])];
      if (normals_[own_cell].allows(plane.normal, cosine_) != agreeing) continue;
      const auto at = static_cast<std::size_t>(found.count++);
      found.plane[at] = &plane;
      found.label[at] = near[i];
      found.uneven[at] = plane.uneven(unevenness_, plane.at(u, v));
      if (near[i] == cell_label[own_cell]) found.own = static_cast<int>(at);
    }
    if (found.count == 0) break;
  }
  return found;
}

PixelLabeler::Readings PixelLabeler::read(int u_first, int v_first, int u_last, int v_last,
                                          int step) const {
  const geometry::DepthImage& depth = frame_.depth;
  Readings readings;
  for (int v = std::max(0, v_first); v < std::min(v_last, depth.height); v += step) {
    for (int u = std::max(0, u_first); u < std::min(u_last, depth.width); u += step) {
      const std::size_t reading = depth.at(u, v);
      if (inverse_[reading] == 0.0F) continue;
      const auto at = static_cast<std::size_t>(readings.size++);
      readings.u[at] = static_cast<float>(u);
      readings.v[at] = static_cast<float>(v);
      readings.q[at] = inverse_[reading];
      readings.tolerance[at] = tolerance_[reading];
      readings.weight[at] = 1.0F;
    }
  }
  readings.lanes = readings.size;
  for (; readings.lanes % kLanes != 0; ++readings.lanes) {
    const auto at = static_cast<std::size_t>(readings.lanes);
    readings.u[at] = readings.v[at] = readings.q[at] = readings.weight[at] = 0.0F;
    readings.tolerance[at] = 1.0F;
  }
  return readings;
}

void PixelLabeler::label_cell(int column, int row, const Candidates& candidates,
                              std::vector<std::int16_t>& labels) const {
  Readings own = read(column * kSide, row * kSide, (column + 1) * kSide, (row + 1) * kSide, 1);
  own.compare_with(candidates);
  alignas(64) std::array<float, kLanes> best;
  alignas(64) std::array<int, kLanes> which, on{};
  best.fill(1e8F);
  which.fill(-1);
  for (int k = 0; k < candidates.count; ++k) {
    const float handicap = k == candidates.own ? kOwnAdvantage * kOwnAdvantage : 1.0F;
    take_better(own.square[static_cast<std::size_t>(k)].data(), handicap, k, best.data(),
                which.data(), on.data());
  }
  bool is_clear = true;  // one plane has all
  for (int i = 0; i < own.size; ++i) {
    const auto at = static_cast<std::size_t>(i);
    is_clear &= on[at] == 1;
    if (which[at] < 0) continue;
    label_at(own, at, labels) = candidates.label[static_cast<std::size_t>(which[at])];
  }
  if (!is_clear) settle_cell(column, row, candidates, own, labels);
}

std::int16_t& PixelLabeler::label_at(const Readings& readings, std::size_t i,
                                     std::vector<std::int16_t>& labels) const {
  return labels[static_cast<std::size_t>(readings.v[i]) *
                    static_cast<std::size_t>(frame_.depth.width) +
                static_cast<std::size_t>(readings.u[i])];
}

// Where several planes are possible, as beside the line in which two of them meet, a single reading
// with its noise says little. What the readings around fit best decides: one plane everywhere, two
// that meet in an edge, of which the farther one is seen where it bulges (a box from outside), the
// nearer one where it recedes (a room's corner), or none, as where a plane cuts through clutter.
void PixelLabeler::settle_cell(int column, int row, const Candidates& candidates, Readings& own,
                               std::vector<std::int16_t>& labels) const {
  Readings around = read(column * kSide - kAround, row * kSide - kAround,
                         (column + 1) * kSide + kAround, (row + 1) * kSide + kAround, kAroundStep);
  around.compare_with(candidates);
  int first = -1, second = -1;  // none
  bool farther = false;
  const auto size = static_cast<float>(around.size);
  float least = kNoneCost * size;
  std::array<float, kMostCandidates> cost_alone{};
  for (int i = 0; i < candidates.count; ++i) {
    const float alone = cost_alone[static_cast<std::size_t>(i)] = around.cost(i);
    const float scored = alone * (i == candidates.own ? kOwnEdge : 1.0F);
    if (scored >= least) continue;
    least = scored;
    first = second = i;
  }
  for (int i = 0; i < candidates.count; ++i) {
    for (int j = 0; j < i; ++j) {
      const float both =
          cost_alone[static_cast<std::size_t>(i)] + cost_alone[static_cast<std::size_t>(j)];
      if (both - size + kEdgeCost >= least) continue;  // no edge between them could do better
      const float nearer = around.cost_of_nearer_of(i, j);
      for (const bool is_convex : {false, true}) {
        const float cost = (is_convex ? both - nearer : nearer) + kEdgeCost;
        if (cost >= least) continue;
        least = cost;
        first = i;
        second = j;
        farther = is_convex;
      }
    }
  }
  for (int i = 0; i < own.size; ++i) {
    const auto at = static_cast<std::size_t>(i);
    std::int16_t& label = label_at(own, at, labels);
    label = kNoPlane;
    if (first < 0) continue;
    const bool first_is_nearer = own.predicted[static_cast<std::size_t>(first)][at] >
                                 own.predicted[static_cast<std::size_t>(second)][at];
    const auto seen = static_cast<std::size_t>(first_is_nearer == farther ? second : first);
    if (own.square[seen][at] < 1.0F) label = candidates.label[seen];
  }
}

}  // namespace geomap::perception
