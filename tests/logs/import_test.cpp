// SPDX-License-Identifier: BSD-3-Clause
#include "logs/import.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "drivers/seven_scenes_source.hpp"
#include "logs/import_fixture.hpp"

namespace geomap::logs {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class Import : public ImportTest {};

TEST_F(Import, EveryFrameComesBackFromTheLog) {
  const ImportedLog log = imported({});
  ASSERT_EQ(log.frames.size(), static_cast<std::size_t>(kFrames));
  drivers::SevenScenesSource source(folder_.path());
  for (std::size_t i = 0; i < log.frames.size(); ++i) {
    const auto expected = source.next();
    EXPECT_EQ(log.frames[i].utime, drivers::seven_scenes_utime(static_cast<std::int64_t>(i)));
    EXPECT_EQ(log.frames[i].sequence, static_cast<std::int64_t>(i));
    EXPECT_EQ(log.frames[i].sensor, "7-Scenes");
    EXPECT_EQ(log.frames[i].depth.millimetres, expected->frame.depth.millimetres);
    EXPECT_EQ(log.frames[i].depth_camera, expected->frame.depth_camera);
    EXPECT_EQ(log.frames[i].color_camera, expected->frame.color_camera);
    EXPECT_EQ(log.color_bytes[i], expected->jpeg);
  }
}

TEST_F(Import, ColorThatIsNoJpegIsEncodedOnTheWay) {
  std::filesystem::remove(file(1, ".color.jpg"));
  const geometry::ColorImage color = testing::some_color(1);
  testing::write_color_png(file(1, ".color.png"), color);
  const ImportedLog log = imported({});
  const geometry::ColorImage& read = log.frames[1].color;
  ASSERT_EQ(read.rgb.size(), color.rgb.size());
  double error = 0.0;
  for (std::size_t i = 0; i < read.rgb.size(); ++i) error += std::abs(read.rgb[i] - color.rgb[i]);
  EXPECT_LT(error / static_cast<double>(read.rgb.size()), 3.0);
}

TEST_F(Import, TheSummaryCountsFramesTimePathAndBytes) {
  const ImportSummary summary = import_with({});
  EXPECT_EQ(summary.frames, 5U);
  EXPECT_NEAR(summary.duration, 4.0 / 30.0, 1e-6);
  EXPECT_NEAR(summary.path_length, 4.0 * std::hypot(0.1, 0.01), 1e-9);
  EXPECT_EQ(summary.log_bytes, std::filesystem::file_size(out_));
  EXPECT_LE(summary.median_message, summary.largest_message);
  EXPECT_LT(summary.largest_message * 5, summary.log_bytes);
  EXPECT_THAT(to_string(summary), AllOf(HasSubstr("5 frames, 0.13 s"), HasSubstr("path 0.40 m"),
                                        HasSubstr("prior: truth")));
}

TEST_F(Import, TheSameFolderGivesTheSameBytes) {
  import_with({});
  const auto once = testing::file_bytes(out_);
  import_with({});
  EXPECT_EQ(testing::file_bytes(out_), once);
}

TEST_F(Import, AStopLeavesNeitherALogNorAPart) {
  testing::write_text(out_, "an older log");
  drivers::SevenScenesSource source(folder_.path());
  const ImportSummary summary =
      import_frames(source, {}, out_.string(), [](std::size_t done) { return done < 3; });
  EXPECT_TRUE(summary.stopped);
  EXPECT_EQ(summary.frames, 3U);
  EXPECT_FALSE(std::filesystem::exists(out_.string() + ".part"));
  EXPECT_EQ(testing::file_bytes(out_).size(), 12U);
}

TEST_F(Import, AnUnreadableFrameEndsTheImportWithItsName) {
  const auto depth = testing::file_bytes(file(2, ".depth.png"));
  testing::write_bytes(file(2, ".depth.png"), {depth.begin(), depth.end() - 20});
  EXPECT_THAT([&] { import_with({}); },
              ThrowsMessage<drivers::SourceError>(HasSubstr("frame-000002.depth.png")));
  EXPECT_FALSE(std::filesystem::exists(out_));
  EXPECT_FALSE(std::filesystem::exists(out_.string() + ".part"));
}

TEST_F(Import, UnreadableFramesCanBeSkippedAndAreCounted) {
  std::filesystem::remove(file(1, ".depth.png"));
  auto jpeg = testing::file_bytes(file(3, ".color.jpg"));
  const std::vector<std::uint8_t> huffman_table = {0xff, 0xc4};
  const auto table =
      std::search(jpeg.begin(), jpeg.end(), huffman_table.begin(), huffman_table.end());
  std::fill(table + 5, table + 21, std::uint8_t{0xff});  // more codes than bits can tell apart
  testing::write_bytes(file(3, ".color.jpg"), jpeg);
  ImportSettings settings;
  settings.skip_bad = true;
  const ImportSummary summary = import_with(settings);
  EXPECT_EQ(summary.frames, 3U);
  EXPECT_EQ(summary.frames_bad, 2U);
  EXPECT_THAT(to_string(summary), HasSubstr("frame-000001.depth.png: no such file"));
  const ImportedLog log = read_log(out_);
  ASSERT_EQ(log.frames.size(), 3U);
  EXPECT_EQ(log.frames.back().sequence, 2);
  EXPECT_EQ(log.frames.back().utime, drivers::seven_scenes_utime(4));
}

TEST_F(Import, WhenNoFrameIsLeftThereIsNoLog) {
  for (int i = 0; i < kFrames; ++i) testing::write_text(file(i, ".depth.png"), "nothing");
  ImportSettings settings;
  settings.skip_bad = true;
  EXPECT_THAT([&] { import_with(settings); },
              ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("no frame to import"), HasSubstr("frame-000000.depth.png"))));
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(Import, RefusesAFolderAsLogAndAnUpWithoutDirection) {
  ImportSettings settings;
  settings.up = Eigen::Vector3d::Zero();
  EXPECT_THROW(import_with(settings), std::invalid_argument);
  std::filesystem::create_directory(out_);
  EXPECT_THAT([&] { import_with({}); },
              ThrowsMessage<std::runtime_error>(HasSubstr("is no regular file")));
}

}  // namespace
}  // namespace geomap::logs
