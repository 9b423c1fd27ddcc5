// SPDX-License-Identifier: BSD-3-Clause
// An OpenNI2 driver with one camera that is not there. It serves the depth images of the file
// `depth.raw` (640x480, 16 bits, mm) in the folder $GEOMAP_VIRTUAL_CAMERA, forwards and backwards,
// at 30 a second, with their shading as colour; also at half the size and rate, depth in 0.1 mm
// then. The file `control` beside it holds what the camera does: run, stall, stall-depth, tear
// (half the bytes are missing), unplug, hang (a call does not return).
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

// What the header needs and Debian does not ship.
#define XN_NEW(type, ...) new type(__VA_ARGS__)
#define XN_DELETE(pointer) delete (pointer)
#include <Driver/OniDriverAPI.h>

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kWidth = 640, kHeight = 480, kRate = 30;
constexpr int kPixels = kWidth * kHeight;
constexpr int kModes = 2;
constexpr const char* kUri = "virtual://kitchen";
constexpr float kHorizontalFov = 0.994838F, kVerticalFov = 0.750492F;  // geomap-sim's [rad]

std::string folder() {
  const char* name = std::getenv("GEOMAP_VIRTUAL_CAMERA");
  return name ? name : ".";
}

bool control_is(const std::string& wanted) {
  std::string word;
  std::ifstream(folder() + "/control") >> word;
  return word == wanted;
}

template <class T>
OniStatus give(const T& value, void* data, int* size) {
  if (*size != static_cast<int>(sizeof value)) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, &value, sizeof value);
  return ONI_STATUS_OK;
}

// The whole size first, then half of it.
OniVideoMode mode_of(OniSensorType type, int index) {
  const int divisor = index + 1;
  const OniPixelFormat depth =
      index == 0 ? ONI_PIXEL_FORMAT_DEPTH_1_MM : ONI_PIXEL_FORMAT_DEPTH_100_UM;
  return {type == ONI_SENSOR_DEPTH ? depth : ONI_PIXEL_FORMAT_RGB888, kWidth / divisor,
          kHeight / divisor, kRate / divisor};
}

class Stream : public oni::driver::StreamBase {
 public:
  Stream(OniSensorType type, Clock::time_point epoch)
      : mode_(mode_of(type, 0)),
        type_(type),
        epoch_(epoch),
        file_(folder() + "/depth.raw", std::ios::binary) {
    file_.seekg(0, std::ios::end);
    images_ = static_cast<int>(file_.tellg() / (2 * kPixels));
  }
  ~Stream() override { stop(); }

  OniStatus start() override {
    is_running_ = true;
    thread_ = std::thread([this] { serve(); });
    return ONI_STATUS_OK;
  }
  void stop() override {
    is_running_ = false;
    if (thread_.joinable()) thread_.join();
  }

  OniBool isPropertySupported(int id) override {
    return id <= ONI_STREAM_PROPERTY_MIRRORING ? TRUE : FALSE;
  }
  OniStatus getProperty(int id, void* data, int* size) override {
    switch (id) {
      case ONI_STREAM_PROPERTY_VIDEO_MODE:
        return give(mode_, data, size);
      case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
        return give(kHorizontalFov, data, size);
      case ONI_STREAM_PROPERTY_VERTICAL_FOV:
        return give(kVerticalFov, data, size);
      case ONI_STREAM_PROPERTY_MAX_VALUE:
        return give(10000, data, size);
      case ONI_STREAM_PROPERTY_MIN_VALUE:
        return give(0, data, size);
      case ONI_STREAM_PROPERTY_STRIDE:
        return give(stride(), data, size);
      case ONI_STREAM_PROPERTY_CROPPING:
        return give(OniCropping{FALSE, 0, 0, mode_.resolutionX, mode_.resolutionY}, data, size);
      case ONI_STREAM_PROPERTY_MIRRORING:
        return give<OniBool>(FALSE, data, size);
      default:
        return ONI_STATUS_NOT_SUPPORTED;
    }
  }
  OniStatus setProperty(int id, const void* data, int size) override {
    if (id == ONI_STREAM_PROPERTY_MIRRORING) return ONI_STATUS_OK;
    if (id != ONI_STREAM_PROPERTY_VIDEO_MODE || size != sizeof mode_) {
      return ONI_STATUS_NOT_SUPPORTED;
    }
    std::memcpy(&mode_, data, sizeof mode_);
    return ONI_STATUS_OK;
  }

 private:
  int stride() const { return mode_.resolutionX * (type_ == ONI_SENSOR_DEPTH ? 2 : 3); }

  void serve() {
    const auto period = std::chrono::microseconds(1'000'000 / mode_.fps);
    while (is_running_) {
      const auto index = (Clock::now() - epoch_) / period + 1;
      std::this_thread::sleep_until(epoch_ + index * period);
      if (control_is("stall") || control_is("unplug")) continue;
      if (type_ == ONI_SENSOR_DEPTH && control_is("stall-depth")) continue;
      raise(static_cast<int>(index), static_cast<std::uint64_t>(index * period.count()));
    }
  }

