// SPDX-License-Identifier: BSD-3-Clause
// frame_compression: processor time and size of RGBD_FRAME's parts, on the recorded kitchen.
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "drivers/seven_scenes_source.hpp"
#include "messaging/convert_frame.hpp"
#include "messaging/depth_codec.hpp"
#include "messaging/jpeg.hpp"
#include "statistics.hpp"

namespace {

struct Part {
  const char* name;
  std::vector<double> milliseconds, bytes;

  template <class Code>
  void measure(Code&& code) {
    milliseconds.push_back(
        geomap::bench::milliseconds([&] { bytes.push_back(static_cast<double>(code())); }));
  }
  void print() const {
    std::printf("%-6s %7.2f ms (p95 %.2f) %8.0f bytes\n", name, geomap::bench::median(milliseconds),
                geomap::bench::quantile(milliseconds, 0.95), geomap::bench::median(bytes));
  }
};

}  // namespace

int main() {
  using namespace geomap;
  const char* root = std::getenv("GEOMAP_DATA");
  if (root == nullptr) {
    std::fprintf(stderr, "frame_compression: GEOMAP_DATA must name the folder with redkitchen\n");
    return 1;
  }
  drivers::SevenScenesSource source(std::filesystem::path(root) / "redkitchen", {});
  Part depth{"depth", {}, {}}, color{"color", {}, {}}, whole{"frame", {}, {}};
  while (auto entry = source.next()) {
    geometry::RgbdFrame& frame = entry->frame;
    if (!entry->jpeg.empty()) frame.color = messaging::decode_jpeg(entry->jpeg).value();
    depth.measure([&] { return messaging::compress_depth(frame.depth.millimetres).size(); });
    color.measure([&] { return messaging::encode_jpeg(frame.color).size(); });
    whole.measure([&] {
      const auto message = messaging::to_message(frame);
      return message.depth.data.size() + message.color.data.size();
    });
  }
  for (const Part* part : {&depth, &color, &whole}) part->print();
  return 0;
}
