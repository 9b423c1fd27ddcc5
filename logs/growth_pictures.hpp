// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "mapping/feature_store.hpp"
#include "mapping/geometric_map.hpp"

namespace geomap::logs {

/// @brief Pictures of the map while it grows (the paper's Figure 5): one every so many key frames,
/// all with the same extent and direction, what the last key frame touched drawn bold.
class GrowthPictures {
 public:
  /// @param every key frames between two pictures; 0 for none.
  explicit GrowthPictures(int every) : every_(every) {}

  /// @brief Call after each key frame. Keeps shared features, not copies.
  void note(const mapping::GeometricMap& map, const mapping::MapChange& change);

  /// @brief Writes keyframe_0001.svg and so on into the folder; nothing when no picture was asked
  /// for.
  /// @throws std::runtime_error when a file cannot be written.
  void write(const std::filesystem::path& folder) const;

 private:
  struct Moment {
    int keyframes = 0;
    std::int64_t revision = 0;
    mapping::FeatureSet features;
    std::vector<mapping::FeatureId> touched;
  };

  int every_;
  int keyframes_ = 0;
  std::vector<Moment> moments_;
};

}  // namespace geomap::logs
