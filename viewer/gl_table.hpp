// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "viewer/palette.hpp"

namespace geomap::viewer {

/// @brief A table of four numbers a row that shaders read as a `samplerBuffer`. Needs a current
/// context from the first upload on, for as long as it lives.
class GlTable {
 public:
  GlTable() = default;
  ~GlTable();
  GlTable(const GlTable&) = delete;
  GlTable& operator=(const GlTable&) = delete;

  /// @brief Replaces all that it holds.
  void upload(std::span<const Rgba> rows);
  /// @brief Where shaders look for it, until the next one is bound.
  void bind() const;

 private:
  unsigned buffer_ = 0, texture_ = 0;
};

}  // namespace geomap::viewer
