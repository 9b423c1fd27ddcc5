// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "geometry/multiversion.hpp"
#include "perception/plane_extractor.hpp"
#include "perception/surface_region.hpp"

namespace geomap::perception {
namespace {

constexpr int kReach = 3;          // cells between regions that count as touching [cell]
constexpr int kLeastContacts = 4;  // pairs of cells
constexpr int kRounds = 3;         // of adding the cells beside a region
constexpr int kAlone = 2;          // no plane is nearer than that [cell]
// Share of the tolerance that a region's rms about the joint plane may take. A half is 1.5 sigma.
constexpr double kRmsShare = 0.5;

// A far smaller region within nearly the whole tolerance of a larger one is a shell of left-overs,
// or relief that the sensor cannot tell from the surface: the larger one takes its cells, but its
// fit stays.
constexpr double kShellRmsShare = 0.8;
constexpr double kShellPixels = 0.3;      // at most, over those of the larger region
constexpr double kShellAngleRatio = 2.0;  // largest angle, over that of joining

// A region across an edge that noise has made up: its cells lie on the planes beside it nearly as
// well as noise lets them. Mean square of what they are off, over that of noise; far more than this
// is cut off, so that a few cells do not decide.
constexpr double kMadeUp = 3.0;
constexpr double kFarOff = 16.0;

using Contacts = std::map<std::pair<int, int>, int>;  // pairs of regions, smaller index first

// Where two cells are of different regions.
GEOMAP_MULTIVERSION void find_contacts(const std::int16_t* __restrict a,
                                       const std::int16_t* __restrict b, int size,
                                       std::uint8_t* __restrict is_contact) {
  for (int i = 0; i < size; ++i) {
    is_contact[i] = static_cast<std::uint8_t>(
        static_cast<int>(a[i] >= 0) & static_cast<int>(b[i] >= 0) & static_cast<int>(a[i] != b[i]));
  }
}

Contacts count_contacts(const DepthCells& cells, const std::vector<std::int16_t>& label) {
  Contacts contacts;
  Contacts::iterator last = contacts.end();  // along a border it is the same pair again and again
  std::vector<std::uint8_t> is_contact(label.size());
  const auto count = [&](const std::int16_t* a, const std::int16_t* b, int size) {
    find_contacts(a, b, size, is_contact.data());
    const auto end = is_contact.begin() + std::max(0, size);
    for (auto at = is_contact.begin(); (at = std::find(at, end, std::uint8_t{1})) < end; ++at) {
      const std::ptrdiff_t i = at - is_contact.begin();
      const std::pair<int, int> pair = std::minmax<int>(a[i], b[i]);
      if (last == contacts.end() || last->first != pair) last = contacts.try_emplace(pair, 0).first;
      ++last->second;
    }
  };
  const int columns = cells.columns(), rows = cells.rows();
  for (int step = 1; step <= kReach; ++step) {
    for (int r = 0; r < rows; ++r) {
      const std::int16_t* row = label.data() + cells.index(0, r);
      count(row, row + step, columns - step);
    }
    count(label.data(), label.data() + cells.index(0, step), (rows - step) * columns);
  }
  return contacts;
}

class Joiner {
 public:
  Joiner(const std::vector<CellMean>& means, const DepthTolerance& tolerance, double max_angle,
         std::vector<SurfaceRegion>& regions, std::vector<std::int16_t>& label)
      : means_(means),
        tolerance_(tolerance),
        max_angle_(max_angle),
        regions_(regions),
        label_(label),
        joined_to_(regions.size()) {
    for (std::size_t i = 0; i < joined_to_.size(); ++i) joined_to_[i] = static_cast<int>(i);
  }

  void join_all(const Contacts& contacts) {
    bool is_changed = true;
    while (is_changed) {
      is_changed = false;
      for (const auto& [pair, count] : contacts) {
        const int a = find(pair.first), b = find(pair.second);
        if (a == b || count < kLeastContacts) continue;
        is_changed |= join(std::min(a, b), std::max(a, b));
      }
    }
  }

  // Regions that two or more far larger ones, which they touch, explain as well.
  void drop_made_up(const Contacts& contacts, const DepthCells& cells) {
    std::vector<std::set<int>> larger(regions_.size());  // that each touches
    const auto note = [&](int own, int other) {
      if (pixels(own) < kShellPixels * pixels(other)) {
        larger[static_cast<std::size_t>(own)].insert(other);
      }
    };
    for (const auto& contact : contacts) {
      const int a = find(contact.first.first), b = find(contact.first.second);
      if (a == b || !region(a).plane || !region(b).plane) continue;
      note(a, b);
      note(b, a);
    }
    std::vector<int> made_up;
    for (std::size_t i = 0; i < regions_.size(); ++i) {
      if (larger[i].size() >= 2 && explain(larger[i], regions_[i].cells, cells)) {
        made_up.push_back(static_cast<int>(i));
      }
    }
    for (const int i : made_up) {
      region(i).plane.reset();
      for (const int cell : region(i).cells) label_[static_cast<std::size_t>(cell)] = kNoPlane;
    }
  }

