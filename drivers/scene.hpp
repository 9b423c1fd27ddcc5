// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geometry/polygon.hpp"

namespace geomap::drivers {

using Rgb = std::array<std::uint8_t, 3>;

/// @brief A planar face with its outline: a true plane of the scene. World frame [m].
struct SceneFace {
  Eigen::Vector3d corner = Eigen::Vector3d::Zero();
  Eigen::Vector3d u = Eigen::Vector3d::UnitX();  // edges from the corner, at right angles; the
  Eigen::Vector3d v = Eigen::Vector3d::UnitY();  // normal is along u × v
  std::vector<Eigen::AlignedBox2d> openings;     // air, in metres along u and v; inside the face
  bool both_sides = false;                       // seen from behind it is a plane of its own
};

/// @brief What of a face is not air, in metres along u and v from its corner.
geometry::Polygon outline_of(const SceneFace& face);

/// @brief What a triangle belongs to.
struct SceneSurface {
  std::string name;
  Rgb color{200, 200, 200};
  std::int32_t face = -1;  // index of the SceneFace, -1: not a plane worth mapping
};

/// @brief Triangles with what they belong to; each is seen from both sides. World frame: z up,
/// metres.
struct Scene {
  struct Triangle {
    std::array<std::uint32_t, 3> vertices;
    std::uint32_t surface = 0;
  };

  std::string name;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;
  std::vector<SceneSurface> surfaces;
  std::vector<SceneFace> faces;

  /// @brief Adds one surface that is a rectangle with openings. Its triangles leave no pin-holes.
  void add_face(const std::string& surface_name, const Rgb& color, const SceneFace& face);

  /// @brief The faces of a box named NAME_front (-x), _back, _left (+y), _right, _top, _bottom, of
  /// which `which` says those there are. The box stands on the origin of its frame.
  void add_box(const std::string& box_name, const Rgb& color, const Eigen::Isometry3d& T_world_box,
               const Eigen::Vector3d& size, std::span<const std::string> which);

  /// @brief A cylinder or cone that stands on the origin of its frame, closed by discs, which are
  /// no planes of the truth; or open at its top: a pot.
  void add_cylinder(const std::string& cylinder_name, const Rgb& color,
                    const Eigen::Isometry3d& T_world_cylinder, double radius, double top_radius,
                    double height, bool open = false);

  /// @brief A sphere about the origin of its frame, without what lies above z = `cut`: a bowl.
  void add_sphere(const std::string& sphere_name, const Rgb& color,
                  const Eigen::Isometry3d& T_world_sphere, double radius, double cut);

  /// @brief Triangles given by vertices in the world. @throws std::invalid_argument for an index
  /// that is out of range.
  void add_triangles(const std::string& surface_name, const Rgb& color,
                     std::span<const Eigen::Vector3d> points,
                     std::span<const std::array<std::uint32_t, 3>> indices);

 private:
  std::uint32_t add_surface(const std::string& surface_name, const Rgb& color, std::int32_t face);
  std::uint32_t add_vertex(const Eigen::Vector3d& point);
};

/// @brief Faces that a box may have.
inline constexpr std::array<const char*, 6> kBoxFaces = {"front", "back", "left",
                                                         "right", "top",  "bottom"};

}  // namespace geomap::drivers
