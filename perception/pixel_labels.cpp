// SPDX-License-Identifier: BSD-3-Clause
#include "perception/pixel_labels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "geometry/multiversion.hpp"
#include "perception/cell_label.hpp"
#include "perception/near_planes.hpp"
#include "perception/plane_extractor.hpp"

namespace geomap::perception {
namespace {

constexpr int kSide = DepthCells::kSide;
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

constexpr int kOwnLanes = kSide * kSide;
constexpr int kAroundSide = (kSide + 2 * kAround) / kAroundStep;
constexpr int kAroundLanes = kAroundSide * kAroundSide;
constexpr int kLanes = 16;
static_assert(kOwnLanes == kLanes && kAroundLanes % kLanes == 0);

// Where the readings of a square block are from its first one [pixel].
template <int kBlockSide, int kStep>
struct Offsets {
  alignas(64) std::array<float, kBlockSide * kBlockSide> u, v;

  constexpr Offsets() : u(), v() {
    for (std::size_t i = 0; i < u.size(); ++i) {
      u[i] = static_cast<float>(static_cast<int>(i) % kBlockSide * kStep);
      v[i] = static_cast<float>(static_cast<int>(i) / kBlockSide * kStep);
    }
  }
};

// What readings are off a plane, squared, over what they may be, at most 1; and the plane's inverse
// depth, of which c is that at the block's first reading. Where nothing was read q is 0, which
// counts nothing.
GEOMAP_MULTIVERSION void compare(const float* __restrict u, const float* __restrict v,
                                 const float* __restrict q, const float* __restrict tolerance,
                                 int size, float a, float b, float c, float uneven,
                                 float* __restrict square, float* __restrict predicted) {
  for (int i = 0; i < size; ++i) {
    predicted[i] = a * u[i] + b * v[i] + c;
    const float off = (predicted[i] - q[i]) / (tolerance[i] + uneven * q[i] * q[i]);
    square[i] = q[i] > 0.0F ? std::min(1.0F, off * off) : 0.0F;
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

// What is known of a depth reading by its value [mm].
class ReadingTable {
 public:
  ReadingTable(const DepthTolerance& tolerance, double near, double far)
      : inverse_(kValues, 0.0F), tolerance_(kValues, -1.0F) {
    const auto millimetres = [](double z) {
      return static_cast<std::size_t>(std::clamp(z, 1.0, kValues - 2.0));
    };
    const std::size_t first = millimetres(std::ceil(near * 1000.0)),
                      last = millimetres(std::floor(far * 1000.0));
    for (std::size_t mm = first; mm <= last; ++mm) {
      const double z = 0.001 * static_cast<double>(mm);
      inverse_[mm] = static_cast<float>(1.0 / z);
      tolerance_[mm] = static_cast<float>(tolerance.along_ray(z) / (z * z));  // dq = q² dz
    }
  }
  // Inverse depth [1/m]; 0 where the reading is out of range.
  const float* inverse() const { return inverse_.data(); }
  // Of inverse depth [1/m]; negative where the reading is out of range.
  const float* tolerance() const { return tolerance_.data(); }

 private:
  static constexpr std::size_t kValues = 65536;
  std::vector<float> inverse_, tolerance_;
};

// Every second reading of every second row, with a border of none around the image.
class ThinReadings {
 public:
  ThinReadings(const geometry::DepthImage& depth, const ReadingTable& table)
      : stride_((depth.width + kAroundStep - 1) / kAroundStep + 2 * kBorder) {
    const int rows = (depth.height + kAroundStep - 1) / kAroundStep + 2 * kBorder;
    const auto size = static_cast<std::size_t>(stride_) * static_cast<std::size_t>(rows);
    q_.assign(size, 0.0F);
    tolerance_.assign(size, 1.0F);
    for (int v = 0; v < depth.height; v += kAroundStep) {
      std::size_t at = index(0, v);
      for (int u = 0; u < depth.width; u += kAroundStep, ++at) {
        const std::size_t reading = depth.at(u, v);
        q_[at] = table.inverse()[reading];
        tolerance_[at] = q_[at] > 0.0F ? table.tolerance()[reading] : 1.0F;
      }
    }
  }
  // From a pixel of the grid, which may be in the border.
  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>((v / kAroundStep + kBorder) * stride_ + u / kAroundStep +
                                    kBorder);
  }
  int stride() const { return stride_; }
  const float* q() const { return q_.data(); }
  const float* tolerance() const { return tolerance_.data(); }

 private:
  static_assert(kAround % kAroundStep == 0 && kSide % kAroundStep == 0);
  static constexpr int kBorder = (kSide + kAround) / kAroundStep;
  int stride_;
  std::vector<float> q_, tolerance_;
};

// A plane as a linear function of the pixel: inverse depth = a·u + b·v + c.
struct ImagePlane {
  float a = 0.0F, b = 0.0F, c = 0.0F;  // [1/m]
  Eigen::Vector3d normal;
  double distance = 0.0;  // from the camera [m]

  ImagePlane(const geometry::Plane& plane, const geometry::CameraModel& camera)
      : normal(plane.normal), distance(plane.d) {
    // On the plane n·p + d = 0 with p = ray/q: q = -n·ray/d.
    const Eigen::Vector3d m = -plane.normal / plane.d;
    a = static_cast<float>(m.x() / camera.fx);
    b = static_cast<float>(m.y() / camera.fy);
    c = static_cast<float>(m.z() - m.x() * camera.cx / camera.fx - m.y() * camera.cy / camera.fy);
  }
  // Tolerance along the ray beside the rest [m], where the plane's inverse depth is q.
  float uneven(double unevenness, float q) const {
    const double cosine = distance * static_cast<double>(q);  // |n·ray|
    return static_cast<float>(unevenness / std::max(kLeastCosine, cosine));
  }
  float at(int u, int v) const { return a * static_cast<float>(u) + b * static_cast<float>(v) + c; }
};

struct Candidates {
  int count = 0;
  std::array<const ImagePlane*, kMostCandidates> plane;
  std::array<std::int16_t, kMostCandidates> label;
  std::array<float, kMostCandidates> uneven;  // [m]
  int own = -1;                               // which one the cell's seed names
};

// A square block of readings, and what the candidates are off them.
template <int kBlockSide, int kStep>
struct Block {
  static constexpr int kSize = kBlockSide * kBlockSide;
  alignas(64) std::array<float, kSize> q, tolerance;  // q = 0 where nothing was read
  alignas(64) std::array<std::array<float, kSize>, kMostCandidates> square, predicted;

  void compare_with(const Candidates& candidates, int u, int v) {
    static constexpr Offsets<kBlockSide, kStep> kOffsets;
    for (int k = 0; k < candidates.count; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const ImagePlane& plane = *candidates.plane[at];
      compare(kOffsets.u.data(), kOffsets.v.data(), q.data(), tolerance.data(), kSize, plane.a,
              plane.b, plane.at(u, v), candidates.uneven[at], square[at].data(),
              predicted[at].data());
    }
  }
  float cost(int plane) const {
    return sum_of(square[static_cast<std::size_t>(plane)].data(), kSize);
  }
  // If of two planes the nearer one is what is seen.
  float cost_of_nearer_of(int a, int b) const {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    return cost_of_nearer(square[i].data(), square[j].data(), predicted[i].data(),
                          predicted[j].data(), kSize);
  }
};
using OwnBlock = Block<kSide, 1>;
using AroundBlock = Block<kAroundSide, kAroundStep>;

// What a block of readings fits best.
struct Explanation {
  int first = -1, second = -1;  // candidates; the same for one plane, negative for none
  bool farther = false;         // of the two, the farther one is seen
};

Explanation explain(const AroundBlock& around, const Candidates& candidates) {
  Explanation best;
  const auto size = static_cast<float>(
      std::count_if(around.q.begin(), around.q.end(), [](float q) { return q > 0.0F; }));
  float least = kNoneCost * size;
  std::array<float, kMostCandidates> cost_alone{};
  for (int i = 0; i < candidates.count; ++i) {
    const float alone = cost_alone[static_cast<std::size_t>(i)] = around.cost(i);
    const float scored = alone * (i == candidates.own ? kOwnEdge : 1.0F);
    if (scored >= least) continue;
    least = scored;
    best = {i, i, false};
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
        best = {i, j, is_convex};
      }
    }
  }
  return best;
}

class Labeler {
 public:
  Labeler(const geometry::RgbdFrame& frame, const DepthCells& cells,
          const std::vector<CellNormal>& normals, const DepthTolerance& tolerance,
          const CellRegions& regions, const LabelSettings& settings)
      : depth_(frame.depth),
        cells_(cells),
        normals_(normals),
        cell_label_(regions.cell_label),
        unevenness_(tolerance.unevenness),
        cosine_(std::cos(settings.max_normal_angle)),
        near_(cells, regions.cell_label, regions.planes.size()),
        table_(tolerance, settings.near, settings.far),
        thin_(frame.depth, table_),
        labels_(frame.depth.millimetres.size(), kNoPlane) {
    planes_.reserve(regions.planes.size());
    for (const geometry::Plane& plane : regions.planes) {
      planes_.emplace_back(plane, frame.depth_camera);
    }
  }

