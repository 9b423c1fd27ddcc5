// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "mapping/geometric_map.hpp"

namespace geomap::testing {

/// @brief Does to a map whatever an operator can do, of all kinds and at random.
class RandomOperator {
 public:
  explicit RandomOperator(std::uint32_t seed) : random_(seed) {}

  /// @brief A command for this map; it may be one that is refused.
  mapping::EditCommand next(const mapping::GeometricMap& map);

  /// @brief Makes up to `count` edits that are done. @return how many there were.
  int edit(mapping::GeometricMap& map, int count);

  /// @brief Undoes all edits, the newest first or in random order. @return false when one that is
  /// not undone is left.
  bool undo_all(mapping::GeometricMap& map, bool in_random_order);

 private:
  int below(std::size_t end) {
    return std::uniform_int_distribution<int>(0, static_cast<int>(end) - 1)(random_);
  }
  double metres(double most) {
    return std::uniform_real_distribution<double>(-most, most)(random_);
  }
  mapping::FeatureId any_feature(const mapping::GeometricMap& map);
  std::vector<std::int64_t> any_edit(const mapping::GeometricMap& map);
  std::vector<Eigen::Vector3d> drawn_on(const mapping::MapFeature& feature, int corners);

  std::mt19937 random_;
  std::int64_t command_ = 0;
};

}  // namespace geomap::testing
