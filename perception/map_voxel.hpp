// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
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

  std::uint32_t count = 0;
  std::uint32_t colored = 0;             // points whose colour is known
  std::array<std::uint32_t, 3> color{};  // Σ red, green, blue; good for 16 million points
  std::array<std::int64_t, 3> first{};   // Σ offset
  std::array<std::int64_t, 6> second{};  // Σ offset offsetᵀ: xx xy xz yy yz zz
  std::array<std::int32_t, 3> normal{};  // Σ of kNormalUnit · normal; good for 2 million points

  static constexpr double kNormalUnit = 1024.0;
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

  std::size_t size() const { return voxels_.size(); }

 private:
  static constexpr std::uint16_t kNone = 0xffff;
  static constexpr std::array<std::uint16_t, kVoxels> no_slots() {
    std::array<std::uint16_t, kVoxels> slots{};
    slots.fill(kNone);
    return slots;
  }

  std::array<std::uint16_t, kVoxels> slot_ = no_slots();  // place in voxels_, by voxel number
  std::vector<MapVoxel> voxels_;                          // in order of first use
  std::vector<std::uint16_t> numbers_;                    // voxel number, by place in voxels_
};

/// @brief Where a point of the fine grid (1/4096 voxel) lies.
struct VoxelAddress {
  BlockIndex block;
  int number = 0;                        // voxel in the block, 0..511, x varies slowest
  std::array<std::int64_t, 3> offset{};  // from the voxel's centre, fine

  static VoxelAddress of(const std::array<std::int64_t, 3>& fine);
};

}  // namespace geomap::perception
