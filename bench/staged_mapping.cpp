// SPDX-License-Identifier: BSD-3-Clause
#include "staged_mapping.hpp"

#include <memory>
#include <utility>

namespace geomap::bench {

bool StagedMapping::add(const geometry::RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera,
                        const Meter& meter) {
  tracker_.prior().add_pose(frame.utime, T_world_camera);
  tracker_.prior().add_camera_to_body(frame.utime, Eigen::Isometry3d::Identity());
  perception::Tracked tracked;
  meter(0, [&] { tracked = tracker_.track(frame.utime, [&] { return &frame; }); });
  if (tracked.status != perception::TrackStatus::kKeyframe) return false;
  auto seen = std::make_shared<mapping::Observation>();
  seen->keyframe = frame.utime;
  seen->T_world_camera = *tracked.T_world_camera;
  const auto seed = static_cast<std::uint64_t>(frame.utime);
  meter(1, [&] { seen->planes = extractor_.extract(frame, seed, {}).planes; });
  meter(2, [&] { map_.apply(std::move(seen)); });
  return true;
}

}  // namespace geomap::bench
