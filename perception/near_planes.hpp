// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "perception/depth_cells.hpp"

namespace geomap::perception {

/// @brief Which planes are known around each cell: a bit for each, in layers of as many planes as a
/// word has bits.
class NearPlanes {
 public:
  static constexpr int kReach = 2;  // from which a plane is near [cell]

  /// @param label per cell its plane, negative for none
  /// @param planes how many there are
  NearPlanes(const DepthCells& cells, const std::vector<std::int16_t>& label, std::size_t planes);

  /// @brief The plane that is the only one near a cell; negative where there is none or several.
  int only(std::size_t cell) const {
    int plane = -1, first = 0;
    for (std::size_t i = cell; i < sets_.size(); i += size_, first += static_cast<int>(kBits)) {
      if (sets_[i] == 0) continue;
      if (plane >= 0 || !std::has_single_bit(sets_[i])) return -1;
      plane = first + std::countr_zero(sets_[i]);
    }
    return plane;
  }

  /// @brief Calls visitor(plane) for the planes near a cell, in ascending order.
  template <typename Visitor>
  void visit(std::size_t cell, Visitor&& visitor) const {
    std::size_t first = 0;
    for (std::size_t i = cell; i < sets_.size(); i += size_, first += kBits) {
      for (std::uint64_t left = sets_[i]; left != 0; left &= left - 1) {
        visitor(first + static_cast<std::size_t>(std::countr_zero(left)));
      }
    }
  }

 private:
  static constexpr std::size_t kBits = 64;
  std::size_t size_;                 // cells
  std::vector<std::uint64_t> sets_;  // layers x cells
};

}  // namespace geomap::perception
