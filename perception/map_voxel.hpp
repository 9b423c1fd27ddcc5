// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <bit>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace geomap::perception {

/// @brief Moments of the points in one voxel as integers, which add and subtract exactly. Positions
/// are relative to the voxel's centre, in 1/4096 of its size.
struct MapVoxel {
  static constexpr int kFineBits = 12;
  static constexpr std::int64_t kFine = std::int64_t{1} << kFineBits;

  // First what a surfel takes, so that it is one cache line of memory more often than two.
  std::uint32_t count = 0;
  std::array<std::int32_t, 3> normal{};  // Σ of kNormalUnit · normal; good for 2 million points
  std::array<std::int64_t, 3> first{};   // Σ offset
  std::array<std::int64_t, 6> second{};  // Σ offset offsetᵀ: xx xy xz yy yz zz
  std::uint32_t colored = 0;             // points whose colour is known
  std::array<std::uint32_t, 3> color{};  // Σ red, green, blue; good for 16 million points

  static constexpr double kNormalUnit = 1024.0;

  Eigen::Vector3d first_moment() const {
    return {static_cast<double>(first[0]), static_cast<double>(first[1]),
            static_cast<double>(first[2])};
  }
};

/// @brief What one reading adds to its voxel.
struct VoxelReading {
  std::array<std::int64_t, 3> offset{};  // from the voxel's centre, fine
  const std::uint8_t* rgb = nullptr;     // three bytes; null where the colour is unknown
  std::array<std::int32_t, 3> normal{};  // kNormalUnit · normal, 0 where there is none

  /// @param sign 1 to add to the voxel, -1 to take away again.
  template <int sign>
  void apply(MapVoxel& voxel) const;
};

/// @brief Position of a block in the grid of blocks; x varies slowest in the order.
struct BlockIndex {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;
  auto operator<=>(const BlockIndex&) const = default;
};

struct BlockIndexHash {
  /// Teschner et al., "Optimized Spatial Hashing for Collision Detection of Deformable Objects",
  /// 2003.
  std::size_t operator()(const BlockIndex& index) const {
    return static_cast<std::size_t>(index.x) * 73856093U ^
           static_cast<std::size_t>(index.y) * 19349669U ^
           static_cast<std::size_t>(index.z) * 83492791U;
  }
};

/// @brief 8 x 8 x 8 voxels, of which only those that hold points take memory.
class MapBlock {
 public:
  static constexpr int kSideBits = 3;
  static constexpr int kSide = 1 << kSideBits;
  static constexpr int kVoxels = kSide * kSide * kSide;

  const MapVoxel* find(int number) const;
  MapVoxel* find(int number);
  /// @brief The voxel, added where it was not there. Valid until the next change of the block.
  MapVoxel& find_or_add(int number);
  void erase(int number);

  /// @brief Calls `action(number, voxel)` for every voxel, by ascending number.
  template <typename Action>
  void for_each(Action&& action) const {
    std::array<std::uint16_t, kVoxels> numbers;
    std::size_t count = 0;
    for (std::size_t word = 0; word < occupied_.size(); ++word) {
      for (std::uint64_t rest = occupied_[word]; rest != 0; rest &= rest - 1) {
        const auto number = 64 * word + static_cast<std::size_t>(std::countr_zero(rest));
        numbers[count++] = static_cast<std::uint16_t>(number);
        // They lie in order of first use: memory is asked for all of them before any is waited for.
        __builtin_prefetch(&voxels_[slot_[number]]);
      }
    }
    for (std::size_t i = 0; i < count; ++i) action(numbers[i], voxels_[slot_[numbers[i]]]);
  }

  std::size_t size() const { return voxels_.size(); }

 private:
  static constexpr std::uint16_t kNone = 0xffff;
  static constexpr std::array<std::uint16_t, kVoxels> no_slots() {
    std::array<std::uint16_t, kVoxels> slots{};
    slots.fill(kNone);
    return slots;
  }

  std::array<std::uint64_t, kVoxels / 64> occupied_{};    // a bit for each voxel that is there
  std::vector<MapVoxel> voxels_;                          // in order of first use
  std::vector<std::uint16_t> numbers_;                    // voxel number, by place in voxels_
  std::array<std::uint16_t, kVoxels> slot_ = no_slots();  // place in voxels_, by voxel number
};

/// @brief Where a point of the fine grid (1/4096 voxel) lies.
struct VoxelAddress {
  BlockIndex block;
  int number = 0;                        // voxel in the block, 0..511, x varies slowest
  std::array<std::int64_t, 3> offset{};  // from the voxel's centre, fine

  static VoxelAddress of(const std::array<std::int64_t, 3>& fine);
};

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

inline const MapVoxel* MapBlock::find(int number) const {
  const std::uint16_t slot = slot_[static_cast<std::size_t>(number)];
  return slot == kNone ? nullptr : &voxels_[slot];
}

inline MapVoxel* MapBlock::find(int number) {
  const std::uint16_t slot = slot_[static_cast<std::size_t>(number)];
  return slot == kNone ? nullptr : &voxels_[slot];
}

inline MapVoxel& MapBlock::find_or_add(int number) {
  std::uint16_t& slot = slot_[static_cast<std::size_t>(number)];
  if (slot == kNone) {
    slot = static_cast<std::uint16_t>(voxels_.size());
    voxels_.emplace_back();
    numbers_.push_back(static_cast<std::uint16_t>(number));
    occupied_[static_cast<std::size_t>(number) / 64] |= std::uint64_t{1} << (number % 64);
  }
  return voxels_[slot];
}

inline VoxelAddress VoxelAddress::of(const std::array<std::int64_t, 3>& fine) {
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
