// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation_quality.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "geometry/angles.hpp"
#include "geometry/plane.hpp"

namespace geomap::bench {
namespace {

using geometry::DepthImage;
using geometry::RgbdFrame;

constexpr std::int64_t kLeastPixels = 1000;  // of a label that counts
constexpr int kBlock = 16;                   // [pixel]
constexpr double kFarthestBlock = 2.5;       // [m]
constexpr double kLeastReadings = 0.8;       // of a block's pixels
constexpr double kLeastMajority = 0.75;      // of a block's readings
constexpr double kBlockRms = 0.001;          // [m]
constexpr double kBlockRmsGrowth = 0.0008;   // [1/m]
constexpr double kMismatchDeg = 20.0;
constexpr int kReach = 3;                                 // between adjacent labels [pixel]
constexpr int kLeastContact = 20;                         // [pixel]
constexpr double kSplitDeg = 5.0, kSplitDistance = 0.02;  // [m]
constexpr double kFlushDeg = 2.0, kFlushDistance = 0.005;

// Sums of points for a least-squares plane.
struct Sums {
  std::int64_t points = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();

  void add(const Eigen::Vector3d& p) {
    ++points;
    first += p;
    second += p * p.transpose();
  }
};

struct Fit {
  geometry::Plane plane;
  Eigen::Vector3d centroid;
  double squared_residuals = 0.0;  // [m²]
};

Fit fit(const Sums& sums) {
  const auto n = static_cast<double>(sums.points);
  const Eigen::Vector3d mean = sums.first / n;
  const Eigen::Matrix3d scatter = sums.second / n - mean * mean.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  return {geometry::Plane::through(mean, solver.eigenvectors().col(0)), mean,
          n * std::max(0.0, solver.eigenvalues()(0))};
}

// Which side a normal points to says nothing here.
double degrees_between(const geometry::Plane& a, const geometry::Plane& b) {
  const double angle = geometry::degrees(geometry::angle_between(a, b));
  return std::min(angle, 180.0 - angle);
}

class Measurement {
 public:
  Measurement(const RgbdFrame& frame, std::span<const std::int16_t> label)
      : frame_(frame), label_(label) {}

  SegmentationQuality run() {
    fit_labels();
    count_pixels();
    for (int v = 0; v + kBlock <= frame_.depth.height; v += kBlock) {
      for (int u = 0; u + kBlock <= frame_.depth.width; u += kBlock) judge_block(u, v);
    }
    count_splits();
    return result_;
  }

 private:
  template <typename Visit>  // with (u, v, point) of each reading of a part of the image
  void for_readings(int left, int top, int width, int height, Visit&& visit) const {
    for (int v = top; v < top + height; ++v) {
      for (int u = left; u < left + width; ++u) {
        const std::uint16_t reading = frame_.depth.at(u, v);
        if (!DepthImage::is_reading(reading)) continue;
        visit(u, v, frame_.depth_camera.point(u, v, 1e-3 * reading));
      }
    }
  }

  int label_at(int u, int v) const {
    return label_[static_cast<std::size_t>(v) * static_cast<std::size_t>(frame_.depth.width) +
                  static_cast<std::size_t>(u)];
  }

  const Fit* fit_of(int label) const {
    return label >= 0 && fits_[static_cast<std::size_t>(label)]
               ? &*fits_[static_cast<std::size_t>(label)]
               : nullptr;
  }

  void fit_labels() {
    const int most = label_.empty() ? -1 : *std::max_element(label_.begin(), label_.end());
    std::vector<Sums> sums(static_cast<std::size_t>(std::max(0, most + 1)));
    for_readings(0, 0, frame_.depth.width, frame_.depth.height,
                 [&](int u, int v, const Eigen::Vector3d& p) {
                   const int label = label_at(u, v);
                   if (label >= 0) sums[static_cast<std::size_t>(label)].add(p);
                 });
    for (const Sums& of_label : sums) {
      fits_.push_back(of_label.points >= kLeastPixels ? std::optional(fit(of_label))
                                                      : std::nullopt);
      if (!fits_.back()) continue;
      ++result_.planes;
      result_.squared_residuals += fits_.back()->squared_residuals;
    }
  }

  void count_pixels() {
    for_readings(
        0, 0, frame_.depth.width, frame_.depth.height, [&](int u, int v, const Eigen::Vector3d& p) {
          const auto bin = std::upper_bound(kDepthBinEnds.begin(), kDepthBinEnds.end(), p.z()) -
                           kDepthBinEnds.begin();
          DepthBin& counts = result_.bins[static_cast<std::size_t>(bin)];
          ++counts.valid;
          counts.labelled += fit_of(label_at(u, v)) != nullptr;
        });
  }

