// SPDX-License-Identifier: BSD-3-Clause
#include "perception/keyframe_journal.hpp"

#include <string_view>
#include <utility>

#include "messaging/convert_frame.hpp"
#include "messaging/log_reader.hpp"
#include "messaging/safe_decode.hpp"

namespace geomap::perception {
namespace {

namespace channels = messaging::channels;

// With colour as it is: a JPEG would come back with other values.
geomap::rgbd_frame_t exact_message(const geometry::RgbdFrame& frame) {
  geometry::RgbdFrame without_color = frame;
  without_color.color = {};
  geomap::rgbd_frame_t message = messaging::to_message(without_color);
  if (frame.color.empty()) return message;
  bot_core::image_t& color = message.color;
  color.utime = frame.utime;
  color.width = frame.color.width;
  color.height = frame.color.height;
  color.row_stride = 3 * frame.color.width;
  color.pixelformat = bot_core::image_t::PIXEL_FORMAT_RGB;
  color.data = frame.color.rgb;
  color.size = static_cast<std::int32_t>(color.data.size());
  return message;
}

// Puts one record into the tracker. @return false for one that cannot be used.
bool restore_one(const messaging::LogEvent& event, Tracker& tracker) {
  const auto* data = event.data.data();
  const std::size_t size = event.data.size();
  if (event.channel == channels::kKeyframe) {
    const auto decoded = messaging::safe_decode<geomap::keyframe_t>(data, size);
    if (!decoded.message) return false;
    const messaging::FrameResult frame = messaging::to_frame(decoded.message->frame);
    if (!frame.frame) return false;
    tracker.restore(decoded.message->utime, *frame.frame,
                    messaging::from_message(decoded.message->T_world_camera));
    return true;
  }
  if (event.channel == channels::kOdomToWorld) {
    const auto decoded = messaging::safe_decode<bot_core::rigid_transform_t>(data, size);
    if (decoded.message) tracker.restore_odometry(messaging::from_message(*decoded.message));
    return decoded.message.has_value();
  }
  const auto decoded = messaging::safe_decode<geomap::keyframe_update_t>(data, size);
  if (!decoded.message) return false;
  for (const std::int64_t keyframe : decoded.message->removed) tracker.remove(keyframe);
  for (const std::int64_t keyframe : decoded.message->dropped) tracker.remove(keyframe);
  for (const std::int64_t keyframe : decoded.message->restored) tracker.put_back(keyframe);
  return true;
}

}  // namespace

KeyframeJournal::KeyframeJournal(const std::filesystem::path& folder)
    : file_(folder / "keyframes.lcmlog") {
  std::filesystem::create_directories(folder);
}

KeyframeJournal::Restored KeyframeJournal::restore(Tracker& tracker) {
  Restored restored;
  std::error_code ignored;
  if (std::filesystem::file_size(file_, ignored) > 0 && !ignored) {
    messaging::LogReader reader(file_.string());
    while (const auto event = reader.next()) {
      bool is_used = false;
      try {
        is_used = restore_one(*event, tracker);
      } catch (const std::invalid_argument&) {  // twice the same, or a pose that is none
      }
      if (!is_used) ++restored.refused;
    }
    restored.refused += reader.damages().size();
    restored.keyframes = tracker.point_map().keyframes();
  }
  writer_.emplace(file_.string(), messaging::LogWriter::Mode::kAppend);
  return restored;
}

void KeyframeJournal::keep(const TrackedFrame& frame, const Tracker& tracker) {
  const geometry::RgbdFrame* thin = tracker.point_map().thin_frame_of(frame.message.utime);
  if (thin == nullptr) return;
  TrackingMessages messages;
  messages.send(frame, [&](const char* channel, std::int64_t utime, auto message) {
    if (std::string_view(channel) == channels::kCameraPose) return;  // KEYFRAME says the same
    if constexpr (std::is_same_v<decltype(message), geomap::keyframe_t>) {
      message.frame = exact_message(*thin);
    }
    writer_->write(channel, utime, message);
  });
  writer_->flush();
}

void KeyframeJournal::keep(const geomap::keyframe_update_t& update) {
  writer_->write(channels::kKeyframeUpdate, update.utime, update);
  writer_->flush();
}

void KeyframeJournal::clear() { writer_.emplace(file_.string()); }

}  // namespace geomap::perception
