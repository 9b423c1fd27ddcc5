// SPDX-License-Identifier: BSD-3-Clause
#include "perception/merge_planes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace geomap::perception {
namespace {

constexpr int kReach = 3;          // cells between planes that count as touching [cell]
constexpr int kLeastContacts = 4;  // pairs of cells
// Share of the tolerance that a plane's rms about the joint plane may take. A half is 1.5 sigma.
constexpr double kRmsShare = 0.5;

// A far smaller plane within nearly the whole tolerance of a larger one is a shell of left-overs,
// or relief that the sensor cannot tell from the surface: the larger plane takes its pixels, but
// its fit stays.
constexpr double kShellRmsShare = 0.8;
constexpr double kShellPixels = 0.3;      // at most, over those of the larger plane
constexpr double kShellAngleRatio = 2.0;  // largest angle, over that of joining

// A plane with less than this share of the readings of the cells it appears in is speckle between
// others: dropped, so that they can take its pixels.
constexpr double kLeastDensity = 0.5;

// A plane across an edge that noise has made up: the cells it took lie on the planes beside it
// nearly as well as noise lets them. Mean square of what they are off, over that of noise; far more
// than this is cut off, so that a few cells do not decide.
constexpr double kMadeUp = 3.0;
constexpr double kFarOff = 16.0;

struct Surface {
  PlaneSums sums;
  double readings = 0.0;  // in the cells in which it appears, for as many rows as were assigned
  std::optional<geometry::PlaneFit> fit;
};

using Contacts = std::map<std::pair<int, int>, int>;  // pairs of planes, smaller index first

void fit(Surface& surface) {
  const geometry::PlaneMoments& moments = surface.sums.moments;
  surface.fit = moments.weight > 0.0 ? moments.fit(-moments.centroid()) : std::nullopt;
}

Contacts count_contacts(const DepthCells& cells, const std::vector<std::int16_t>& cell_label) {
  Contacts contacts;
  const auto label = [&](int c, int r) {
    return cell_label[static_cast<std::size_t>(cells.index(c, r))];
  };
  for (int r = 0; r < cells.rows(); ++r) {
    for (int c = 0; c < cells.columns(); ++c) {
      const std::int16_t own = label(c, r);
      if (own == kNoPlane) continue;
      for (int step = 1; step <= kReach; ++step) {
        if (c + step < cells.columns()) {
          const std::int16_t right = label(c + step, r);
          if (right != own && right != kNoPlane) ++contacts[std::minmax<int>(own, right)];
        }
        if (r + step < cells.rows()) {
          const std::int16_t below = label(c, r + step);
          if (below != own && below != kNoPlane) ++contacts[std::minmax<int>(own, below)];
        }
      }
    }
  }
  return contacts;
}

double rms_about(const geometry::PlaneMoments& m, const geometry::Plane& plane) {
  const Eigen::Vector3d& n = plane.normal;
  const double sum =
      n.dot(m.second * n) + 2.0 * plane.d * n.dot(m.first) + plane.d * plane.d * m.weight;
  return std::sqrt(std::max(0.0, sum / m.weight));
}

// Would the surface lie within tolerance about this plane?
bool lies_on(const Surface& surface, const geometry::Plane& plane, const DepthTolerance& tolerance,
             double share) {
  const Eigen::Vector3d centroid = surface.fit->centroid;
  const double cosine = std::abs(plane.normal.dot(centroid)) / centroid.z();
  const double allowed = tolerance.along_ray(centroid.z()) * cosine + tolerance.unevenness;
  return rms_about(surface.sums.moments, plane) <= share * allowed;
}

bool join(Surface& a, const Surface& b, const DepthTolerance& tolerance, double max_angle) {
  if (!a.fit || !b.fit) return false;
  const double angle = geometry::angle_between(a.fit->plane, b.fit->plane);
  if (angle > kShellAngleRatio * max_angle) return false;
  Surface both = a;
  both.sums += b.sums;
  fit(both);
  if (angle <= max_angle && both.fit && lies_on(a, both.fit->plane, tolerance, kRmsShare) &&
      lies_on(b, both.fit->plane, tolerance, kRmsShare)) {
    a = both;
    return true;
  }
  if (b.sums.pixels < kShellPixels * a.sums.pixels)
    return lies_on(b, a.fit->plane, tolerance, kShellRmsShare);
  if (a.sums.pixels < kShellPixels * b.sums.pixels &&
      lies_on(a, b.fit->plane, tolerance, kShellRmsShare)) {
    a = b;
    return true;
  }
  return false;
}

// What a cell's mean is off a plane along its ray, squared, over the noise of the mean.
double squares_off(const PlaneCell& cell, const geometry::Plane& plane,
                   const DepthTolerance& tolerance) {
  const Eigen::Vector3d mean = cell.sums.moments.centroid();
  const double cosine = std::abs(plane.normal.dot(mean)) / mean.z();
  const double sigma = cosine * tolerance.noise.sigma(mean.z());
  const double off = plane.signed_distance(mean);
  return std::min(kFarOff, off * off * cell.sums.pixels / (sigma * sigma));
}

bool explain(const std::vector<const geometry::Plane*>& planes,
             const std::vector<const PlaneCell*>& cells, const DepthTolerance& tolerance) {
  double sum = 0.0;
  for (const PlaneCell* cell : cells) {
    double least = kFarOff;
    for (const geometry::Plane* plane : planes) {
      least = std::min(least, squares_off(*cell, *plane, tolerance));
    }
    sum += least;
  }
  return sum < kMadeUp * static_cast<double>(cells.size());
}

int find(const std::vector<int>& joined_to, int i) {
  while (joined_to[static_cast<std::size_t>(i)] != i) i = joined_to[static_cast<std::size_t>(i)];
  return i;
}

// Surfaces that two or more far larger ones, which they touch, explain as well.
void drop_made_up(std::vector<Surface>& surfaces, const std::vector<int>& joined_to,
                  const Contacts& contacts, const PlanePixels& pixels,
                  const DepthTolerance& tolerance) {
  std::vector<std::vector<const PlaneCell*>> cells(surfaces.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    auto& of_root = cells[static_cast<std::size_t>(find(joined_to, static_cast<int>(i)))];
    for (const PlaneCell& cell : pixels.cells[i]) of_root.push_back(&cell);
  }
  std::vector<std::set<std::size_t>> larger(surfaces.size());  // that each touches
  const auto note = [&](std::size_t own, std::size_t other) {
    if (surfaces[own].sums.pixels < kShellPixels * surfaces[other].sums.pixels) {
      larger[own].insert(other);
    }
  };
  for (const auto& contact : contacts) {
    const auto a = static_cast<std::size_t>(find(joined_to, contact.first.first));
    const auto b = static_cast<std::size_t>(find(joined_to, contact.first.second));
    if (a == b || !surfaces[a].fit || !surfaces[b].fit) continue;
    note(a, b);
    note(b, a);
  }
  std::vector<std::size_t> made_up;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (larger[i].size() < 2) continue;
    std::vector<const geometry::Plane*> planes;
    for (const std::size_t other : larger[i]) planes.push_back(&surfaces[other].fit->plane);
    if (explain(planes, cells[i], tolerance)) made_up.push_back(i);
  }
  for (const std::size_t i : made_up) surfaces[i].fit.reset();
}

}  // namespace

