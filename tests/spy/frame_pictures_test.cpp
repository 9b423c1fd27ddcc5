// SPDX-License-Identifier: BSD-3-Clause
// What the viewer in lcm-spy draws, against what C++ decodes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>

#include "drivers/image_file.hpp"
#include "messaging/convert_frame.hpp"
#include "messaging/encode.hpp"
#include "support/plane_renderer.hpp"
#include "support/program_run.hpp"

namespace geomap::testing {
namespace {

namespace fs = std::filesystem;
using geometry::ColorImage;
using geometry::DepthImage;
using ::testing::HasSubstr;

using Color = std::array<int, 3>;

Color color_at(const ColorImage& image, std::size_t pixel) {
  return {image.rgb[3 * pixel], image.rgb[3 * pixel + 1], image.rgb[3 * pixel + 2]};
}

/// Of the channel that differs most.
int difference(const Color& a, const Color& b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

/// Draws all messages in one run of Java.
class FramePictures : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(GEOMAP_SPY_JAR)) GTEST_SKIP() << "no JDK or lcm.jar when this was built";
    folder_ = fs::path(::testing::TempDir()) / "geomap_frame_pictures";
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  void add(const std::string& name, const geomap::rgbd_frame_t& message) {
    const std::vector<std::uint8_t> bytes = messaging::encode(message);
    std::ofstream(folder_ / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    files_ += ' ';
    files_ += (folder_ / name).string();
  }
  ProgramRun draw() {
    return run_program("java -Djava.awt.headless=true -cp " GEOMAP_SPY_JAR " " GEOMAP_SOURCE_DIR
                       "/tests/spy/DrawFrames.java" +
                       files_);
  }
  ColorImage picture(const std::string& name) {
    return drivers::read_color_png(folder_ / (name + ".png"));
  }

  const geometry::RgbdFrame frame_ =
      render(small_room(), kinect_camera(2), look_at({1.0, -1.0, 1.5}, {-1.0, 1.0, 0.5}), 0.01)
          .frame;
  const geomap::rgbd_frame_t message_ = messaging::to_message(frame_);

 private:
  fs::path folder_;
  std::string files_;
};

/// The same frame without compression, rows padded by some bytes.
geomap::rgbd_frame_t plain(geomap::rgbd_frame_t message, const geometry::RgbdFrame& frame) {
  constexpr int kPadding = 6;
  const auto fill = [](bot_core::image_t& image, int row, const auto& byte_at) {
    image.row_stride = row + kPadding;
    image.size = image.row_stride * image.height;
    image.data.assign(static_cast<std::size_t>(image.size), 0xaa);
    for (int v = 0; v < image.height; ++v) {
      for (int i = 0; i < row; ++i) {
        image.data[static_cast<std::size_t>(v * image.row_stride + i)] =
            byte_at(static_cast<std::size_t>(v * row + i));
      }
    }
  };
  message.depth.pixelformat = bot_core::image_t::PIXEL_FORMAT_LE_GRAY16;
  fill(message.depth, 2 * message.depth.width, [&](std::size_t i) {
    return static_cast<std::uint8_t>(frame.depth.millimetres[i / 2] >> (8 * (i % 2)));
  });
  message.color.pixelformat = bot_core::image_t::PIXEL_FORMAT_RGB;
  fill(message.color, 3 * message.color.width, [&](std::size_t i) { return frame.color.rgb[i]; });
  return message;
}

TEST_F(FramePictures, ShowDepthAndColourAsDecodedHere) {
  add("coded", message_);
  add("plain", plain(message_, frame_));
  const ProgramRun run = draw();
  ASSERT_EQ(run.status, 0) << run.text;
  EXPECT_THAT(run.text, HasSubstr("plugin geomap_spy.FramePlugin\n"));

  const auto decoded = messaging::to_frame(message_).frame;
  ASSERT_TRUE(decoded);
  const ColorImage color = picture("coded.color");
  ASSERT_EQ(color.rgb.size(), decoded->color.rgb.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < color.rgb.size(); ++i) {
    sum += std::abs(color.rgb[i] - decoded->color.rgb[i]);
  }
  EXPECT_LT(sum / static_cast<double>(color.rgb.size()), 1.0);  // two decoders of JPEG
  EXPECT_EQ(picture("plain.color").rgb, frame_.color.rgb);
  EXPECT_EQ(picture("plain.depth").rgb, picture("coded.depth").rgb);
}

TEST_F(FramePictures, TellDistancesByColour) {
  add("room", message_);
  // Every depth there is.
  geometry::RgbdFrame ramp = frame_;
  for (std::size_t i = 0; i < ramp.depth.millimetres.size(); ++i) {
    ramp.depth.millimetres[i] = static_cast<std::uint16_t>(i);
  }
  add("ramp", messaging::to_message(ramp));
  ASSERT_EQ(draw().status, 0);
  const ColorImage colors = picture("ramp.depth");
  const auto color_of = [&](std::size_t millimetres) { return color_at(colors, millimetres); };
  EXPECT_EQ(color_of(0), (Color{0, 0, 0}));
  EXPECT_EQ(color_of(65535), (Color{0, 0, 0}));
  EXPECT_EQ(color_of(500), (Color{255, 0, 0}));
  EXPECT_EQ(color_of(2750), (Color{0, 255, 0}));
  EXPECT_EQ(color_of(5000), (Color{0, 0, 255}));
  EXPECT_EQ(color_of(1), color_of(500));
  EXPECT_EQ(color_of(65534), color_of(5000));
  for (std::size_t depth = 501; depth <= 5000; ++depth) {
    EXPECT_LE(difference(color_of(depth), color_of(depth - 1)), 1);
  }
  for (std::size_t depth = 550; depth <= 5000; ++depth) {
    EXPECT_GT(difference(color_of(depth), color_of(depth - 50)), 5) << depth;
  }
  const ColorImage room = picture("room.depth");
  for (std::size_t i = 0; i < frame_.depth.millimetres.size(); ++i) {
    ASSERT_EQ(color_at(room, i), color_of(frame_.depth.millimetres[i]));
  }
}

TEST_F(FramePictures, OfDamagedImagesAreRefusedWithAReason) {
  using Damage = std::function<void(geomap::rgbd_frame_t&)>;
  const std::map<std::string, std::pair<Damage, std::string>> damages = {
      {"cut", {[](auto& m) { m.depth.data.resize(100), m.depth.size = 100; }, "end"}},
      {"short", {[](auto& m) { m.depth.height += 1; }, "ends early"}},
      {"noise", {[](auto& m) { m.depth.data[0] ^= 0xff; }, "incorrect header check"}},
      {"small", {[](auto& m) { m.depth.width = -1; }, "size of -1 x 240"}},
      {"large", {[](auto& m) { m.depth.height = 1 << 30; }, "size of 320 x 1073741824"}},
      {"stride", {[](auto& m) { m.depth.row_stride = 100; }, "rows of 100 bytes"}},
      {"format", {[](auto& m) { m.depth.pixelformat = 1; }, "unknown pixel format 1"}},
      {"jpeg", {[](auto& m) { m.color.data.assign(m.color.data.size(), 1); }, "no JPEG"}},
      {"rgb",
       {[](auto& m) { m.color.pixelformat = bot_core::image_t::PIXEL_FORMAT_RGB; }, "ends early"}},
  };
  for (const auto& [name, damage] : damages) {
    geomap::rgbd_frame_t message = message_;
    damage.first(message);
    add(name, message);
  }
  const ProgramRun run = draw();
  EXPECT_EQ(run.status, 0);
  for (const auto& [name, damage] : damages) {
    EXPECT_THAT(run.text, ::testing::ContainsRegex(name + ": .*" + damage.second));
  }
}

}  // namespace
}  // namespace geomap::testing
