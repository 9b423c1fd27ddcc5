// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/palette.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace geomap::viewer {
namespace {

constexpr Rgba kUnlabelled = {0.58F, 0.60F, 0.63F, 1.0F};
constexpr double kLevel = 0.90;    // |n_z| of floors and ceilings: within some 26 degrees
constexpr double kUpright = 0.42;  // of walls: within some 25 degrees

Rgba mixed(const Rgba& a, const Rgba& b, double share) {
  Rgba sum{};
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i] = static_cast<float>(a[i] + share * (b[i] - a[i]));
  }
  return sum;
}

// Between colours at equal distances, 0 at the first and 1 at the last one.
Rgba interpolated(std::span<const Rgba> colors, double share) {
  const double at = share * static_cast<double>(colors.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), colors.size() - 2);
  return mixed(colors[below], colors[below + 1], at - static_cast<double>(below));
}

// FNV-1a, which gives the same number on every machine.
std::uint64_t hash_of(std::span<const char> bytes) {
  std::uint64_t hash = 14695981039346656037U;
  for (const char byte : bytes) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211U;
  }
  return hash;
}

// Turning once about z passes sky blue, orange, blue and vermilion: walls that face each other, and
// walls that meet in a corner, differ.
Rgba color_of_heading(double heading) {
  constexpr std::array<Rgba, 5> kAround = {kPalette[1], kPalette[0], kPalette[4], kPalette[5],
                                           kPalette[1]};
  const double turns = heading / (2.0 * std::numbers::pi);
  return interpolated(kAround, turns - std::floor(turns));
}

}  // namespace

Theme dark_theme() {
  return {.is_dark = true,
          .background = {0.075F, 0.090F, 0.115F, 1.0F},
          .foreground = {0.90F, 0.92F, 0.94F, 1.0F},
          .grid = {0.55F, 0.62F, 0.70F, 0.45F},
          .selected = {1.00F, 0.94F, 0.40F, 1.0F},
          .hovered = {1.00F, 1.00F, 1.00F, 1.0F},
          .ghost = {0.66F, 0.69F, 0.73F, 1.0F},
          .warning = kPalette[0],
          .good = {0.20F, 0.78F, 0.58F, 1.0F},
          .bad = {0.95F, 0.42F, 0.24F, 1.0F}};
}

Theme light_theme() {
  return {.is_dark = false,
          .background = {0.965F, 0.970F, 0.975F, 1.0F},
          .foreground = {0.10F, 0.12F, 0.15F, 1.0F},
          .grid = {0.35F, 0.40F, 0.46F, 0.45F},
          .selected = {0.74F, 0.00F, 0.48F, 1.0F},
          .hovered = {0.05F, 0.06F, 0.08F, 1.0F},
          .ghost = {0.45F, 0.47F, 0.50F, 1.0F},
          .warning = {0.72F, 0.42F, 0.00F, 1.0F},
          .good = {0.00F, 0.50F, 0.36F, 1.0F},
          .bad = {0.76F, 0.26F, 0.00F, 1.0F}};
}

Rgba color_of(const mapping::FeatureId& id) {
  const std::string keyframe = std::to_string(id.keyframe);
  const auto number = hash_of(keyframe) + static_cast<std::uint64_t>(id.plane);
  const Rgba& base = kPalette[number % kPalette.size()];
  const double towards_white = 0.16 * static_cast<double>(number / kPalette.size() % 3);
  return mixed(base, {1.0F, 1.0F, 1.0F, 1.0F}, towards_white);
}

Rgba color_of_label(const std::string& label) {
  constexpr std::array<const char*, 5> kUsual = {"wall", "floor", "ceiling", "table", "door"};
  constexpr std::array<std::size_t, 5> kColors = {1, 2, 6, 0, 5};
  if (label.empty()) return kUnlabelled;
  const auto* usual = std::find(kUsual.begin(), kUsual.end(), label);
  if (usual != kUsual.end()) {
    return kPalette[kColors[static_cast<std::size_t>(usual - kUsual.begin())]];
  }
  return mixed(kPalette[hash_of(label) % kPalette.size()], {1.0F, 1.0F, 1.0F, 1.0F}, 0.25);
}

Rgba color_of_normal(const Eigen::Vector3d& normal) {
  if (!normal.allFinite()) return kUnlabelled;
  if (normal.z() > kLevel) return kPalette[2];
  if (normal.z() < -kLevel) return kPalette[6];
  if (std::abs(normal.z()) > kUpright) return kPalette[3];
  return color_of_heading(std::atan2(normal.y(), normal.x()));
}

Rgba ramp(double share) {
  constexpr std::array<Rgba, 5> kStops = {{{0.27F, 0.10F, 0.38F, 1.0F},
                                           {0.23F, 0.32F, 0.55F, 1.0F},
                                           {0.13F, 0.57F, 0.55F, 1.0F},
                                           {0.45F, 0.80F, 0.35F, 1.0F},
                                           {0.99F, 0.91F, 0.25F, 1.0F}}};
  return interpolated(kStops, std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.0);
}

}  // namespace geomap::viewer
