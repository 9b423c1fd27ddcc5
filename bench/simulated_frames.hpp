// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "posed_frames.hpp"

namespace geomap::bench {

/// @brief Hands out the frames of a simulated room at 10 Hz, with a Kinect's faults and true poses.
/// @param scene, trajectory files as of geomap-sim. @throws as their readers.
void visit_simulation(const std::string& scene, const std::string& trajectory,
                      const FrameVisitor& visitor);

}  // namespace geomap::bench
