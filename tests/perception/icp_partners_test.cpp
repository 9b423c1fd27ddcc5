// SPDX-License-Identifier: BSD-3-Clause
#include "perception/icp_partners.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "perception/registration_weight.hpp"
#include "registration_scenes.hpp"

namespace geomap::perception {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kLeastCosine = 0.77;

// The definition, surfel by surfel.
struct Expected {
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> vector = Eigen::Matrix<double, 6, 1>::Zero();
  double weight = 0.0, squares = 0.0, radius_squares = 0.0;
  int seen_through = 0;
  std::vector<int> pixels;

  Expected(const std::vector<Surfel>& surfels, const SurfaceImage& view, const Isometry3d& T,
           double gate) {
    for (const Surfel& surfel : surfels) {
      const Vector3d arm = surfel.position - T.translation();
      const Vector3d p = T.linear().transpose() * arm;
      const SurfacePixel* pixel = view.seen_at(p);
      if (pixel == nullptr || !pixel->on_ray_of(p)) continue;
      const Vector3d met = *pixel->on_ray_of(p);
      seen_through += p.z() < met.z() - std::max(gate, 0.04 * p.z());
      const Vector3d n = T.linear().transpose() * surfel.normal;
      const double e = n.dot(p - met);
      if (!(n.dot(pixel->normal) >= kLeastCosine) || !(std::abs(e) <= gate)) continue;
      const double w = registration_weight(p.z(), e);
      Eigen::Matrix<double, 6, 1> j;
      j << surfel.normal, arm.cross(surfel.normal);
      information += w * j * j.transpose();
      vector += w * e * j;
      weight += w;
      squares += w * e * e;
      radius_squares += w * arm.squaredNorm();
      pixels.push_back(static_cast<int>(pixel - view.pixels()));
    }
  }
};

void expect_as(const Expected& expected, const IcpSums& sums) {
  EXPECT_EQ(sums.partners, static_cast<int>(expected.pixels.size()));
  EXPECT_EQ(sums.seen_through, expected.seen_through);
  EXPECT_NEAR(sums.weight, expected.weight, 1e-12 * expected.weight);
  EXPECT_NEAR(sums.squares, expected.squares, 1e-9 * expected.squares);
  EXPECT_NEAR(sums.radius_squares, expected.radius_squares, 1e-12 * expected.radius_squares);
  const double scale = expected.information.norm();
  EXPECT_LE((sums.matrix() - expected.information).norm(), 1e-12 * scale);
  const Eigen::Map<const Eigen::Matrix<double, 6, 1>> vector(sums.vector.data());
  EXPECT_LE((vector - expected.vector).norm(), 1e-12 * scale);
}

class Partners : public ::testing::Test {
 protected:
  RegistrationScene scene_ = room_scene();
  SurfaceImage view_ = exact_view(scene_, scene_.T_world_camera);
  std::vector<Surfel> surfels_ = exact_surfels(scene_);
};

TEST_F(Partners, AreThoseThatTheDefinitionGives) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    for (const double gate : {0.15, 0.03}) {
      const Isometry3d T = disturbed(scene_.T_world_camera, 0.05, 3.0, seed);
      const Expected expected(surfels_, view_, T, gate);
      ASSERT_GT(expected.pixels.size(), 100U);
      ASSERT_GT(expected.seen_through, 0);
      IcpPartners partners(surfels_);
      expect_as(expected, partners.match(view_, T, gate, kLeastCosine));
      EXPECT_EQ(partners.pixels(), expected.pixels);
    }
  }
}

TEST_F(Partners, AreTheSameForAnyNumberOfSurfels) {
  const Isometry3d T = disturbed(scene_.T_world_camera, 0.02, 1.0, 4);
  for (const std::size_t count : {0U, 1U, 7U, 8U, 9U, 127U, 128U, 129U, 1000U}) {
    const std::vector<Surfel> few(surfels_.end() - static_cast<std::ptrdiff_t>(count),
                                  surfels_.end());
    expect_as(Expected(few, view_, T, 0.05), IcpPartners(few).match(view_, T, 0.05, kLeastCosine));
  }
}

TEST_F(Partners, EveryFourthSurfelIsEveryFourth) {
  std::vector<Surfel> fourth;
  for (std::size_t i = 0; i < surfels_.size(); i += 4) fourth.push_back(surfels_[i]);
  const Isometry3d T = disturbed(scene_.T_world_camera, 0.02, 1.0, 5);
  expect_as(Expected(fourth, view_, T, 0.05),
            IcpPartners(surfels_, 4).match(view_, T, 0.05, kLeastCosine));
}

TEST_F(Partners, WhatIsOutOfViewIsLeftOutAndChangesNothing) {
  const Isometry3d T = disturbed(scene_.T_world_camera, 0.02, 1.0, 6);
  std::vector<Surfel> with_others = surfels_;
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), 1e300, std::numeric_limits<double>::infinity()}) {
    with_others.insert(with_others.begin() + 11, {Vector3d(0.0, bad, 1.0), Vector3d::UnitZ()});
    with_others.insert(with_others.begin() + 5, {Vector3d(0.0, 0.0, 1.0), {bad, 0.0, 0.0}});
  }
  IcpPartners partners(with_others);
  const Expected expected(with_others, view_, T, 0.05);
  ASSERT_EQ(expected.pixels, Expected(surfels_, view_, T, 0.05).pixels);
  expect_as(expected, partners.match(view_, T, 0.05, kLeastCosine));
  partners.keep_in_view(view_.camera(), T, 4.0);
  expect_as(expected, partners.match(view_, T, 0.05, kLeastCosine));
  EXPECT_EQ(partners.pixels(), expected.pixels);
}

}  // namespace
}  // namespace geomap::perception