 private:
  SurfaceRegion& region(int i) { return regions_[static_cast<std::size_t>(i)]; }
  double pixels(int i) { return region(i).sums.count; }

  int find(int i) const {
    while (joined_to_[static_cast<std::size_t>(i)] != i) {
      i = joined_to_[static_cast<std::size_t>(i)];
    }
    return i;
  }

  bool join(int a, int b) {
    if (!region(a).plane || !region(b).plane) return false;
    const InversePlane plane_a = *region(a).plane, plane_b = *region(b).plane;
    const double cosine =
        plane_a.coefficients().dot(plane_b.coefficients()) / (plane_a.length * plane_b.length);
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
    if (angle > kShellAngleRatio * max_angle_) return false;
    SurfaceRegion both;
    both.sums = region(a).sums;
    both.sums += region(b).sums;
    both.fit();
    if (angle <= max_angle_ && both.plane && lies_on(a, *both.plane, kRmsShare) &&
        lies_on(b, *both.plane, kRmsShare)) {
      region(a).sums = both.sums;
      region(a).plane = both.plane;
    } else if (pixels(b) < kShellPixels * pixels(a)) {
      if (!lies_on(b, plane_a, kShellRmsShare)) return false;
    } else if (pixels(a) < kShellPixels * pixels(b) && lies_on(a, plane_b, kShellRmsShare)) {
      region(a).sums = region(b).sums;
      region(a).plane = region(b).plane;
    } else {
      return false;
    }
    move_cells(b, a);
    return true;
  }

  void move_cells(int from, int to) {
    std::vector<int>& moved = region(from).cells;
    for (const int cell : moved) {
      label_[static_cast<std::size_t>(cell)] = static_cast<std::int16_t>(to);
    }
    region(to).cells.insert(region(to).cells.end(), moved.begin(), moved.end());
    moved.clear();
    region(from).plane.reset();
    joined_to_[static_cast<std::size_t>(from)] = to;
  }

  // Would the region lie within tolerance about this plane?
  bool lies_on(int i, const InversePlane& plane, double share) {
    const double z = region(i).depth();
    const double cosine = 1.0 / (z * plane.length);
    const double allowed = tolerance_.along_ray(z) * cosine + tolerance_.unevenness;
    return rms_about(region(i).sums, plane) <= share * allowed;
  }

  bool explain(const std::set<int>& planes, const std::vector<int>& of_region,
               const DepthCells& cells) {
    double sum = 0.0;
    for (const int cell : of_region) {
      const CellMean& mean = means_[static_cast<std::size_t>(cell)];
      const double z = 1.0 / mean.q;
      const double sigma = tolerance_.noise.sigma(z) / (z * z);
      const double pixels_of_cell = cells.cell(cell).count;
      double least = kFarOff;
      for (const int i : planes) {
        const double off = region(i).plane->off(mean) / sigma;
        least = std::min(least, off * off * pixels_of_cell);
      }
      sum += least;
    }
    return sum < kMadeUp * static_cast<double>(of_region.size());
  }

  const std::vector<CellMean>& means_;
  const DepthTolerance& tolerance_;
  double max_angle_;
  std::vector<SurfaceRegion>& regions_;
  std::vector<std::int16_t>& label_;
  std::vector<int> joined_to_;
};

// Gives cells without a region to the planes they lie on.
class Completer {
 public:
  Completer(const DepthCells& cells, const std::vector<CellMean>& means,
            const std::vector<CellNormal>& normals, const DepthTolerance& tolerance,
            double max_normal_angle, const std::vector<SurfaceRegion>& regions,
            std::vector<std::int16_t>& label)
      : cells_(cells),
        means_(means),
        normals_(normals),
        tolerance_(tolerance),
        cosine_(std::cos(max_normal_angle)),
        regions_(regions),
        label_(label) {}

  // Cells beside a region, as at a border, where many have no normal of their own.
  void extend() {
    std::vector<int> open;  // cells that may have become a region's neighbours
    for (int cell = 0; cell < cells_.size(); ++cell) open.push_back(cell);
    std::vector<std::pair<int, std::int16_t>> added;
    for (int round = 0; round < kRounds; ++round) {
      added.clear();
      for (const int cell : open) {
        const std::int16_t near = is_free(cell) ? neighbour(cell) : kNoPlane;
        if (near != kNoPlane) added.emplace_back(cell, near);
      }
      open.clear();
      for (const auto& [cell, near] : added) {
        label_[static_cast<std::size_t>(cell)] = near;
        visit_beside(cell, [&open](int beside) { open.push_back(beside); });
      }
    }
  }

