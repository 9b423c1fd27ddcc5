// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "viewer/palette.hpp"

namespace geomap::viewer {

/// @brief A shader program of OpenGL. Needs a current context for as long as it lives.
class GlProgram {
 public:
  struct Sources {
    std::string_view vertex, geometry, fragment;  // geometry: may be empty
  };

  /// @brief @throws std::runtime_error with the program's name, the stage and the driver's log when
  /// it does not compile.
  GlProgram(const std::string& name, const Sources& sources);
  ~GlProgram();
  GlProgram(GlProgram&& other) noexcept;
  GlProgram& operator=(GlProgram&& other) noexcept;

  void use() const;

  /// @brief Values for the program in use. @throws std::logic_error for a name that it does not
  /// have.
  void set(const char* uniform, const Eigen::Matrix4d& value) const;
  void set(const char* uniform, const Eigen::Vector2f& value) const;
  void set(const char* uniform, const Rgba& value) const;
  void set(const char* uniform, std::span<const Rgba> values) const;
  void set(const char* uniform, double value) const;

 private:
  int location(const char* uniform) const;

  unsigned program_ = 0;
  std::vector<std::pair<std::string, int>> locations_;  // of its values: few, so a list is fastest
};

}  // namespace geomap::viewer
