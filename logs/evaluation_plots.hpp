// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "logs/page_document.hpp"
#include "logs/run_statistics.hpp"

namespace geomap::logs {

/// @brief The paper's Figure 6, left: planes extracted so far and planes in the map over key
/// frames, of each group's first seed. Nothing when no run has key frames.
std::optional<Picture> growth_picture(std::span<const RunGroup* const> groups);

/// @brief The paper's Figure 6, right: planes extracted for each plane in the map.
std::optional<Picture> reduction_picture(std::span<const RunGroup* const> groups);

/// @brief A figure of accuracy over the sensor's noise (sets n0, n005, n02), ours as means over
/// seeds and the paper's. Nothing when fewer than two noises were run.
/// @param kind d_angle or d_dist.
std::optional<Picture> noise_picture(std::span<const RunGroup> groups, const FigureKind& kind);

}  // namespace geomap::logs
