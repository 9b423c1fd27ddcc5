// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "viewer/gl_program.hpp"
#include "viewer/png_file.hpp"
#include "viewer/studio.hpp"

namespace geomap::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using viewer::Image;

// A folder of its own for each test.
class PngFile : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  static std::string message_of(const std::function<void()>& action) {
    try {
      action();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "nothing was thrown";
  }
  fs::path folder_ = fs::path(::testing::TempDir()) /
                     (std::string("geomap_png_") +
                      ::testing::UnitTest::GetInstance()->current_test_info()->name());
  Image image_{.width = 3,
               .height = 2,
               .rgb = {1, 2, 3, 250, 0, 9, 77, 78, 79, 10, 11, 12, 13, 0, 0, 0, 0, 255}};
};

TEST_F(PngFile, APictureIsReadAsItWasWritten) {
  viewer::write_png(folder_ / "a.png", image_);
  EXPECT_EQ(viewer::read_png(folder_ / "a.png"), image_);
}

TEST_F(PngFile, NothingButThePictureIsLeftInTheFolder) {
  viewer::write_png(folder_ / "a.png", image_);
  viewer::write_png(folder_ / "a.png", image_);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(PngFile, AFolderThatIsMissingIsNamed) {
  const fs::path path = folder_ / "nowhere" / "a.png";
  EXPECT_THAT(message_of([&] { viewer::write_png(path, image_); }), HasSubstr(path.string()));
  EXPECT_THAT(message_of([&] { viewer::read_png(path); }), HasSubstr(path.string()));
}

TEST_F(PngFile, WhatIsNotAPictureIsRefused) {
  std::ofstream(folder_ / "text.png") << "no picture at all";
  EXPECT_THAT(message_of([&] { viewer::read_png(folder_ / "text.png"); }),
              AllOf(HasSubstr("text.png"), HasSubstr("cannot be read")));
}

TEST_F(PngFile, APictureWithTooFewPixelsIsACallersMistake) {
  image_.rgb.pop_back();
  EXPECT_THROW(viewer::write_png(folder_ / "a.png", image_), std::invalid_argument);
  EXPECT_FALSE(fs::exists(folder_ / "a.png"));
}

class Picture : public Studio {};

TEST_F(Picture, AFramebufferTakesItsBackgroundAndANewSize) {
  viewer::Framebuffer framebuffer(4, 3);
  framebuffer.begin({1.0F, 0.0F, 0.2F, 1.0F});
  const Image image = framebuffer.read();
  EXPECT_EQ(image.rgb.size(), 36U);
  EXPECT_EQ((std::vector<int>{image.rgb[33], image.rgb[34], image.rgb[35]}),
            (std::vector<int>{255, 0, 51}));
  framebuffer.resize(7, 5);
  framebuffer.begin({});
  EXPECT_EQ(framebuffer.read().rgb, std::vector<std::uint8_t>(105, 0));
}

TEST_F(Picture, AShaderThatDoesNotCompileIsNamedWithItsFault) {
  try {
    const viewer::GlProgram program("broken", {"#version 330 core\nvoid main() { nonsense; }", "",
                                               "#version 330 core\nvoid main() {}"});
    FAIL() << "a broken shader was taken";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("vertex"), HasSubstr("'broken'"), HasSubstr("nonsense")));
  }
}

TEST_F(Picture, AValueThatAShaderDoesNotHaveIsAMistake) {
  const viewer::GlProgram program("plain",
                                  {"#version 330 core\nvoid main() { gl_Position = vec4(0); }", "",
                                   "#version 330 core\nout vec4 c;\nvoid main() { c = vec4(1); }"});
  program.use();
  EXPECT_THROW(program.set("colour", 1.0), std::logic_error);
}

}  // namespace
}  // namespace geomap::testing