  // Parts of a plane may be too narrow, or too far from the rest, to be found by themselves: cells
  // that lie on a plane and have its normal, where no other plane is near.
  void claim() {
    const std::vector<std::int16_t> known = label_;
    for (int cell = 0; cell < cells_.size(); ++cell) {
      const auto at = static_cast<std::size_t>(cell);
      if (!is_free(cell) || normals_[at].kind != CellNormal::Kind::kPlanar ||
          !is_alone(cell, known)) {
        continue;
      }
      for (std::size_t i = 0; label_[at] < 0 && i < regions_.size(); ++i) {
        if (is_on(cell, i)) label_[at] = static_cast<std::int16_t>(i);
      }
    }
  }

 private:
  bool is_free(int cell) const {
    const auto at = static_cast<std::size_t>(cell);
    return label_[at] < 0 && means_[at].q > 0.0F;
  }

  bool is_on(int cell, std::size_t region) const {
    const auto at = static_cast<std::size_t>(cell);
    const auto& plane = regions_[region].plane;
    return plane && plane->is_near(means_[at], tolerance_) &&
           normals_[at].allows(plane->normal(), cosine_);
  }

  // Calls visitor(cell) for those on the left, on the right, above, and below.
  template <typename Visitor>
  void visit_beside(int cell, Visitor&& visitor) const {
    const int columns = cells_.columns(), column = cell % columns;
    if (column > 0) visitor(cell - 1);
    if (column + 1 < columns) visitor(cell + 1);
    if (cell >= columns) visitor(cell - columns);
    if (cell + columns < cells_.size()) visitor(cell + columns);
  }

  // The region beside a cell on whose plane it lies, or kNoPlane.
  std::int16_t neighbour(int cell) const {
    std::int16_t found = kNoPlane;
    visit_beside(cell, [&](int beside) {
      const std::int16_t near = label_[static_cast<std::size_t>(beside)];
      if (found < 0 && near >= 0 && is_on(cell, static_cast<std::size_t>(near))) found = near;
    });
    return found;
  }

  bool is_alone(int cell, const std::vector<std::int16_t>& label) const {
    const int column = cell % cells_.columns(), row = cell / cells_.columns();
    const int c_last = std::min(cells_.columns() - 1, column + kAlone);
    for (int r = std::max(0, row - kAlone); r <= std::min(cells_.rows() - 1, row + kAlone); ++r) {
      for (int c = std::max(0, column - kAlone); c <= c_last; ++c) {
        if (label[static_cast<std::size_t>(cells_.index(c, r))] >= 0) return false;
      }
    }
    return true;
  }

  const DepthCells& cells_;
  const std::vector<CellMean>& means_;
  const std::vector<CellNormal>& normals_;
  const DepthTolerance& tolerance_;
  double cosine_;
  const std::vector<SurfaceRegion>& regions_;
  std::vector<std::int16_t>& label_;
};

}  // namespace

bool InversePlane::is_near(const CellMean& mean, const DepthTolerance& tolerance) const {
  return std::abs(off(mean)) <= mean.allowed + kMeanShare * tolerance.unevenness * mean.q * length;
}

void SurfaceRegion::fit() {
  const auto found = fit_plane(sums);
  plane = found ? std::optional(InversePlane::of(found->coefficients)) : std::nullopt;
}

double rms_about(const InverseDepthSums& s, const InversePlane& p) {
  const double squares = s.qq - 2.0 * (p.a * s.qx + p.b * s.qy + p.c * s.q) + p.a * p.a * s.xx +
                         p.b * p.b * s.yy + p.c * p.c * s.count +
                         2.0 * (p.a * p.b * s.xy + p.a * p.c * s.x + p.b * p.c * s.y);
  // Along the ray dz = z² dq; along the normal times |n·ray| = 1 / (z |(a, b, c)|).
  return std::sqrt(std::max(0.0, squares) / s.count) * s.mean_depth() / p.length;
}

CellRegions merge_regions(const DepthCells& cells, const std::vector<CellNormal>& normals,
                          const std::vector<CellMean>& means, const DepthTolerance& tolerance,
                          double max_normal_angle, double max_merge_angle,
                          std::vector<SurfaceRegion> regions, std::vector<std::int16_t> label) {
  const Contacts contacts = count_contacts(cells, label);
  Joiner joiner(means, tolerance, max_merge_angle, regions, label);
  joiner.join_all(contacts);
  joiner.drop_made_up(contacts, cells);
  Completer completer(cells, means, normals, tolerance, max_normal_angle, regions, label);
  completer.extend();
  completer.claim();

  CellRegions result;
  std::vector<std::int16_t> index(regions.size(), kNoPlane);
  for (std::size_t i = 0; i < index.size(); ++i) {
    if (!regions[i].plane) continue;
    index[i] = static_cast<std::int16_t>(result.planes.size());
    result.planes.push_back(regions[i].plane->plane());
  }
  result.cell_label = std::move(label);
  for (std::int16_t& l : result.cell_label) {
    l = l < 0 ? kNoPlane : index[static_cast<std::size_t>(l)];
  }
  return result;
}

}  // namespace geomap::perception
