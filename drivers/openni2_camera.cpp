// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/openni2_camera.hpp"

#include <fmt/format.h>

#include <atomic>
#include <optional>
#include <utility>

#include "drivers/frame_source.hpp"
#include "drivers/openni2_stream.hpp"

namespace geomap::drivers {
namespace {

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
  OpenNi2Camera(const std::string& uri, const std::string& recording, const KinectConfig& config) {
    check_openni(device_.open(uri.empty() ? openni::ANY_DEVICE : uri.c_str()),
                 "cannot open " + (uri.empty() ? "any camera" : uri));
    unplug_.emplace(device_.getDeviceInfo().getUri());
    depth_.emplace(device_, openni::SENSOR_DEPTH);
    color_.emplace(device_, openni::SENSOR_COLOR);
    set_mode(*depth_, openni::SENSOR_DEPTH, config);
    set_mode(*color_, openni::SENSOR_COLOR, config);
    set_registration(config.registered);
    device_.setDepthColorSyncEnabled(true);  // cameras without it still pair by time stamp
    const bool is_registered =
        device_.getImageRegistrationMode() == openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR;
    description_ = describe_openni(device_, *depth_, *color_, is_registered);
    if (!recording.empty()) record(unused_name(recording));
    depth_->start();
    color_->start();
  }

  // OpenNI2 detaches a recorder under a lock that a thread with an image may wait for, while it
  // holds one that detaching needs: no image may be on its way then, or neither of them ever goes
  // on.
  ~OpenNi2Camera() override {
    recorder_.stop();
    depth_->stop();
    color_->stop();
  }
  OpenNi2Camera(const OpenNi2Camera&) = delete;
  OpenNi2Camera& operator=(const OpenNi2Camera&) = delete;

  const CameraDescription& description() const override { return description_; }
  CameraLosses losses() const override { return depth_->losses() + color_->losses(); }

  std::optional<CameraImage> read(std::chrono::milliseconds patience) override {
    if (unplug_->is_unplugged()) throw SourceError(description_.name + " was unplugged");
    OpenNi2Stream* stream =
        wait_for_openni({&*depth_, &*color_}, static_cast<int>(patience.count()));
    return stream ? stream->read() : std::nullopt;
  }

 private:
  void set_mode(OpenNi2Stream& stream, openni::SensorType type, const KinectConfig& config) {
    check_openni(stream.handle().setVideoMode(find_mode(*device_.getSensorInfo(type), config)),
                 "the camera refuses its mode");
    stream.handle().setMirroringEnabled(false);
  }

  void set_registration(bool is_wanted) {
    const auto mode =
        is_wanted ? openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR : openni::IMAGE_REGISTRATION_OFF;
    if (!device_.isImageRegistrationModeSupported(mode)) return;
    check_openni(device_.setImageRegistrationMode(mode), "cannot register depth to colour");
  }

  void record(const std::string& file) {
    check_openni(recorder_.create(file.c_str()), "cannot write " + file);
    check_openni(recorder_.attach(depth_->handle(), false), "cannot record depth");
    check_openni(recorder_.attach(color_->handle(), true), "cannot record colour");
    check_openni(recorder_.start(), "cannot record to " + file);
  }

  OpenNi2Library library_;
  openni::Device device_;
  std::optional<UnplugListener> unplug_;
  std::optional<OpenNi2Stream> depth_, color_;
  openni::Recorder recorder_;
  CameraDescription description_;
};

}  // namespace

std::unique_ptr<RgbdCamera> open_openni2(const std::string& uri, const std::string& recording,
                                         const KinectConfig& config) {
  return std::make_unique<OpenNi2Camera>(uri, recording, config);
}

std::string list_openni2() {
  const OpenNi2Library library;
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
  return text;
}

}  // namespace geomap::drivers
