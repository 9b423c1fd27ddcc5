// SPDX-License-Identifier: BSD-3-Clause
#include "perception/map_voxel.hpp"

namespace geomap::perception {

void MapBlock::erase(int number) {
  std::uint16_t& slot = slot_[static_cast<std::size_t>(number)];
  if (slot == kNone) return;
  voxels_[slot] = voxels_.back();
  numbers_[slot] = numbers_.back();
  slot_[numbers_[slot]] = slot;
  voxels_.pop_back();
  numbers_.pop_back();
  slot_[static_cast<std::size_t>(number)] = kNone;
  occupied_[static_cast<std::size_t>(number) / 64] &= ~(std::uint64_t{1} << (number % 64));
}

}  // namespace geomap::perception
