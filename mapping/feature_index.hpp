// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "mapping/map_feature.hpp"

namespace geomap::mapping {

/// @brief R-tree over the bounding boxes of map features (world frame).
class FeatureIndex {
 public:
  FeatureIndex();
  ~FeatureIndex();
  FeatureIndex(FeatureIndex&&) noexcept;
  FeatureIndex& operator=(FeatureIndex&&) noexcept;

  void insert(const FeatureId& id, const Eigen::AlignedBox3d& box);
  /// @brief Removes the entry that was inserted with this id and box.
  void remove(const FeatureId& id, const Eigen::AlignedBox3d& box);
  /// @brief Ids of all boxes that meet `box`, ascending.
  std::vector<FeatureId> query(const Eigen::AlignedBox3d& box) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace geomap::mapping