  std::vector<std::int16_t> label_all() && {
    for (int row = 0; row < cells_.rows(); ++row) label_cells(row);
    return std::move(labels_);
  }

 private:
  void label_cells(int row) {
    const double* readings = cells_.row(row, DepthCells::kCount);
    for (int column = 0; column < cells_.columns();) {
      const int first = column;
      const std::int16_t plane = only_plane(column, row);
      if (plane != kNoPlane) {
        do ++column;
        while (column < cells_.columns() && only_plane(column, row) == plane);
        label_run(first, column, row, plane);
        continue;
      }
      ++column;
      if (readings[first] == 0.0) continue;
      const Candidates candidates = candidates_at(first, row);
      if (candidates.count > 0) label_cell(first, row, candidates);
    }
  }

  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(cells_.index(column, row));
  }

  // The one plane that a cell may be on, or kNoPlane.
  std::int16_t only_plane(int column, int row) const {
    const std::size_t cell = index(column, row);
    const int only = near_.only(cell);
    if (only < 0) return kNoPlane;
    const ImagePlane& plane = planes_[static_cast<std::size_t>(only)];
    return normals_[cell].allows(plane.normal, cosine_) ? static_cast<std::int16_t>(only)
                                                        : kNoPlane;
  }

  // Cells that one plane has to itself.
  void label_run(int first, int last, int row, std::int16_t label) {
    const ImagePlane& plane = planes_[static_cast<std::size_t>(label)];
    const int u_end = std::min(last * kSide, depth_.width);
    const int v_end = std::min((row + 1) * kSide, depth_.height);
    constexpr int kStretch = 32;  // short enough for one slope [pixel]
    for (int v = row * kSide; v < v_end; ++v) {
      const std::ptrdiff_t line = static_cast<std::ptrdiff_t>(v) * depth_.width;
      for (int u = first * kSide; u < u_end; u += kStretch) {
        const int count = std::min(kStretch, u_end - u);
        label_row(depth_.millimetres.data() + line + u, u, count, plane.a,
                  plane.b * static_cast<float>(v) + plane.c,
                  plane.uneven(unevenness_, plane.at(u + count / 2, v)), table_.inverse(),
                  table_.tolerance(), label, labels_.data() + line + u);
      }
    }
    for (int column = first; column < last; ++column) {
      if (has_all(column, row, label)) continue;
      const Candidates candidates = candidates_at(column, row);
      OwnBlock own = own_block(column, row);
      own.compare_with(candidates, column * kSide, row * kSide);
      settle_cell(column, row, candidates, own);
    }
  }

