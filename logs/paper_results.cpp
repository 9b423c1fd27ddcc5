// SPDX-License-Identifier: BSD-3-Clause
#include "logs/paper_results.hpp"

#include <array>

namespace geomap::logs {

std::span<const PaperAccuracy> paper_accuracy() {
  static constexpr std::array<PaperAccuracy, 6> kRows = {{
      {"n0", "Table 1", "Table 1, no noise", 0.0067, 0.0071, 0.0054, 16.14, {}, ""},
      {"n005", "Table 1", "Table 1, sigma 5 mm", 0.0057, 0.0198, 0.0246, {}, {}, ""},
      {"n02", "Table 1", "Table 1, sigma 20 mm", 0.0580, 0.1368, 0.0211, 7.0, {}, ""},
      {"n0obj", "Table 1", "Table 1, with objects", 0.0056, 0.0084, 0.0048, {}, {}, ""},
      {"kinect", "real_1", "Table 2, real_1", 0.069, 0.102, 0.0421, {}, {}, ""},
      // The text analyses real_2; the caption of its table says real_1.
      {"kinect", "real_2", "Table 3, real_2", 0.066, 0.102, 0.0317, {}, 0.078, "kitchen front"},
  }};
  return kRows;
}

}  // namespace geomap::logs