FittedPlanes fit_and_merge(const DepthCells& cells, const PlanePixels& pixels,
                           const DepthTolerance& tolerance, double max_angle, int row_step) {
  std::vector<Surface> surfaces(pixels.cells.size());
  std::vector<int> joined_to(surfaces.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    for (const PlaneCell& cell : pixels.cells[i]) {
      surfaces[i].sums += cell.sums;
      surfaces[i].readings += cells.cell(cell.cell).count / row_step;
    }
    if (surfaces[i].sums.pixels >= kLeastDensity * surfaces[i].readings) fit(surfaces[i]);
    joined_to[i] = static_cast<int>(i);
  }

  const Contacts contacts = count_contacts(cells, pixels.cell_label);
  bool is_changed = true;
  while (is_changed) {
    is_changed = false;
    for (const auto& [pair, count] : contacts) {
      const int a = find(joined_to, pair.first), b = find(joined_to, pair.second);
      if (a == b || count < kLeastContacts) continue;
      const int kept = std::min(a, b), gone = std::max(a, b);
      if (join(surfaces[static_cast<std::size_t>(kept)], surfaces[static_cast<std::size_t>(gone)],
               tolerance, max_angle)) {
        joined_to[static_cast<std::size_t>(gone)] = kept;
        is_changed = true;
      }
    }
  }

  drop_made_up(surfaces, joined_to, contacts, pixels, tolerance);

  FittedPlanes result;
  std::vector<std::int16_t> index(surfaces.size(), kNoPlane);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const auto root = static_cast<std::size_t>(find(joined_to, static_cast<int>(i)));
    if (!surfaces[root].fit) continue;
    if (root == i) {
      index[i] = static_cast<std::int16_t>(result.planes.size());
      result.planes.push_back(surfaces[i].fit->plane);
    } else {
      index[i] = index[root];
    }
  }
  result.cell_label = pixels.cell_label;
  for (std::int16_t& label : result.cell_label) {
    if (label != kNoPlane) label = index[static_cast<std::size_t>(label)];
  }
  return result;
}

}  // namespace geomap::perception