  // Are all readings of a cell labelled?
  bool has_all(int column, int row, std::int16_t label) const {
    if (common_label(labels_, depth_, column, row) == label) return true;
    int count = 0;
    const int u_end = std::min((column + 1) * kSide, depth_.width);
    const int v_end = std::min((row + 1) * kSide, depth_.height);
    for (int v = row * kSide; v < v_end; ++v) {
      const std::int16_t* line = labels_.data() + static_cast<std::ptrdiff_t>(v) * depth_.width;
      for (int u = column * kSide; u < u_end; ++u) count += static_cast<int>(line[u] == label);
    }
    return count == static_cast<int>(cells_.row(row, DepthCells::kCount)[column]);
  }

  Candidates candidates_at(int column, int row) const {
    const std::size_t cell = index(column, row);
    const int u = column * kSide + kSide / 2, v = row * kSide + kSide / 2;
    Candidates found;
    // Beside an edge the normal is that of one side, and blurred: the other side may compete.
    for (const bool agreeing : {true, false}) {
      near_.visit(cell, [&](std::size_t i) {
        const ImagePlane& plane = planes_[i];
        if (found.count == kMostCandidates ||
            normals_[cell].allows(plane.normal, cosine_) != agreeing) {
          return;
        }
        const auto at = static_cast<std::size_t>(found.count++);
        found.plane[at] = &plane;
        found.label[at] = static_cast<std::int16_t>(i);
        found.uneven[at] = plane.uneven(unevenness_, plane.at(u, v));
        if (found.label[at] == cell_label_[cell]) found.own = static_cast<int>(at);
      });
      if (found.count == 0) break;
    }
    return found;
  }

