// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/studio.hpp"

#include <epoxy/gl.h>

#include <cstdlib>
#include <filesystem>

#include "viewer/png_file.hpp"

namespace geomap::testing {
namespace {

namespace fs = std::filesystem;
using viewer::Image;

constexpr int kWidth = 320, kHeight = 200;
constexpr int kVisibleStep = 24;  // of 255, in one channel
constexpr double kMostMean = 2.0;
constexpr double kMostShare = 0.02;

// One context for all tests of the program; the reason where there is none.
struct Context {
  Context() {
    try {
      context.emplace();
    } catch (const std::exception& error) {
      reason = error.what();
    }
  }
  std::optional<viewer::OffscreenContext> context;
  std::string reason;
};

Context& shared_context() {
  static Context context;
  return context;
}

int step_between(const Image& a, const Image& b, std::size_t pixel) {
  int largest = 0;
  for (std::size_t c = 3 * pixel; c < 3 * pixel + 3; ++c) {
    largest = std::max(largest, std::abs(a.rgb[c] - b.rgb[c]));
  }
  return largest;
}

bool is_drawn(const Image& image, std::size_t pixel, const viewer::Rgba& background) {
  for (std::size_t c = 0; c < 3; ++c) {
    const double off = image.rgb[3 * pixel + c] - 255.0 * static_cast<double>(background[c]);
    if (std::abs(off) > 1.5) return true;
  }
  return false;
}

Image difference_image(const Image& a, const Image& b) {
  Image image = a;
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    image.rgb[i] = static_cast<std::uint8_t>(std::min(255, 4 * std::abs(a.rgb[i] - b.rgb[i])));
  }
  return image;
}

fs::path golden_file(const std::string& name) {
  return fs::path(GEOMAP_SOURCE_DIR) / "tests/viewer/golden" / (name + ".png");
}

}  // namespace

void Studio::SetUp() {
  if (!shared_context().context) GTEST_SKIP() << shared_context().reason;
  framebuffer_.emplace(kWidth, kHeight);
  painter_ = std::make_shared<viewer::Painter>();
  renderers_ = viewer::make_renderers(painter_);
}

void Studio::TearDown() {
  if (!shared_context().context) return;
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

viewer::Renderer& Studio::renderer(const std::string& name) {
  for (const auto& renderer : renderers_) {
    if (renderer->name() == name) return *renderer;
  }
  throw std::invalid_argument("no renderer is called " + name);
}

viewer::Renderer& Studio::only(const std::string& name) {
  for (const auto& renderer : renderers_) renderer->enabled = false;
  renderer(name).enabled = true;
  return renderer(name);
}

Image Studio::draw(const viewer::SceneModel& scene, const viewer::ViewCamera& camera,
                   const viewer::Selection& selection) {
  framebuffer_->begin(theme_.background);
  failures_ = viewer::draw_all(renderers_, {.scene = scene,
                                            .camera = camera,
                                            .selection = selection,
                                            .theme = theme_,
                                            .scale = 1.0F,
                                            .point_budget = point_budget_});
  return framebuffer_->read();
}

ImageDifference difference(const Image& a, const Image& b, const viewer::Rgba& background) {
  if (a.width != b.width || a.height != b.height) return {.mean = 255.0, .share = 1.0};
  double sum = 0.0;
  std::size_t drawn = 0, differ = 0;
  for (std::size_t pixel = 0; pixel < a.rgb.size() / 3; ++pixel) {
    if (!is_drawn(a, pixel, background) && !is_drawn(b, pixel, background)) continue;
    ++drawn;
    if (step_between(a, b, pixel) > kVisibleStep) ++differ;
    for (std::size_t c = 3 * pixel; c < 3 * pixel + 3; ++c) sum += std::abs(a.rgb[c] - b.rgb[c]);
  }
  if (drawn == 0) return {};
  const auto pixels = static_cast<double>(drawn);
  return {.mean = sum / (3.0 * pixels), .share = static_cast<double>(differ) / pixels};
}

bool looks_alike(const ImageDifference& difference) {
  return difference.mean <= kMostMean && difference.share <= kMostShare;
}

ImageDifference difference_from_golden(const std::string& name, const Image& image,
                                       const viewer::Rgba& background) {
  return difference(image, viewer::read_png(golden_file(name)), background);
}

::testing::AssertionResult is_golden(const std::string& name, const Image& image,
                                     const viewer::Rgba& background) {
  const fs::path golden = golden_file(name);
  const char* update = std::getenv("GEOMAP_UPDATE_GOLDEN");
  if (update != nullptr && std::string(update) == "1") viewer::write_png(golden, image);
  if (!fs::exists(golden)) return ::testing::AssertionFailure() << golden << " is missing";
  const Image expected = viewer::read_png(golden);
  const ImageDifference found = difference(image, expected, background);
  if (looks_alike(found)) return ::testing::AssertionSuccess();
  const fs::path drawn = fs::absolute(name + ".drawn.png");
  viewer::write_png(drawn, image);
  auto failure = ::testing::AssertionFailure()
                 << golden << ": mean difference " << found.mean << ", visible in "
                 << 100.0 * found.share << " % of the drawn pixels; drawn: " << drawn;
  if (expected.rgb.size() != image.rgb.size()) return failure;
  const fs::path apart = fs::absolute(name + ".difference.png");
  viewer::write_png(apart, difference_image(image, expected));
  return failure << "; difference: " << apart;
}

}  // namespace geomap::testing
