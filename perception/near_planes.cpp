// SPDX-License-Identifier: BSD-3-Clause
#include "perception/near_planes.hpp"

#include <algorithm>

#include "geometry/multiversion.hpp"

namespace geomap::perception {
namespace {

// The planes of a row of cells that are in the layer which begins with `first`.
GEOMAP_MULTIVERSION void pick_layer(const std::int16_t* __restrict label, int columns, int first,
                                    std::uint64_t* __restrict set) {
  for (int c = 0; c < columns; ++c) {
    const int bit = label[c] - first;
    const bool is_here = (label[c] >= 0) & (bit >= 0) & (bit < 64);
    set[c] = is_here ? std::uint64_t{1} << (bit & 63) : 0;
  }
}

GEOMAP_MULTIVERSION void unite_five(const std::uint64_t* __restrict a,
                                    const std::uint64_t* __restrict b,
                                    const std::uint64_t* __restrict c,
                                    const std::uint64_t* __restrict d,
                                    const std::uint64_t* __restrict e, int columns,
                                    std::uint64_t* __restrict all) {
  for (int i = 0; i < columns; ++i) all[i] = a[i] | b[i] | c[i] | d[i] | e[i];
}

}  // namespace

NearPlanes::NearPlanes(const DepthCells& cells, const std::vector<std::int16_t>& label,
                       std::size_t planes)
    : size_(label.size()), sets_((planes + kBits - 1) / kBits * size_) {
  static_assert(kReach == 2 && kBits == 64);
  const int columns = cells.columns(), rows = cells.rows();
  std::vector<std::uint64_t> across(size_);
  std::vector<std::uint64_t> padded(static_cast<std::size_t>(columns + 2 * kReach), 0);
  for (std::size_t layer = 0; layer * size_ < sets_.size(); ++layer) {
    for (int r = 0; r < rows; ++r) {
      pick_layer(label.data() + cells.index(0, r), columns, static_cast<int>(layer * kBits),
                 padded.data() + kReach);
      const std::uint64_t* p = padded.data();
      unite_five(p, p + 1, p + 2, p + 3, p + 4, columns, across.data() + cells.index(0, r));
    }
    for (int r = 0; r < rows; ++r) {
      const auto at = [&](int step) {
        return across.data() + cells.index(0, std::clamp(r + step, 0, rows - 1));
      };
      unite_five(at(-2), at(-1), at(0), at(1), at(2), columns,
                 sets_.data() + layer * size_ + cells.index(0, r));
    }
  }
}

}  // namespace geomap::perception
