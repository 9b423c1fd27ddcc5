// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/freenect_camera.hpp"

#include <fmt/format.h>
#include <libfreenect.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <deque>
#include <utility>
#include <vector>

#include "drivers/frame_source.hpp"
#include "drivers/kinect_disparity.hpp"
#include "drivers/tick_clock.hpp"
#include "geometry/angles.hpp"

namespace geomap::drivers {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostWaiting = 16;            // images, should nobody read
constexpr std::chrono::seconds kAttitudePeriod{1};  // reading it keeps the USB bus busy

void check(int result, const std::string& action) {
  if (result < 0) throw SourceError(fmt::format("{} (libfreenect's error {})", action, result));
}

/// libfreenect itself, for motor and camera.
class Context {
 public:
  Context() {
    check(freenect_init(&context_, nullptr), "cannot start libfreenect");
    freenect_set_log_level(context_, FREENECT_LOG_FATAL);  // what fails, returns that it does
    freenect_select_subdevices(context_, static_cast<freenect_device_flags>(
                                             FREENECT_DEVICE_MOTOR | FREENECT_DEVICE_CAMERA));
  }
  ~Context() { freenect_shutdown(context_); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  freenect_context* handle() const { return context_; }
  int devices() const { return freenect_num_devices(context_); }

 private:
  freenect_context* context_ = nullptr;
};

class Device {
 public:
  Device(const Context& context, const std::string& name) {
    if (context.devices() <= 0) throw SourceError("libfreenect finds no Kinect");
    int number = 0;
    const auto parsed = std::from_chars(name.data(), name.data() + name.size(), number);
    const bool is_number =
        name.empty() || (parsed.ec == std::errc() && parsed.ptr == name.data() + name.size() &&
                         number >= 0 && number < context.devices());
    const int result =
        is_number ? freenect_open_device(context.handle(), &device_, number)
                  : freenect_open_device_by_camera_serial(context.handle(), &device_, name.c_str());
    check(result, fmt::format("cannot open Kinect {}; another program may have it, or this one no "
                              "right to use it",
                              name.empty() ? "0" : name));
  }
  ~Device() {
    freenect_stop_depth(device_);
    freenect_stop_video(device_);
    freenect_close_device(device_);
  }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  freenect_device* handle() const { return device_; }

 private:
  freenect_device* device_ = nullptr;
};

/// The first mode that the library has of these formats.
freenect_frame_mode depth_mode(std::initializer_list<freenect_depth_format> formats) {
  for (const freenect_depth_format format : formats) {
    for (int i = 0; i < freenect_get_depth_mode_count(); ++i) {
      const freenect_frame_mode mode = freenect_get_depth_mode(i);
      if (mode.is_valid && mode.resolution == FREENECT_RESOLUTION_MEDIUM &&
          mode.depth_format == format) {
        return mode;
      }
    }
  }
  throw SourceError("libfreenect has no depth at 640x480");
}

freenect_led_options led_of(const std::string& name) {
  if (name == "green") return LED_GREEN;
  if (name == "red") return LED_RED;
  if (name == "yellow") return LED_YELLOW;
  if (name == "blink") return LED_BLINK_GREEN;
  return LED_OFF;
}

class FreenectCamera : public RgbdCamera {
 public:
  FreenectCamera(const FreenectOptions& options, const KinectConfig& config)
      : device_(context_, options.device) {
    if (config.width != 640 || config.height != 480 || config.rate != 30) {
      throw SourceError(fmt::format("a Kinect has no mode {}x{} at {}; it has 640x480 at 30",
                                    config.width, config.height, config.rate));
    }
    const freenect_frame_mode depth =
        config.registered ? depth_mode({FREENECT_DEPTH_REGISTERED, FREENECT_DEPTH_11BIT})
                          : depth_mode({FREENECT_DEPTH_MM, FREENECT_DEPTH_11BIT});
    format_ = depth.depth_format;
    description_.name = "Kinect " + (options.device.empty() ? "0" : options.device);
    description_.color = nominal_kinect_color_camera();
    description_.is_registered = format_ == FREENECT_DEPTH_REGISTERED;
    description_.depth =
        description_.is_registered ? description_.color : nominal_kinect_depth_camera();
    freenect_set_user(device_.handle(), this);
    freenect_set_depth_callback(device_.handle(), take_depth);
    freenect_set_video_callback(device_.handle(), take_color);
    check(freenect_set_depth_mode(device_.handle(), depth), "the Kinect refuses its depth mode");
    check(freenect_set_video_mode(
              device_.handle(),
              freenect_find_video_mode(FREENECT_RESOLUTION_MEDIUM, FREENECT_VIDEO_RGB)),
          "the Kinect refuses its colour mode");
    check(freenect_start_depth(device_.handle()), "cannot start depth");
    check(freenect_start_video(device_.handle()), "cannot start colour");
    freenect_set_led(device_.handle(), led_of(config.led));
    if (options.tilt) {
      freenect_set_tilt_degs(device_.handle(), geometry::degrees(*options.tilt));
    }
  }
  ~FreenectCamera() override { freenect_set_led(device_.handle(), LED_OFF); }

