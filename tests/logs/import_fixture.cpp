// SPDX-License-Identifier: BSD-3-Clause
#include "logs/import_fixture.hpp"

#include <stdexcept>

#include "drivers/camera_mount.hpp"
#include "drivers/seven_scenes_source.hpp"
#include "messaging/channels.hpp"
#include "messaging/convert_frame.hpp"
#include "messaging/convert_geometry.hpp"
#include "messaging/log_reader.hpp"
#include "messaging/safe_decode.hpp"

namespace geomap::logs {
namespace {

namespace channels = messaging::channels;

template <class Message>
Message decoded(const messaging::LogEvent& event) {
  const auto result = messaging::safe_decode<Message>(event.data.data(), event.data.size());
  if (!result.message) throw std::runtime_error(event.channel + ": " + to_string(result.reason));
  EXPECT_EQ(result.message->utime, event.log_utime);
  return *result.message;
}

}  // namespace

ImportedLog read_log(const std::filesystem::path& path) {
  ImportedLog log;
  messaging::LogReader reader(path.string());
  while (const auto event = reader.next()) {
    log.order.push_back(event->channel);
    if (event->channel == channels::kRgbdFrame) {
      const auto message = decoded<geomap::rgbd_frame_t>(*event);
      log.frames.push_back(messaging::to_frame(message).frame.value());
      log.color_bytes.push_back(message.color.data);
    } else if (event->channel == channels::kPose) {
      log.pose[event->log_utime] = messaging::from_message(decoded<bot_core::pose_t>(*event));
    } else {
      auto& poses = event->channel == channels::kTruthPose ? log.truth : log.camera_to_body;
      poses[event->log_utime] =
          messaging::from_message(decoded<bot_core::rigid_transform_t>(*event));
    }
  }
  EXPECT_THAT(reader.damages(), ::testing::IsEmpty());
  return log;
}

void expect_near(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  EXPECT_LT((a.matrix() - b.matrix()).norm(), 1e-9);
}

ImportSummary ImportTest::import_with(const ImportSettings& settings) {
  drivers::SevenScenesSource source(folder_.path());
  return import_frames(source, settings, out_.string(), [](std::size_t) { return true; });
}

ImportedLog ImportTest::imported(const ImportSettings& settings) {
  import_with(settings);
  return read_log(out_);
}

Eigen::Isometry3d ImportTest::true_body_pose(int number) {
  return testing::some_pose(number) * drivers::forward_camera_mount().inverse();
}

}  // namespace geomap::logs
