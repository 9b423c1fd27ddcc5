// SPDX-License-Identifier: BSD-3-Clause
// An OpenNI2 driver with one camera that is not there. It serves the depth images of the file
// `depth.raw` (640x480, 16 bits, mm) in the folder $GEOMAP_VIRTUAL_CAMERA, forwards and backwards,
// at 30 a second, with their shading as colour. The file `control` beside it holds what the camera
// does: run, stall, tear (half the bytes are missing), unplug.
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

OniVideoMode mode_of(OniSensorType type) {
  return {type == ONI_SENSOR_DEPTH ? ONI_PIXEL_FORMAT_DEPTH_1_MM : ONI_PIXEL_FORMAT_RGB888, kWidth,
          kHeight, kRate};
}

class Stream : public oni::driver::StreamBase {
 public:
  Stream(OniSensorType type, Clock::time_point epoch)
      : mode_(mode_of(type)),
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
        return give(OniCropping{FALSE, 0, 0, kWidth, kHeight}, data, size);
      case ONI_STREAM_PROPERTY_MIRRORING:
        return give<OniBool>(FALSE, data, size);
      default:
        return ONI_STATUS_NOT_SUPPORTED;
    }
  }
  OniStatus setProperty(int id, const void*, int) override {
    const bool is_known =
        id == ONI_STREAM_PROPERTY_VIDEO_MODE || id == ONI_STREAM_PROPERTY_MIRRORING;
    return is_known ? ONI_STATUS_OK : ONI_STATUS_NOT_SUPPORTED;
  }

 private:
  int stride() const { return kWidth * (type_ == ONI_SENSOR_DEPTH ? 2 : 3); }

  void serve() {
    const auto period = std::chrono::microseconds(1'000'000 / kRate);
    while (is_running_) {
      const auto index = (Clock::now() - epoch_) / period + 1;
      std::this_thread::sleep_until(epoch_ + index * period);
      if (control_is("stall") || control_is("unplug")) continue;
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
    frame->width = kWidth;
    frame->height = kHeight;
    frame->stride = stride();
    frame->croppingEnabled = FALSE;
    frame->cropOriginX = frame->cropOriginY = 0;
    frame->dataSize = stride() * kHeight / (control_is("tear") ? 2 : 1);
    raiseNewFrame(frame);
    getServices().releaseFrame(frame);
  }

  void fill(int index, void* data) {
    const int turn = index % (2 * images_);
    const int image = turn < images_ ? turn : 2 * images_ - 1 - turn;
    std::vector<std::uint16_t> depth(kPixels);
    file_.seekg(static_cast<std::streamoff>(image) * 2 * kPixels);
    file_.read(reinterpret_cast<char*>(depth.data()), 2 * kPixels);
    if (type_ == ONI_SENSOR_DEPTH) {
      std::memcpy(data, depth.data(), 2 * kPixels);
      return;
    }
    auto* rgb = static_cast<std::uint8_t*>(data);
    for (const std::uint16_t millimetres : depth) {
      for (int channel = 0; channel < 3; ++channel) {
        *rgb++ = static_cast<std::uint8_t>(millimetres / 32);
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
  OniVideoMode depth_ = mode_of(ONI_SENSOR_DEPTH), color_ = mode_of(ONI_SENSOR_COLOR);
  OniSensorInfo sensors_[2] = {{ONI_SENSOR_DEPTH, 1, &depth_}, {ONI_SENSOR_COLOR, 1, &color_}};
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