  const CameraDescription& description() const override { return description_; }
  CameraLosses losses() const override { return losses_; }

  std::optional<CameraImage> read(std::chrono::milliseconds patience) override {
    const auto end = Clock::now() + patience;
    while (images_.empty() && Clock::now() < end) {
      timeval wait{0, 1000 * static_cast<suseconds_t>(patience.count())};
      check(freenect_process_events_timeout(context_.handle(), &wait),
            description_.name + " was unplugged, or fails");
    }
    if (images_.empty()) return std::nullopt;
    CameraImage image = std::move(images_.front());
    images_.pop_front();
    return image;
  }

  std::optional<CameraAttitude> attitude() override {
    if (Clock::now() - attitude_read_ < kAttitudePeriod) return std::nullopt;
    attitude_read_ = Clock::now();
    if (freenect_update_tilt_state(device_.handle()) < 0) return std::nullopt;
    freenect_raw_tilt_state* state = freenect_get_tilt_state(device_.handle());
    double left = 0.0, up = 0.0, forward = 0.0;
    freenect_get_mks_accel(state, &left, &up, &forward);
    // Nothing was read: later models have their motor elsewhere, and the library says that all is
    // well.
    if (left == 0.0 && up == 0.0 && forward == 0.0) return std::nullopt;
    return CameraAttitude{{-left, -up, forward}, geometry::radians(freenect_get_tilt_degs(state))};
  }

 private:
  static FreenectCamera& self(freenect_device* device) {
    return *static_cast<FreenectCamera*>(freenect_get_user(device));
  }

  static void take_depth(freenect_device* device, void* data, std::uint32_t ticks) {
    FreenectCamera& camera = self(device);
    geometry::DepthImage image{640, 480, std::vector<std::uint16_t>(640 * 480)};
    std::memcpy(image.millimetres.data(), data, 2 * image.millimetres.size());
    if (camera.format_ == FREENECT_DEPTH_11BIT) {
      for (std::uint16_t& value : image.millimetres) value = millimetres_of_disparity(value);
    }
    camera.keep({camera.clock_.microseconds(ticks), std::move(image)});
  }

  static void take_color(freenect_device* device, void* data, std::uint32_t ticks) {
    FreenectCamera& camera = self(device);
    const auto* rgb = static_cast<const std::uint8_t*>(data);
    geometry::ColorImage image{640, 480, {rgb, rgb + 3 * 640 * 480}};
    camera.keep({camera.clock_.microseconds(ticks), std::move(image)});
  }

  void keep(CameraImage image) {
    images_.push_back(std::move(image));
    if (images_.size() <= kMostWaiting) return;
    images_.pop_front();
    ++losses_.missed;
  }

  Context context_;
  Device device_;
  freenect_depth_format format_ = FREENECT_DEPTH_MM;
  CameraDescription description_;
  std::deque<CameraImage> images_;
  TickClock clock_;
  CameraLosses losses_;
  Clock::time_point attitude_read_;
};

}  // namespace

std::unique_ptr<RgbdCamera> open_freenect(const FreenectOptions& options,
                                          const KinectConfig& config) {
  return std::make_unique<FreenectCamera>(options, config);
}

std::string list_freenect() {
  const Context context;
  std::string text;
  for (int number = 0; number < context.devices(); ++number) {
    text += fmt::format("{}  Kinect\n  640x480 at 30 (depth 1 mm), 640x480 at 30 (RGB)\n", number);
  }
  return text;
}

}  // namespace geomap::drivers
