// SPDX-License-Identifier: BSD-3-Clause
#include "perception/map_voxel.hpp"

namespace geomap::perception {

template <int sign>
void VoxelReading::apply(MapVoxel& voxel) const {
  voxel.count += static_cast<std::uint32_t>(sign);  // unsigned: wraps to a subtraction
  for (std::size_t i = 0, k = 0; i < 3; ++i) {
    voxel.first[i] += sign * offset[i];
    voxel.normal[i] += sign * normal[i];
    for (std::size_t j = i; j < 3; ++j) voxel.second[k++] += sign * offset[i] * offset[j];
  }
  if (rgb == nullptr) return;
  voxel.colored += static_cast<std::uint32_t>(sign);
  for (std::size_t c = 0; c < 3; ++c) voxel.color[c] += static_cast<std::uint32_t>(sign * rgb[c]);
}

template void VoxelReading::apply<1>(MapVoxel&) const;
template void VoxelReading::apply<-1>(MapVoxel&) const;

const MapVoxel* MapBlock::find(int number) const {
  const std::uint16_t slot = slot_[static_cast<std::size_t>(number)];
  return slot == kNone ? nullptr : &voxels_[slot];
}

MapVoxel* MapBlock::find(int number) {
  const std::uint16_t slot = slot_[static_cast<std::size_t>(number)];
  return slot == kNone ? nullptr : &voxels_[slot];
}

MapVoxel& MapBlock::find_or_add(int number) {
  std::uint16_t& slot = slot_[static_cast<std::size_t>(number)];
  if (slot == kNone) {
    slot = static_cast<std::uint16_t>(voxels_.size());
    voxels_.emplace_back();
    numbers_.push_back(static_cast<std::uint16_t>(number));
  }
  return voxels_[slot];
}

void MapBlock::erase(int number) {
  std::uint16_t& slot = slot_[static_cast<std::size_t>(number)];
  if (slot == kNone) return;
  voxels_[slot] = voxels_.back();
  numbers_[slot] = numbers_.back();
  slot_[numbers_[slot]] = slot;
  voxels_.pop_back();
  numbers_.pop_back();
  slot_[static_cast<std::size_t>(number)] = kNone;
}

VoxelAddress VoxelAddress::of(const std::array<std::int64_t, 3>& fine) {
  constexpr int kBlockBits = MapVoxel::kFineBits + MapBlock::kSideBits;
  VoxelAddress address;
  std::array<std::int32_t, 3> block{};
  for (std::size_t i = 0; i < 3; ++i) {
    // Arithmetic shifts round down, also below zero.
    block[i] = static_cast<std::int32_t>(fine[i] >> kBlockBits);
    const auto voxel = static_cast<int>(fine[i] >> MapVoxel::kFineBits) & (MapBlock::kSide - 1);
    address.number = (address.number << MapBlock::kSideBits) | voxel;
    address.offset[i] = (fine[i] & (MapVoxel::kFine - 1)) - MapVoxel::kFine / 2;
  }
  address.block = {block[0], block[1], block[2]};
  return address;
}

}  // namespace geomap::perception
