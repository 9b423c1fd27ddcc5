// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/openni2_camera.hpp"

#include <OpenNI.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <filesystem>

#include "drivers/frame_source.hpp"

namespace geomap::drivers {
namespace {

void check(openni::Status status, const std::string& action) {
  if (status == openni::STATUS_OK) return;
  std::string reason = openni::OpenNI::getExtendedError();
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  reason.erase(reason.find_last_not_of(" \t") + 1);
  throw SourceError(action + ": " + (reason.empty() ? "OpenNI2 gives no reason" : reason));
}

/// OpenNI2 itself. Started anew with each camera, so that its drivers look for devices again.
class Library {
 public:
  Library() { check(openni::OpenNI::initialize(), "cannot start OpenNI2"); }
  ~Library() { openni::OpenNI::shutdown(); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

/// Hears, in a thread of OpenNI2, when a device is unplugged.
class UnplugListener : public openni::OpenNI::DeviceDisconnectedListener {
 public:
  explicit UnplugListener(std::string uri) : uri_(std::move(uri)) {
    openni::OpenNI::addDeviceDisconnectedListener(this);
  }
  ~UnplugListener() override { openni::OpenNI::removeDeviceDisconnectedListener(this); }
  UnplugListener(const UnplugListener&) = delete;
  UnplugListener& operator=(const UnplugListener&) = delete;

  void onDeviceDisconnected(const openni::DeviceInfo* info) override {
    if (uri_ == info->getUri()) is_unplugged_ = true;
  }
  bool is_unplugged() const { return is_unplugged_; }

 private:
  std::string uri_;
  std::atomic<bool> is_unplugged_{false};
};

std::string format_name(openni::PixelFormat format) {
  switch (format) {
    case openni::PIXEL_FORMAT_DEPTH_1_MM:
      return "depth 1 mm";
    case openni::PIXEL_FORMAT_DEPTH_100_UM:
      return "depth 0.1 mm";
    case openni::PIXEL_FORMAT_RGB888:
      return "RGB";
    default:
      return fmt::format("format {}", static_cast<int>(format));
  }
}

std::string modes_of(const openni::SensorInfo& sensor) {
  std::string text;
  const auto& modes = sensor.getSupportedVideoModes();
  for (int i = 0; i < modes.getSize(); ++i) {
    const openni::VideoMode& mode = modes[i];
    text += fmt::format("{}{}x{} at {} ({})", text.empty() ? "" : ", ", mode.getResolutionX(),
                        mode.getResolutionY(), mode.getFps(), format_name(mode.getPixelFormat()));
  }
  return text;
}

bool is_usable(openni::PixelFormat format, openni::SensorType type) {
  if (type == openni::SENSOR_COLOR) return format == openni::PIXEL_FORMAT_RGB888;
  return format == openni::PIXEL_FORMAT_DEPTH_1_MM || format == openni::PIXEL_FORMAT_DEPTH_100_UM;
}

openni::VideoMode find_mode(const openni::SensorInfo& sensor, const KinectConfig& config) {
  const openni::VideoMode* found = nullptr;
  const auto& modes = sensor.getSupportedVideoModes();
  for (int i = 0; i < modes.getSize(); ++i) {
    const openni::VideoMode& mode = modes[i];
    if (mode.getResolutionX() != config.width || mode.getResolutionY() != config.height ||
        mode.getFps() != config.rate || !is_usable(mode.getPixelFormat(), sensor.getSensorType())) {
      continue;
    }
    if (!found || mode.getPixelFormat() == openni::PIXEL_FORMAT_DEPTH_1_MM) found = &mode;
  }
  if (found) return *found;
  throw SourceError(fmt::format("the camera has no {} mode {}x{} at {}; it has {}",
                                sensor.getSensorType() == openni::SENSOR_COLOR ? "colour" : "depth",
                                config.width, config.height, config.rate, modes_of(sensor)));
}

/// The rows of an image without padding; empty when there is less data than its size needs.
template <class Value>
std::vector<Value> rows_of(const openni::VideoFrameRef& frame, int values_per_pixel) {
  const auto width = static_cast<std::size_t>(frame.getWidth() * values_per_pixel);
  const auto height = static_cast<std::size_t>(frame.getHeight());
  const auto stride = static_cast<std::size_t>(frame.getStrideInBytes());
  const std::size_t row = width * sizeof(Value);
  if (height == 0 || stride < row ||
      static_cast<std::size_t>(frame.getDataSize()) < (height - 1) * stride + row) {
    return {};
  }
  std::vector<Value> values(width * height);
  const auto* data = static_cast<const std::uint8_t*>(frame.getData());
  for (std::size_t v = 0; v < height; ++v) {
    std::memcpy(values.data() + v * width, data + v * stride, row);
  }
  return values;
}

geometry::DepthImage depth_of(const openni::VideoFrameRef& frame) {
  geometry::DepthImage image{frame.getWidth(), frame.getHeight(), rows_of<std::uint16_t>(frame, 1)};
  if (frame.getVideoMode().getPixelFormat() == openni::PIXEL_FORMAT_DEPTH_100_UM) {
    for (std::uint16_t& value : image.millimetres) {
      value = static_cast<std::uint16_t>((value + 5) / 10);
    }
  }
  return image;
}

geometry::ColorImage color_of(const openni::VideoFrameRef& frame) {
  return {frame.getWidth(), frame.getHeight(), rows_of<std::uint8_t>(frame, 3)};
}

/// The file, or one beside it with a number where it is there: a camera that is opened again must
/// not overwrite what was recorded before.
std::string unused_name(const std::filesystem::path& file) {
  std::filesystem::path name = file;
  for (int number = 2; std::filesystem::exists(name); ++number) {
    name = file.parent_path() /
           fmt::format("{}-{}{}", file.stem().string(), number, file.extension().string());
  }
  return name.string();
}

// Its members close themselves, in the reverse of their order.
class OpenNi2Camera : public RgbdCamera {
 public:
  OpenNi2Camera(const OpenNi2Options& options, const KinectConfig& config) : config_(config) {
    const std::string name = options.device.empty() ? "any camera" : options.device;
    check(device_.open(options.device.empty() ? openni::ANY_DEVICE : options.device.c_str()),
          "cannot open " + name);
    const openni::DeviceInfo& info = device_.getDeviceInfo();
    unplug_ = std::make_unique<UnplugListener>(info.getUri());
    create(depth_, openni::SENSOR_DEPTH);
    create(color_, openni::SENSOR_COLOR);
    if (device_.isFile()) {
      set_playback(options.lossless);
    } else {
      set_up_device();
    }
    describe(fmt::format("{} {} ({})", info.getVendor(), info.getName(), info.getUri()));
    if (!options.recording.empty()) record(unused_name(options.recording));
    check(depth_.start(), "cannot start depth");
    check(color_.start(), "cannot start colour");
  }

  const CameraDescription& description() const override { return description_; }
  bool has_ended() const override { return device_.isFile() && left_[0] <= 0 && left_[1] <= 0; }
  std::int64_t torn() const override { return torn_; }

  std::optional<CameraImage> read(std::chrono::milliseconds patience) override {
    if (unplug_->is_unplugged()) throw SourceError(description_.name + " was unplugged");
    const std::optional<int> index = ready_stream(patience);
    if (!index) return std::nullopt;
    openni::VideoFrameRef frame;
    check((*index == 0 ? depth_ : color_).readFrame(&frame), "cannot read an image");
    --left_[static_cast<std::size_t>(*index)];
    newest_[static_cast<std::size_t>(*index)] = frame.getTimestamp();
    return image_of(frame, *index == 0);
  }

 private:
  void create(openni::VideoStream& stream, openni::SensorType type) {
    check(stream.create(device_, type),
          type == openni::SENSOR_DEPTH ? "the camera has no depth" : "the camera has no colour");
    if (device_.isFile()) return;
    check(stream.setVideoMode(find_mode(*device_.getSensorInfo(type), config_)),
          "the camera refuses its mode");
    stream.setMirroringEnabled(false);
  }

  void set_up_device() {
    const auto registration = config_.registered ? openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR
                                                 : openni::IMAGE_REGISTRATION_OFF;
    if (device_.isImageRegistrationModeSupported(registration)) {
      check(device_.setImageRegistrationMode(registration), "cannot register depth to colour");
    }
    device_.setDepthColorSyncEnabled(true);  // cameras without it still pair by time stamp
  }

  void set_playback(bool lossless) {
    openni::PlaybackControl* playback = device_.getPlaybackControl();
    playback->setRepeatEnabled(false);
    playback->setSpeed(lossless ? -1.0F : 1.0F);
    is_lossless_ = lossless;
    left_ = {playback->getNumberOfFrames(depth_), playback->getNumberOfFrames(color_)};
  }

  // A recording has the size it has.
  void describe(const std::string& name) {
    description_.name = name;
    const auto camera = [this](const openni::VideoStream& stream) {
      KinectConfig actual = config_;
      actual.width = stream.getVideoMode().getResolutionX();
      actual.height = stream.getVideoMode().getResolutionY();
      return actual.camera(stream.getHorizontalFieldOfView(), stream.getVerticalFieldOfView());
    };
    description_.color = camera(color_);
    const bool is_registered =
        device_.getImageRegistrationMode() == openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR;
    description_.depth = is_registered ? description_.color : camera(depth_);
    if (!description_.depth.valid() || !description_.color.valid()) {
      throw SourceError(name + " does not say its field of view: set kinect.fx and the others");
    }
  }

  void record(const std::string& file) {
    check(recorder_.create(file.c_str()), "cannot write " + file);
    check(recorder_.attach(depth_, false), "cannot record depth");
    check(recorder_.attach(color_, false), "cannot record colour");
    check(recorder_.start(), "cannot record to " + file);
  }

  // OpenNI2 plays a recording at full speed only to who waits for one stream: take them in turn.
  std::optional<int> ready_stream(std::chrono::milliseconds patience) {
    if (is_lossless_) {
      if (has_ended()) return std::nullopt;
      if (left_[0] <= 0 || left_[1] <= 0) return left_[0] > 0 ? 0 : 1;
      return newest_[0] <= newest_[1] ? 0 : 1;
    }
    std::array<openni::VideoStream*, 2> streams{&depth_, &color_};
    int index = -1;
    const openni::Status status = openni::OpenNI::waitForAnyStream(
        streams.data(), 2, &index, static_cast<int>(patience.count()));
    if (status == openni::STATUS_TIME_OUT) return std::nullopt;
    check(status, "cannot wait for an image");
    return index;
  }

  std::optional<CameraImage> image_of(const openni::VideoFrameRef& frame, bool is_depth) {
    CameraImage result;
    result.sensor_time = static_cast<std::int64_t>(frame.getTimestamp());
    bool is_whole = false;
    if (is_depth) {
      geometry::DepthImage depth = depth_of(frame);
      is_whole = !depth.empty();
      result.image = std::move(depth);
    } else {
      geometry::ColorImage color = color_of(frame);
      is_whole = !color.empty();
      result.image = std::move(color);
    }
    if (is_whole) return result;
    ++torn_;
    return std::nullopt;
  }

  KinectConfig config_;
  Library library_;
  openni::Device device_;
  std::unique_ptr<UnplugListener> unplug_;
  openni::VideoStream depth_, color_;
  openni::Recorder recorder_;
  CameraDescription description_;
  bool is_lossless_ = false;
  std::array<int, 2> left_{};              // images of a recording: depth, colour
  std::array<std::uint64_t, 2> newest_{};  // their sensor's times [us]
  std::int64_t torn_ = 0;
};

}  // namespace

std::unique_ptr<RgbdCamera> open_openni2(const OpenNi2Options& options,
                                         const KinectConfig& config) {
  OpenNi2Options resolved = options;
  if (options.device.ends_with(".oni")) {
    resolved.device = std::filesystem::absolute(options.device).string();
  }
  return std::make_unique<OpenNi2Camera>(resolved, config);
}

std::string list_openni2() {
  const Library library;
  openni::Array<openni::DeviceInfo> devices;
  openni::OpenNI::enumerateDevices(&devices);
  std::string text;
  for (int i = 0; i < devices.getSize(); ++i) {
    text += fmt::format("{}  {} {}\n", devices[i].getUri(), devices[i].getVendor(),
                        devices[i].getName());
    openni::Device device;
    if (device.open(devices[i].getUri()) != openni::STATUS_OK) {
      text += "  cannot be opened: another program may have it\n";
      continue;
    }
    for (const auto type : {openni::SENSOR_DEPTH, openni::SENSOR_COLOR}) {
      const openni::SensorInfo* sensor = device.getSensorInfo(type);
      if (sensor) text += "  " + modes_of(*sensor) + "\n";
    }
    device.close();
  }
  return text.empty() ? "no camera\n" : text;
}

}  // namespace geomap::drivers
