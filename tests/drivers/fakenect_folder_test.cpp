// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/fakenect_folder.hpp"

#include <gtest/gtest.h>

#include <iterator>
#include <stdexcept>

#include "drivers/data_set_writer.hpp"
#include "drivers/frame_source.hpp"

namespace geomap::drivers {
namespace {

class FakenectFolderTest : public ::testing::Test {
 protected:
  static geometry::RgbdFrame frame() {
    geometry::RgbdFrame frame;
    frame.depth = {640, 480, std::vector<std::uint16_t>(640 * 480, 1194)};
    frame.color = {640, 480, std::vector<std::uint8_t>(3 * 640 * 480, 7)};
    return frame;
  }
  std::filesystem::path path() const { return folder_.path() / "kinect"; }
  std::string content(const std::string& name) const {
    std::ifstream file(path() / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

 private:
  testing::TemporaryFolder folder_;
};

TEST_F(FakenectFolderTest, FilesAreNamedByKindTimeAndTicks) {
  FakenectFolder folder(path());
  folder.add(frame(), 71'600'000, {0.0, -1.0, 0.0});  // the ticks have begun anew
  EXPECT_EQ(content("INDEX.txt"),
            "a-71.600000-1032704.dump\nd-71.600000-1032704.pgm\nr-71.600000-1032704.ppm\n");
}

TEST_F(FakenectFolderTest, DepthIsDisparitiesAndColourIsAsItWas) {
  FakenectFolder folder(path());
  folder.add(frame(), 0, {0.0, -1.0, 0.0});
  const std::string depth = content("d-0.000000-0.pgm"), color = content("r-0.000000-0.ppm");
  const std::string depth_head = "P5 640 480 65535\n", color_head = "P6 640 480 255\n";
  ASSERT_EQ(depth.size(), depth_head.size() + 2 * 640 * 480);
  EXPECT_EQ(depth.substr(0, depth_head.size()), depth_head);
  EXPECT_EQ(depth.substr(depth.size() - 2), "\x20\x03");  // 800
  ASSERT_EQ(color.size(), color_head.size() + 3 * 640 * 480);
  EXPECT_EQ(color.substr(0, color_head.size()), color_head);
  EXPECT_EQ(color.back(), 7);
}

TEST_F(FakenectFolderTest, TheAccelerometerOfACameraThatIsHeldUprightCounts819Upwards) {
  FakenectFolder folder(path());
  folder.add(frame(), 0, {0.0, -1.0, 0.0});
  EXPECT_EQ(content("a-0.000000-0.dump"), std::string("\0\0\x33\x03\0\0\0\0\0\0\0\0", 12));
}

TEST_F(FakenectFolderTest, ARecordingIsNotOverwritten) {
  FakenectFolder first(path());
  EXPECT_THROW(FakenectFolder{path()}, SourceError);
}

TEST_F(FakenectFolderTest, AnotherSizeIsRefused) {
  FakenectFolder folder(path());
  geometry::RgbdFrame small = frame();
  small.depth = {320, 240, std::vector<std::uint16_t>(320 * 240, 1000)};
  EXPECT_THROW(folder.add(small, 0, {0.0, -1.0, 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace geomap::drivers