  void judge_block(int left, int top) {
    Sums sums;
    std::map<int, std::int64_t> votes;
    for_readings(left, top, kBlock, kBlock, [&](int u, int v, const Eigen::Vector3d& p) {
      sums.add(p);
      ++votes[label_at(u, v)];
    });
    const auto readings = static_cast<double>(sums.points);
    if (readings < kLeastReadings * kBlock * kBlock) return;
    const auto most = std::max_element(votes.begin(), votes.end(),
                                       [](auto& a, auto& b) { return a.second < b.second; });
    const Fit* plane = fit_of(most->first);
    if (plane == nullptr || static_cast<double>(most->second) < kLeastMajority * readings) return;
    const Fit own = fit(sums);
    const double z = own.centroid.z(), allowed = kBlockRms + kBlockRmsGrowth * z * z;
    if (z >= kFarthestBlock || own.squared_residuals > readings * allowed * allowed) return;
    ++result_.blocks;
    result_.mismatched += degrees_between(own.plane, plane->plane) > kMismatchDeg;
  }

  void count_splits() {
    std::map<std::pair<int, int>, int> contacts;
    for (int v = 0; v < frame_.depth.height; ++v) {
      for (int u = 0; u < frame_.depth.width; ++u) {
        if (fit_of(label_at(u, v)) == nullptr) continue;
        const int right = other_label(u, v, 1, 0), below = other_label(u, v, 0, 1);
        if (right >= 0) ++contacts[std::minmax({label_at(u, v), right})];
        if (below >= 0 && below != right) ++contacts[std::minmax({label_at(u, v), below})];
      }
    }
    for (const auto& [pair, pixels] : contacts) {
      if (pixels < kLeastContact) continue;
      const Fit &a = *fit_of(pair.first), &b = *fit_of(pair.second);
      result_.splits += are_coplanar(a, b, kSplitDeg, kSplitDistance);
      result_.flush_splits += are_coplanar(a, b, kFlushDeg, kFlushDistance);
    }
  }

  // The first other label that counts, going from a border pixel; -1: none within reach.
  int other_label(int u, int v, int step_u, int step_v) const {
    for (int i = 1; i <= kReach; ++i) {
      const int to_u = u + i * step_u, to_v = v + i * step_v;
      if (to_u >= frame_.depth.width || to_v >= frame_.depth.height) break;
      const int label = label_at(to_u, to_v);
      if (label == label_at(u, v)) break;
      if (fit_of(label) != nullptr) return label;
    }
    return -1;
  }

  static bool are_coplanar(const Fit& a, const Fit& b, double degrees, double distance) {
    return degrees_between(a.plane, b.plane) < degrees &&
           std::abs(a.plane.signed_distance(b.centroid)) < distance &&
           std::abs(b.plane.signed_distance(a.centroid)) < distance;
  }

  const RgbdFrame& frame_;
  std::span<const std::int16_t> label_;
  std::vector<std::optional<Fit>> fits_;  // per label; nothing for those too small to count
  SegmentationQuality result_;
};

double share(std::int64_t part, std::int64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

std::int64_t SegmentationQuality::valid() const {
  std::int64_t sum = 0;
  for (const DepthBin& bin : bins) sum += bin.valid;
  return sum;
}

std::int64_t SegmentationQuality::labelled() const {
  std::int64_t sum = 0;
  for (const DepthBin& bin : bins) sum += bin.labelled;
  return sum;
}

double SegmentationQuality::cover() const { return share(labelled(), valid()); }
double SegmentationQuality::mismatch() const { return share(mismatched, blocks); }
double SegmentationQuality::rms() const {
  return labelled() == 0 ? 0.0 : std::sqrt(squared_residuals / static_cast<double>(labelled()));
}

SegmentationQuality& SegmentationQuality::operator+=(const SegmentationQuality& other) {
  planes += other.planes;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    bins[i].valid += other.bins[i].valid;
    bins[i].labelled += other.bins[i].labelled;
  }
  blocks += other.blocks;
  mismatched += other.mismatched;
  splits += other.splits;
  flush_splits += other.flush_splits;
  squared_residuals += other.squared_residuals;
  return *this;
}

SegmentationQuality measure_segmentation(const RgbdFrame& frame,
                                         std::span<const std::int16_t> label) {
  if (label.size() != frame.depth.millimetres.size()) {
    throw std::invalid_argument("one label per pixel is needed");
  }
  return Measurement(frame, label).run();
}

}  // namespace geomap::bench
