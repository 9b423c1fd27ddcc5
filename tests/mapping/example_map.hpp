// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>

#include "mapping/map_snapshot.hpp"

namespace geomap::testing {

/// @brief A feature drawn by hand: rings in metres on the plane through `origin`.
struct DrawnFeature {
  mapping::FeatureId id;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d x_axis = Eigen::Vector3d::UnitX();
};

/// @brief Rectangle between two corners [m], counter-clockwise.
geometry::Ring rectangle_ring(double left, double bottom, double right, double top);
geometry::Ring reversed(geometry::Ring ring);

mapping::MapFeature make_feature(const DrawnFeature& drawn, geometry::Polygon polygon);

/// @brief Four features about `origin`, not in the order of their ids:
/// #1 floor 4 × 3 m; #2 table 1.2 × 0.8 m with a hole of 0.4 × 0.3 m, label `table <A & "B">`; #3
/// wall of two parts, 2 and 3 m², that faces -y, 2 m along +y; #4 a board of 0.6 × 0.5 m inclined
/// by 45°, seen without colour. Areas: 12, 0.84, 5, 0.3 m².
mapping::MapSnapshot example_map(const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

/// @brief Squares of 0.2 to 1 m side in all orientations, in a cube of 10 m.
mapping::MapSnapshot crowd(int features);

/// @brief True when the program is there to be run.
bool has_program(const std::string& name);
/// @brief Exit status of a shell command; its output is dropped.
int run_quietly(const std::string& command);

/// @brief An empty folder of the running test's own.
std::filesystem::path fresh_folder();

std::string read_file(const std::filesystem::path& path);

}  // namespace geomap::testing