  void raise(int index, std::uint64_t timestamp) {
    OniFrame* frame = getServices().acquireFrame();
    if (!frame) return;
    fill(index, frame->data);
    frame->frameIndex = index;
    frame->timestamp = timestamp;
    frame->videoMode = mode_;
    frame->sensorType = type_;
    frame->width = mode_.resolutionX;
    frame->height = mode_.resolutionY;
    frame->stride = stride();
    frame->croppingEnabled = FALSE;
    frame->cropOriginX = frame->cropOriginY = 0;
    frame->dataSize = stride() * mode_.resolutionY / (control_is("tear") ? 2 : 1);
    raiseNewFrame(frame);
    getServices().releaseFrame(frame);
  }

  void fill(int index, void* data) {
    const int turn = index % (2 * images_);
    const int image = turn < images_ ? turn : 2 * images_ - 1 - turn;
    std::vector<std::uint16_t> depth(kPixels);
    file_.seekg(static_cast<std::streamoff>(image) * 2 * kPixels);
    file_.read(reinterpret_cast<char*>(depth.data()), 2 * kPixels);
    const int step = kWidth / mode_.resolutionX;
    const int unit = mode_.pixelFormat == ONI_PIXEL_FORMAT_DEPTH_100_UM ? 10 : 1;
    auto* readings = static_cast<std::uint16_t*>(data);
    auto* rgb = static_cast<std::uint8_t*>(data);
    for (int v = 0; v < kHeight; v += step) {
      for (int u = 0; u < kWidth; u += step) {
        const std::uint16_t millimetres = depth[static_cast<std::size_t>(v * kWidth + u)];
        if (type_ == ONI_SENSOR_DEPTH) {
          *readings++ = static_cast<std::uint16_t>(unit * millimetres);
        } else {
          std::memset(rgb, millimetres / 32, 3);
          rgb += 3;
        }
      }
    }
  }

  OniVideoMode mode_;
  OniSensorType type_;
  Clock::time_point epoch_;
  std::ifstream file_;
  int images_ = 0;
  std::atomic<bool> is_running_{false};
  std::thread thread_;
};

// One process at a time has it.
class Device : public oni::driver::DeviceBase {
 public:
  explicit Device(int lock) : lock_(lock) {}
  ~Device() override { close(lock_); }

  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) override {
    *sensors = sensors_;
    *count = 2;
    return ONI_STATUS_OK;
  }
  oni::driver::StreamBase* createStream(OniSensorType type) override {
    return new Stream(type, epoch_);
  }
  void destroyStream(oni::driver::StreamBase* stream) override { delete stream; }

  OniBool isPropertySupported(int id) override {
    return id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION ? TRUE : FALSE;
  }
  OniStatus getProperty(int id, void* data, int* size) override {
    if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION) return ONI_STATUS_NOT_SUPPORTED;
    return give(registration_, data, size);
  }
  OniStatus setProperty(int id, const void* data, int size) override {
    if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION || size != sizeof registration_) {
      return ONI_STATUS_NOT_SUPPORTED;
    }
    std::memcpy(&registration_, data, sizeof registration_);
    return ONI_STATUS_OK;
  }
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode) override { return TRUE; }

 private:
  int lock_;
  Clock::time_point epoch_ = Clock::now();
  OniImageRegistrationMode registration_ = ONI_IMAGE_REGISTRATION_OFF;
  OniVideoMode depth_[kModes] = {mode_of(ONI_SENSOR_DEPTH, 0), mode_of(ONI_SENSOR_DEPTH, 1)};
  OniVideoMode color_[kModes] = {mode_of(ONI_SENSOR_COLOR, 0), mode_of(ONI_SENSOR_COLOR, 1)};
  OniSensorInfo sensors_[2] = {{ONI_SENSOR_DEPTH, kModes, depth_},
                               {ONI_SENSOR_COLOR, kModes, color_}};
};

class Driver : public oni::driver::DriverBase {
 public:
  explicit Driver(OniDriverServices* services) : DriverBase(services) {
    std::strcpy(info_.uri, kUri);
    std::strcpy(info_.vendor, "geomap");
    std::strcpy(info_.name, "virtual camera");
  }

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback changed, void* cookie) override {
    DriverBase::initialize(connected, disconnected, changed, cookie);
    if (control_is("unplug")) return ONI_STATUS_OK;
    deviceConnected(&info_);
    is_running_ = true;
    watcher_ = std::thread([this] { watch(); });
    return ONI_STATUS_OK;
  }

  oni::driver::DeviceBase* deviceOpen(const char*, const char*) override {
    while (control_is("hang")) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const int lock = open((folder() + "/lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
    if (flock(lock, LOCK_EX | LOCK_NB) == 0) return new Device(lock);
    getServices().errorLoggerAppend("another process has the camera");
    close(lock);
    return nullptr;
  }
  void deviceClose(oni::driver::DeviceBase* device) override { delete device; }

  void shutdown() override {
    is_running_ = false;
    if (watcher_.joinable()) watcher_.join();
  }

  void* enableFrameSync(oni::driver::StreamBase**, int) override { return this; }

 private:
  void watch() {
    while (is_running_ && !control_is("unplug")) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    if (is_running_) deviceDisconnected(&info_);
  }

  OniDeviceInfo info_{};
  std::atomic<bool> is_running_{false};
  std::thread watcher_;
};

}  // namespace

ONI_EXPORT_DRIVER(Driver)