  OwnBlock own_block(int column, int row) const {
    OwnBlock own;
    for (int j = 0; j < kSide; ++j) {
      for (int i = 0; i < kSide; ++i) {
        const int u = column * kSide + i, v = row * kSide + j;
        const auto at = static_cast<std::size_t>(j * kSide + i);
        const bool is_in = u < depth_.width && v < depth_.height;
        const std::size_t reading = is_in ? depth_.at(u, v) : geometry::DepthImage::kNoReading;
        own.q[at] = table_.inverse()[reading];
        own.tolerance[at] = own.q[at] > 0.0F ? table_.tolerance()[reading] : 1.0F;
      }
    }
    return own;
  }

  AroundBlock block_around(int column, int row) const {
    AroundBlock around;
    const std::size_t first = thin_.index(column * kSide - kAround, row * kSide - kAround);
    for (int j = 0; j < kAroundSide; ++j) {
      const std::ptrdiff_t from = static_cast<std::ptrdiff_t>(first) + j * thin_.stride();
      std::copy_n(thin_.q() + from, kAroundSide, around.q.begin() + j * kAroundSide);
      std::copy_n(thin_.tolerance() + from, kAroundSide,
                  around.tolerance.begin() + j * kAroundSide);
    }
    return around;
  }

  void label_cell(int column, int row, const Candidates& candidates) {
    OwnBlock own = own_block(column, row);
    own.compare_with(candidates, column * kSide, row * kSide);
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
    for (std::size_t i = 0; i < own.q.size(); ++i) is_clear &= own.q[i] == 0.0F || on[i] == 1;
    if (!is_clear) {
      settle_cell(column, row, candidates, own);
      return;
    }
    for (std::size_t i = 0; i < own.q.size(); ++i) {
      if (own.q[i] == 0.0F || which[i] < 0) continue;
      label_at(column, row, i) = candidates.label[static_cast<std::size_t>(which[i])];
    }
  }

  std::int16_t& label_at(int column, int row, std::size_t i) {
    const int u = column * kSide + static_cast<int>(i) % kSide;
    const int v = row * kSide + static_cast<int>(i) / kSide;
    return labels_[static_cast<std::size_t>(v) * static_cast<std::size_t>(depth_.width) +
                   static_cast<std::size_t>(u)];
  }

  // Where several planes are possible, as beside the line in which two of them meet, a single
  // reading with its noise says little. What the readings around fit best decides: one plane
  // everywhere, two that meet in an edge, of which the farther one is seen where it bulges (a box
  // from outside), the nearer one where it recedes (a room's corner), or none, as where a plane
  // cuts through clutter.
  void settle_cell(int column, int row, const Candidates& candidates, const OwnBlock& own) {
    AroundBlock around = block_around(column, row);
    around.compare_with(candidates, column * kSide - kAround, row * kSide - kAround);
    const Explanation best = explain(around, candidates);
    for (std::size_t i = 0; i < own.q.size(); ++i) {
      if (own.q[i] == 0.0F) continue;
      std::int16_t& label = label_at(column, row, i);
      label = kNoPlane;
      if (best.first < 0) continue;
      const auto first = static_cast<std::size_t>(best.first),
                 second = static_cast<std::size_t>(best.second);
      const bool first_is_nearer = own.predicted[first][i] > own.predicted[second][i];
      const std::size_t seen = first_is_nearer == best.farther ? second : first;
      if (own.square[seen][i] < 1.0F) label = candidates.label[seen];
    }
  }

  const geometry::DepthImage& depth_;
  const DepthCells& cells_;
  const std::vector<CellNormal>& normals_;
  const std::vector<std::int16_t>& cell_label_;
  double unevenness_;  // tolerance along the normal, beside the rest [m]
  double cosine_;      // of the largest angle between normals
  NearPlanes near_;
  ReadingTable table_;
  ThinReadings thin_;
  std::vector<ImagePlane> planes_;
  std::vector<std::int16_t> labels_;
};

}  // namespace

std::vector<std::int16_t> label_pixels(const geometry::RgbdFrame& frame, const DepthCells& cells,
                                       const std::vector<CellNormal>& normals,
                                       const DepthTolerance& tolerance, const CellRegions& regions,
                                       const LabelSettings& settings) {
  return Labeler(frame, cells, normals, tolerance, regions, settings).label_all();
}

}  // namespace geomap::perception
