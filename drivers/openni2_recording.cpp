// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <filesystem>
#include <optional>
#include <thread>

#include "drivers/frame_source.hpp"
#include "drivers/openni2_camera.hpp"
#include "drivers/openni2_stream.hpp"

namespace geomap::drivers {
namespace {

constexpr float kAtItsOwnPace = 1.0F, kWhenAsked = -1.0F;  // OpenNI2's speeds
// When asked twice for the same image, OpenNI2 reads two: a short wait would lose some [ms].
constexpr int kLongWait = 1000;
constexpr std::chrono::milliseconds kPlayerSleeps{15};  // while its streams are stopped

/// One stream of a recording.
class RecordedStream {
 public:
  RecordedStream(const std::string& uri, openni::SensorType type, bool lossless) {
    check_openni(device_.open(uri.c_str()), "cannot play " + uri + ", it may be cut off");
    stream_.emplace(device_, type);
    openni::PlaybackControl* playback = device_.getPlaybackControl();
    playback->setRepeatEnabled(false);
    playback->setSpeed(lossless ? kWhenAsked : kAtItsOwnPace);
    images_ = playback->getNumberOfFrames(stream_->handle());
    if (images_ < 1) throw SourceError("cannot play " + uri + ": it holds no images of one kind");
    stream_->start();
  }

  // The player's thread looks at its list of streams without a lock, at the file's end all the
  // time. Once the stream is stopped it does so every 10 ms, and the stream can be taken off the
  // list.
  ~RecordedStream() {
    stream_->stop();
    std::this_thread::sleep_for(kPlayerSleeps);
  }
  RecordedStream(const RecordedStream&) = delete;
  RecordedStream& operator=(const RecordedStream&) = delete;

  const openni::Device& device() const { return device_; }
  OpenNi2Stream& stream() { return *stream_; }
  const OpenNi2Stream& stream() const { return *stream_; }
  bool has_ended() const { return stream_->last_number() >= images_; }

 private:
  openni::Device device_;
  std::optional<OpenNi2Stream> stream_;
  int images_ = 0;
};

/// OpenNI2 hands out what comes next in a file, and waits for ever where that belongs to a stream
/// nobody asks for. So the file is opened for each stream; by another name, or it would be shared.
class OpenNi2Recording : public RgbdCamera {
 public:
  OpenNi2Recording(const std::filesystem::path& file, bool lossless, const KinectConfig& config)
      : lossless_(lossless),
        depth_(file.string(), openni::SENSOR_DEPTH, lossless),
        color_(file.parent_path() / "." / file.filename(), openni::SENSOR_COLOR, lossless),
        description_(describe_openni(depth_.device(), depth_.stream(), color_.stream(),
                                     config.registered)) {}

  const CameraDescription& description() const override { return description_; }
  bool has_ended() const override { return depth_.has_ended() && color_.has_ended(); }
  CameraLosses losses() const override {
    return depth_.stream().losses() + color_.stream().losses();
  }

  std::optional<CameraImage> read(std::chrono::milliseconds patience) override {
    if (has_ended()) return std::nullopt;
    OpenNi2Stream* stream = lossless_ ? next_in_turn() : first_to_come(patience);
    return stream ? stream->read() : std::nullopt;
  }

 private:
  OpenNi2Stream* next_in_turn() {
    const bool is_depth =
        color_.has_ended() ||
        (!depth_.has_ended() && depth_.stream().last_time() <= color_.stream().last_time());
    OpenNi2Stream& stream = is_depth ? depth_.stream() : color_.stream();
    return wait_for_openni({&stream}, kLongWait);
  }

  OpenNi2Stream* first_to_come(std::chrono::milliseconds patience) {
    return wait_for_openni({&depth_.stream(), &color_.stream()},
                           static_cast<int>(patience.count()));
  }

  bool lossless_;
  OpenNi2Library library_;
  RecordedStream depth_, color_;
  CameraDescription description_;
};

}  // namespace

std::unique_ptr<RgbdCamera> play_openni2(const std::filesystem::path& recording, bool lossless,
                                         const KinectConfig& config) {
  return std::make_unique<OpenNi2Recording>(std::filesystem::absolute(recording), lossless, config);
}

}  // namespace geomap::drivers
