// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/openni2_stream.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "drivers/frame_source.hpp"

namespace geomap::drivers {
namespace {

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

}  // namespace

void check_openni(openni::Status status, const std::string& action) {
  if (status == openni::STATUS_OK) return;
  std::string reason = openni::OpenNI::getExtendedError();
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  reason.erase(0, reason.find_first_not_of(" \t"));
  reason.erase(reason.find_last_not_of(" \t") + 1);
  throw SourceError(action + ": " + (reason.empty() ? "OpenNI2 gives no reason" : reason));
}

OpenNi2Library::OpenNi2Library() {
  check_openni(openni::OpenNI::initialize(), "cannot start OpenNI2");
}
OpenNi2Library::~OpenNi2Library() { openni::OpenNI::shutdown(); }

OpenNi2Stream::OpenNi2Stream(const openni::Device& device, openni::SensorType type) : type_(type) {
  check_openni(stream_.create(device, type), type == openni::SENSOR_DEPTH
                                                 ? "the camera has no depth"
                                                 : "the camera has no colour");
}

geometry::CameraModel OpenNi2Stream::camera() const {
  const openni::VideoMode mode = stream_.getVideoMode();
  const int width = mode.getResolutionX(), height = mode.getResolutionY();
  return {width,
          height,
          0.5 * width / std::tan(0.5 * stream_.getHorizontalFieldOfView()),
          0.5 * height / std::tan(0.5 * stream_.getVerticalFieldOfView()),
          0.5 * (width - 1),
          0.5 * (height - 1)};
}

void OpenNi2Stream::start() {
  check_openni(stream_.start(),
               type_ == openni::SENSOR_DEPTH ? "cannot start depth" : "cannot start colour");
}

std::optional<CameraImage> OpenNi2Stream::read() {
  openni::VideoFrameRef frame;
  check_openni(stream_.readFrame(&frame), "cannot read an image");
  const int number = frame.getFrameIndex();
  if (last_number_ > 0) losses_.missed += std::max(0, number - last_number_ - 1);
  last_number_ = number;
  last_time_ = static_cast<std::int64_t>(frame.getTimestamp());
  CameraImage result;
  result.sensor_time = last_time_;
  bool is_whole = false;
  if (type_ == openni::SENSOR_DEPTH) {
    geometry::DepthImage depth = depth_of(frame);
    is_whole = !depth.empty();
    result.image = std::move(depth);
  } else {
    geometry::ColorImage color = color_of(frame);
    is_whole = !color.empty();
    result.image = std::move(color);
  }
  if (is_whole) return result;
  ++losses_.torn;
  return std::nullopt;
}

OpenNi2Stream* wait_for_openni(std::initializer_list<OpenNi2Stream*> streams, int milliseconds) {
  std::vector<openni::VideoStream*> handles;
  for (OpenNi2Stream* stream : streams) handles.push_back(&stream->handle());
  int index = -1;
  const openni::Status status = openni::OpenNI::waitForAnyStream(
      handles.data(), static_cast<int>(handles.size()), &index, milliseconds);
  if (status == openni::STATUS_TIME_OUT) return nullptr;
  check_openni(status, "cannot wait for an image");
  return streams.begin()[index];
}

CameraDescription describe_openni(const openni::Device& device, const OpenNi2Stream& depth,
                                  const OpenNi2Stream& color, bool is_registered) {
  const openni::DeviceInfo& info = device.getDeviceInfo();
  CameraDescription description;
  description.name = fmt::format("{} {} ({})", info.getVendor(), info.getName(), info.getUri());
  description.color = color.camera();
  description.depth = is_registered ? description.color : depth.camera();
  description.is_registered = is_registered;
  if (!description.depth.valid() || !description.color.valid()) {
    throw SourceError(description.name + " does not say its field of view");
  }
  return description;
}

}  // namespace geomap::drivers
