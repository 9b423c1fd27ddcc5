// SPDX-License-Identifier: BSD-3-Clause
#include "logs/synthetic_log.hpp"

#include "messaging/channels.hpp"
#include "messaging/convert_frame.hpp"
#include "messaging/convert_geometry.hpp"
#include "messaging/encode.hpp"
#include "messaging/log_writer.hpp"
#include "support/plane_renderer.hpp"

namespace geomap::testing {

std::vector<messaging::LogEvent> synthetic_log(int frames, double sigma) {
  namespace channels = messaging::channels;
  std::vector<messaging::LogEvent> events;
  const auto add = [&](const char* channel, std::int64_t utime, const auto& message) {
    events.push_back(
        {static_cast<std::int64_t>(events.size()), utime, channel, messaging::encode(message)});
  };
  Eigen::Isometry3d T_body_camera = Eigen::Isometry3d::Identity();
  T_body_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  for (int i = 0; i < frames; ++i) {
    const std::int64_t utime = 1'000'000'000 + 33'333 * i;
    const Eigen::Isometry3d T_world_camera = look_at({0.05 * i, -1.5, 1.4}, {-0.4, 1.0, 0.6});
    Rendering rendering = render(small_room(), kinect_camera(2), T_world_camera, sigma,
                                 static_cast<std::uint32_t>(i + 1));
    rendering.frame.utime = utime;
    rendering.frame.sequence = i;
    add(channels::kCameraToBody, utime, messaging::to_rigid_transform(utime, T_body_camera));
    add(channels::kPose, utime,
        messaging::to_pose(utime, T_world_camera * T_body_camera.inverse()));
    add(channels::kRgbdFrame, utime, messaging::to_message(rendering.frame));
  }
  return events;
}

void write_log(const std::string& path, const std::vector<messaging::LogEvent>& events) {
  messaging::LogWriter writer(path);
  for (const messaging::LogEvent& event : events) {
    writer.write_bytes(event.channel, event.log_utime, event.data);
  }
  writer.close();
}

}  // namespace geomap::testing
