// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <string>

#include "drivers/frame_source.hpp"
#include "drivers/image_file.hpp"
#include "drivers/input_file.hpp"

namespace geomap::drivers {
namespace {

using std::filesystem::path;

// Markers of ITU-T T.81, table B.1.
constexpr std::uint8_t kStartOfImage = 0xd8;
constexpr std::uint8_t kEndOfImage = 0xd9;
constexpr std::uint8_t kStartOfScan = 0xda;

bool is_frame_header(std::uint8_t marker) {  // SOF0-SOF15 without DHT, JPG and DAC among them
  return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

[[noreturn]] void refuse(const path& file, const std::string& why) {
  throw SourceError(file.string() + ": not a usable JPEG image: " + why);
}

int two_bytes(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  return bytes[at] << 8 | bytes[at + 1];
}

// Inside a scan 0xff is always followed by 0 or a marker: the first end marker is the real one.
bool ends_after(const std::vector<std::uint8_t>& bytes, std::size_t scan) {
  constexpr std::array<std::uint8_t, 2> kEnd = {0xff, kEndOfImage};
  const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(scan);
  return std::search(begin, bytes.end(), kEnd.begin(), kEnd.end()) != bytes.end();
}

}  // namespace

JpegFile read_jpeg(const path& file) {
  JpegFile jpeg{read_bytes(file), 0, 0};
  const std::vector<std::uint8_t>& bytes = jpeg.bytes;
  if (bytes.size() < 4 || bytes[0] != 0xff || bytes[1] != kStartOfImage) {
    refuse(file, "it does not start like one");
  }
  std::size_t at = 2;
  while (true) {
    while (at + 1 < bytes.size() && bytes[at] == 0xff && bytes[at + 1] == 0xff) ++at;  // fill bytes
    if (at + 4 > bytes.size()) refuse(file, "it ends too early");
    if (bytes[at] != 0xff) refuse(file, "a marker is missing");
    const std::uint8_t marker = bytes[at + 1];
    const auto length = static_cast<std::size_t>(two_bytes(bytes, at + 2));
    if (length < 2 || at + 2 + length > bytes.size()) refuse(file, "it ends too early");
    if (is_frame_header(marker)) {
      if (length < 8) refuse(file, "its frame header is too short");
      jpeg.height = two_bytes(bytes, at + 5);
      jpeg.width = two_bytes(bytes, at + 7);
    }
    at += 2 + length;
    if (marker == kStartOfScan) break;
  }
  if (jpeg.width < 1 || jpeg.height < 1) refuse(file, "it has no size");
  if (std::max(jpeg.width, jpeg.height) > kMaxImageSide) {
    refuse(file,
           std::to_string(jpeg.width) + " x " + std::to_string(jpeg.height) + " is too large");
  }
  if (!ends_after(bytes, at)) refuse(file, "it ends too early");
  return jpeg;
}

}  // namespace geomap::drivers
