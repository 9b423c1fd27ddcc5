// SPDX-License-Identifier: BSD-3-Clause
// A noise-free living room whose planes are labelled per pixel.
#include <fstream>
#include <iostream>
#include <map>

#include "drivers/image_file.hpp"
#include "perception/outline_image.hpp"
#include "perception/ransac_extractor.hpp"
#include "support/recordings.hpp"

namespace geomap::perception {
namespace {

using testing::common_pixels;
using testing::count_pixels;

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr std::size_t kLeastPixels = 5000;

// Labels per pixel, empty unless the file is what it should be.
std::vector<std::uint8_t> read_labels(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string magic;
  int width = 0, height = 0, largest = 0;
  file >> magic >> width >> height >> largest;
  file.get();
  if (magic != "P5" || width != kWidth || height != kHeight) return {};
  std::vector<std::uint8_t> labels(static_cast<std::size_t>(width * height));
  file.read(reinterpret_cast<char*>(labels.data()), static_cast<std::streamsize>(labels.size()));
  return file ? labels : std::vector<std::uint8_t>{};
}

// Coplanar labels are one plane: {1, 16} and {8, 9, 17}.
int plane_of_label(int label) {
  const std::map<int, int> first = {{16, 1}, {9, 8}, {17, 8}};
  const auto found = first.find(label);
  return found == first.end() ? label : found->second;
}

std::map<int, std::vector<bool>> large_planes(const std::vector<std::uint8_t>& labels) {
  std::map<int, std::vector<bool>> planes;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == 0) continue;
    auto& image = planes[plane_of_label(labels[i])];
    image.resize(labels.size());
    image[i] = true;
  }
  std::erase_if(planes,
                [](const auto& entry) { return count_pixels(entry.second) < kLeastPixels; });
  return planes;
}

// Per labelled plane, the joint outline of the planes that lie mostly on it: the cushions are
// curved by millimetres, and may come as several planes.
std::map<int, std::vector<bool>> outlines_by_label(
    const std::vector<geometry::PlaneObservation>& planes, const geometry::CameraModel& camera,
    const std::map<int, std::vector<bool>>& truth) {
  std::map<int, std::vector<bool>> joint;
  for (const auto& plane : planes) {
    const std::vector<bool> outline = testing::outline_image(plane.surface, camera);
    for (const auto& [label, image] : truth) {
      if (2 * common_pixels(outline, image) < count_pixels(outline)) continue;
      auto& pixels = joint[label];
      pixels.resize(outline.size());
      for (std::size_t i = 0; i < outline.size(); ++i) pixels[i] = pixels[i] || outline[i];
    }
  }
  return joint;
}

TEST(IclLabelled, EveryLargeLabelledPlaneIsFoundWithItsOutline) {
  GEOMAP_REQUIRE_RECORDING(folder, "icl_labelled");
  geometry::RgbdFrame frame;
  frame.depth = drivers::read_depth_png(folder / "depth.png", 5000);  // rounded to millimetres
  frame.depth_camera = {kWidth, kHeight, 481.2, 480.0, 319.5, 239.5};
  const std::vector<std::uint8_t> labels = read_labels(folder / "labels.pgm");
  ASSERT_FALSE(labels.empty());
  const auto truth = large_planes(labels);
  ASSERT_EQ(truth.size(), 7u);

  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto planes = RansacExtractor().extract(frame, seed, std::nullopt).planes;
    const auto found = outlines_by_label(planes, frame.depth_camera, truth);
    for (const auto& [label, image] : truth) {
      ASSERT_TRUE(found.count(label)) << "label " << label << " has no plane";
      const double ratio = testing::overlap_ratio(found.at(label), image);
      const bool is_cushion = count_pixels(image) < 20000;  // bulging by up to 8 mm
      EXPECT_GT(ratio, is_cushion ? 0.75 : 0.93) << "label " << label << ", seed " << seed;
      if (seed == 1) std::cout << "label " << label << ": IoU " << ratio << "\n";
    }
  }
}

}  // namespace
}  // namespace geomap::perception
