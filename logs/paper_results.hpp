// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace geomap::logs {

/// @brief One row of the base paper's tables of accuracy; nothing where it gives no figure.
struct PaperAccuracy {
  std::string_view set;              // the set of runs it stands beside: "n0", "kinect", ...
  std::string_view name;             // the paper's own name for it
  std::string_view source;           // table and row
  double d_angle = 0.0;              // [rad]
  double d_dist = 0.0;               // [m]
  double rms_p = 0.0;                // [m]
  std::optional<double> reduction;   // planes extracted for each plane in the map
  std::optional<double> rms_p_part;  // of `part` alone [m]
  std::string_view part;
};

/// @brief Table 1 (simulation) and Tables 2 and 3 (robot), in the paper's order.
std::span<const PaperAccuracy> paper_accuracy();

/// @brief Table 4: mean time per key frame [s], on an i7 at 2.8 GHz.
struct PaperTimes {
  double registration = 0.027;
  double extraction = 0.165;  // planes with their outlines
  double merging = 0.002;
  double total = 0.194;
  int runs = 100;
  int keyframes = 52;
  int planes = 152;  // extracted in all
};

/// @brief Table 5: bytes of each stage.
struct PaperReduction {
  int keyframes = 17;
  double raw_bytes = 62.7e6;
  double point_map_bytes = 595e3;
  double map_bytes = 6.5e3;
};

}  // namespace geomap::logs
