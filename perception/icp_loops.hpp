// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/camera_model.hpp"
#include "perception/surface_image.hpp"

namespace geomap::perception {

/// The loops of frustum ICP over columns of surfels, written so that the compiler takes several
/// surfels at a time. None depends on its neighbours in such a group.

using InColumns = std::array<const double*, 3>;
using OutColumns = std::array<double*, 3>;

/// @brief A camera's axes (rows: its x, y, z in the world) and centre [m].
struct CameraAxes {
  double axis[3][3];
  double centre[3];
};

/// @brief Where surfels fall: from the camera's centre in the world's axes (arm), in the camera's
/// (point), and in the image (pixel; rounded down, its column and row). Without a meaning where a
/// point has no positive z.
void project_surfels(const InColumns& positions, std::size_t count, const CameraAxes& camera,
                     const geometry::CameraModel& model, const OutColumns& arms,
                     const OutColumns& points, double* u, double* v);

/// @brief Index of the pixel onto which each surfel falls, row by row; width x height for none.
void find_pixels(const double* z, const double* u, const double* v, std::size_t count, int width,
                 int height, std::int32_t* pixels);

struct SurfelColumns {
  InColumns points;   // camera
  InColumns normals;  // world
};

struct PartnerLimits {
  double gate;          // along the surfel's normal [m]
  double least_cosine;  // between normals
  double seen_through;  // share of the depth by which a surfel may be nearer than the view
};

inline constexpr double kNoPartner = -2.0;  // in place of a cosine

/// @brief Columns to be filled: weight 0 where there is no partner.
struct PartnerColumns {
  double* weight;
  double* residual;
  double* through;  // 1 for a surfel that the view looks through
  double* cosine;   // between normals
};

/// @param planes, facing of the pixels onto which the surfels fall: SurfacePixel's inverse depth
/// and normal.
void match_surfels(const SurfelColumns& surfels, const InColumns& planes, const InColumns& facing,
                   std::size_t count, const CameraAxes& camera, const PartnerLimits& limits,
                   const PartnerColumns& partners);

inline constexpr std::size_t kSumLanes = 8;

/// @brief Interleaved sums of each kind: the information's upper triangle (21), vector (6), weight,
/// squares, radius squares, partners, surfels seen through; see IcpSums.
using LaneSums = std::array<std::array<double, kSumLanes>, 32>;

/// @brief Adds partners, one after the other to the lanes in turn.
/// @param count a multiple of kSumLanes.
void add_partners(const InColumns& arms, const InColumns& normals, const double* weight,
                  const double* residual, const double* through, std::size_t count, LaneSums& sums);

}  // namespace geomap::perception
