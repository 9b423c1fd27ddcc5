// SPDX-License-Identifier: BSD-3-Clause
#include "perception/planes_process.hpp"

#include <fmt/format.h>

#include <utility>

#include "messaging/channels.hpp"
#include "messaging/convert_frame.hpp"
#include "messaging/convert_geometry.hpp"

namespace geomap::perception {

namespace channels = messaging::channels;

PlaneExtractionConfig read_extraction_config(const messaging::Config& config) {
  return {config.read<ExtractorChoice>("extraction"),
          config.read<OrganizedExtractorConfig>("organized"),
          config.read<RansacExtractorConfig>("ransac")};
}

PlanesProcess::PlanesProcess(const PlaneExtractionConfig& config, messaging::LiveProcess& live)
    : live_(live), extractor_(make_extractor(config)) {
  live_.on<geomap::keyframe_t>(channels::kKeyframe, messaging::Keep::kEvery,
                               [this](const geomap::keyframe_t& keyframe) { take(keyframe); });
}

void PlanesProcess::take(const geomap::keyframe_t& keyframe) {
  live_.note_missing(channels::kKeyframe, sequence_.note(keyframe.session, keyframe.sequence));
  live_.health().note_utime(keyframe.utime);
  if (keyframe.status != geomap::keyframe_t::ACCEPTED) return;
  const messaging::FrameResult decoded = messaging::to_frame(keyframe.frame);
  if (!decoded.frame) {
    live_.reject(channels::kKeyframe, messaging::to_string(decoded.fault));
    return;
  }
  if (!session_) live_.health().set_session(*(session_ = keyframe.utime));
  const Eigen::Isometry3d T_world_camera = messaging::from_message(keyframe.T_world_camera);
  ExtractedPlanes found =
      extractor_->extract_keyframe(*decoded.frame, keyframe.utime, T_world_camera);
  live_.health().time("extraction", found.extraction_seconds);
  live_.health().time("hull", found.hull_seconds);
  planes_ += static_cast<std::int64_t>(found.planes.size());
  live_.publish(channels::kPlanes, messaging::to_message(messaging::PlaneSet{
                                       keyframe.utime, *session_, published_++, T_world_camera,
                                       found.noise.factor, std::move(found.planes)}));
}

std::string PlanesProcess::summary() const {
  return fmt::format("{} planes of {} key frames\n", planes_, published_);
}

}  // namespace geomap::perception
