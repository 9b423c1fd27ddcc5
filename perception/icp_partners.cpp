// SPDX-License-Identifier: BSD-3-Clause
#include "perception/icp_partners.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace geomap::perception {
namespace {

constexpr std::size_t kLanes = kSumLanes;
// Share of the depth by which a surfel may be nearer than the view's surface, beside the gate.
constexpr double kSeenThrough = 0.04;
constexpr std::size_t kSampled = 4;  // a median does not need all of them

CameraAxes axes_of(const Eigen::Isometry3d& T_world_camera) {
  CameraAxes axes;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) axes.axis[i][k] = T_world_camera.linear()(k, i);
    axes.centre[i] = T_world_camera.translation()(i);
  }
  return axes;
}

// What is known of some surfels on their way to the sums; few enough that it stays in the
// processor's nearest cache.
class Scratch {
 public:
  static constexpr std::size_t kSurfels = 128;

  OutColumns arms() { return three(0); }
  OutColumns points() { return three(3); }
  OutColumns planes() { return three(6); }
  OutColumns facing() { return three(9); }
  double* u() { return columns_[12].data(); }
  double* v() { return columns_[13].data(); }
  double* weight() { return columns_[14].data(); }
  double* residual() { return columns_[15].data(); }
  double* through() { return columns_[16].data(); }

 private:
  OutColumns three(std::size_t first) {
    return {columns_[first].data(), columns_[first + 1].data(), columns_[first + 2].data()};
  }
  std::array<std::array<double, kSurfels>, 17> columns_;
};
static_assert(Scratch::kSurfels % kLanes == 0);

InColumns read_only(const OutColumns& columns) { return {columns[0], columns[1], columns[2]}; }

// What the pixels show onto which the surfels fall.
void look_up(const SurfacePixel* pixels, const std::int32_t* index, std::size_t count,
             Scratch& scratch) {
  const auto [a, b, c] = scratch.planes();
  const auto [x, y, z] = scratch.facing();
  for (std::size_t i = 0; i < count; ++i) {
    const SurfacePixel& pixel = pixels[index[i]];
    a[i] = pixel.inverse_depth.x(), b[i] = pixel.inverse_depth.y(), c[i] = pixel.inverse_depth.z();
    x[i] = pixel.normal.x(), y[i] = pixel.normal.y(), z[i] = pixel.normal.z();
  }
}

IcpSums total_of(const LaneSums& lanes) {
  std::array<double, std::tuple_size_v<LaneSums>> total{};
  for (std::size_t i = 0; i < total.size(); ++i) {
    for (const double lane : lanes[i]) total[i] += lane;
  }
  IcpSums sums;
  std::copy_n(total.begin(), sums.information.size(), sums.information.begin());
  std::copy_n(total.begin() + sums.information.size(), sums.vector.size(), sums.vector.begin());
  sums.weight = total[27];
  sums.squares = total[28];
  sums.radius_squares = total[29];
  sums.partners = static_cast<int>(total[30]);
  sums.seen_through = static_cast<int>(total[31]);
  return sums;
}

}  // namespace

IcpPartners::IcpPartners(const std::vector<Surfel>& surfels, std::size_t stride)
    : size_((surfels.size() + stride - 1) / stride),
      height_(whole_groups()),
      values_(kColumns * height_),
      pixel_(height_) {
  for (std::size_t i = 0; i < size_; ++i) {
    const Surfel& surfel = surfels[i * stride];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      column(kPosition + axis)[i] = surfel.position(static_cast<Eigen::Index>(axis));
      column(kNormal + axis)[i] = surfel.normal(static_cast<Eigen::Index>(axis));
    }
  }
  fill_last_group();
}

std::size_t IcpPartners::whole_groups() const { return (size_ + kLanes - 1) / kLanes * kLanes; }

// With what falls nowhere.
void IcpPartners::fill_last_group() {
  for (std::size_t i = size_; i < whole_groups(); ++i) {
    column(kPosition)[i] = std::numeric_limits<double>::quiet_NaN();
  }
}

void IcpPartners::keep_in_view(const geometry::CameraModel& camera,
                               const Eigen::Isometry3d& T_world_camera, double border) {
  Scratch scratch;
  const CameraAxes axes = axes_of(T_world_camera);
  const double *z = scratch.points()[2], *u = scratch.u(), *v = scratch.v();
  std::size_t kept = 0;
  for (std::size_t first = 0; first < size_; first += Scratch::kSurfels) {
    const std::size_t count = std::min(Scratch::kSurfels, size_ - first);
    project_surfels(three(kPosition, first), count, axes, camera, scratch.arms(), scratch.points(),
                    scratch.u(), scratch.v());
    for (std::size_t i = 0; i < count; ++i) {
      if (!(z[i] > 0.0 && u[i] > -border && v[i] > -border && u[i] < camera.width + border &&
            v[i] < camera.height + border)) {
        continue;
      }
      for (std::size_t c = kPosition; c < kCosine; ++c) column(c)[kept] = column(c)[first + i];
      ++kept;
    }
  }
  size_ = kept;
  fill_last_group();
}

IcpSums IcpPartners::match(const SurfaceImage& view, const Eigen::Isometry3d& T_world_camera,
                           double gate, double least_cosine) {
  Scratch scratch;
  LaneSums sums{};
  const CameraAxes axes = axes_of(T_world_camera);
  const PartnerLimits limits{gate, least_cosine, kSeenThrough};
  for (std::size_t first = 0; first < whole_groups(); first += Scratch::kSurfels) {
    const std::size_t count = std::min(Scratch::kSurfels, whole_groups() - first);
    std::int32_t* pixel = pixel_.data() + first;
    project_surfels(three(kPosition, first), count, axes, view.camera(), scratch.arms(),
                    scratch.points(), scratch.u(), scratch.v());
    find_pixels(scratch.points()[2], scratch.u(), scratch.v(), count, view.width(), view.height(),
                pixel);
    look_up(view.pixels(), pixel, count, scratch);
    match_surfels(
        {read_only(scratch.points()), three(kNormal, first)}, read_only(scratch.planes()),
        read_only(scratch.facing()), count, axes, limits,
        {scratch.weight(), scratch.residual(), scratch.through(), column(kCosine, first)});
    add_partners(read_only(scratch.arms()), three(kNormal, first), scratch.weight(),
                 scratch.residual(), scratch.through(), count, sums);
  }
  return total_of(sums);
}

std::vector<int> IcpPartners::pixels() const {
  std::vector<int> pixels;
  pixels.reserve(size_);
  const double* cosine = values_.data() + kCosine * height_;
  for (std::size_t i = 0; i < size_; ++i) {
    if (cosine[i] > kNoPartner) pixels.push_back(pixel_[i]);
  }
  return pixels;
}

std::vector<double> IcpPartners::squared_normal_differences() const {
  std::vector<double> squares;
  squares.reserve(size_ / kSampled + 1);
  const double* cosine = values_.data() + kCosine * height_;
  for (std::size_t i = 0; i < size_; i += kSampled) {
    if (cosine[i] > kNoPartner) squares.push_back(2.0 * (1.0 - cosine[i]));
  }
  return squares;
}

}  // namespace geomap::perception
