// SPDX-License-Identifier: BSD-3-Clause
// A noise-free living room whose planes are labelled per pixel.
#include <fstream>
#include <map>
#include <set>

#include "drivers/image_file.hpp"
#include "geometry/polygon.hpp"
#include "perception/ransac_extractor.hpp"
#include "support/recordings.hpp"

namespace geomap::perception {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr int kLeastPixels = 5000;

std::vector<std::uint8_t> read_labels(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string magic;
  int width = 0, height = 0, largest = 0;
  file >> magic >> width >> height >> largest;
  file.get();
  std::vector<std::uint8_t> labels(static_cast<std::size_t>(width * height));
  file.read(reinterpret_cast<char*>(labels.data()), static_cast<std::streamsize>(labels.size()));
  return magic == "P5" && width == kWidth && height == kHeight && file ? labels
                                                                       : std::vector<std::uint8_t>{};
}

// Coplanar labels are one plane: {1, 16} and {8, 9, 17}.
int plane_of_label(int label) {
  const std::map<int, int> first = {{16, 1}, {9, 8}, {17, 8}};
  const auto found = first.find(label);
  return found == first.end() ? label : found->second;
}

std::map<int, std::set<int>> pixels_by_plane(const std::vector<std::uint8_t>& labels) {
  std::map<int, std::set<int>> pixels;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] != 0) pixels[plane_of_label(labels[i])].insert(static_cast<int>(i));
  }
  std::erase_if(pixels, [](const auto& entry) { return entry.second.size() < kLeastPixels; });
  return pixels;
}

// The image of an outline: all pixels whose rays meet the polygon.
std::set<int> pixels_inside(const geometry::PlanarPolygon& surface,
                            const geometry::CameraModel& camera) {
  std::set<int> inside;
  const auto box = geometry::bounding_box(surface.polygon);
  const Eigen::Isometry3d T_plane_camera = surface.frame.T_plane_parent();
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const Eigen::Vector3d ray = camera.ray(u, v);
      const double slope = surface.plane.normal.dot(ray);
      if (slope >= -1e-6) continue;
      const Eigen::Vector3d point = -surface.plane.d / slope * ray;
      const Eigen::Vector2d at = (T_plane_camera * point).head<2>();
      if (box.contains(at) && geometry::contains(surface.polygon, at)) inside.insert(v * kWidth + u);
    }
  }
  return inside;
}

std::size_t common(const std::set<int>& a, const std::set<int>& b) {
  return static_cast<std::size_t>(
      std::count_if(a.begin(), a.end(), [&b](int pixel) { return b.count(pixel) > 0; }));
}

TEST(IclLabelled, EveryLargeLabelledPlaneIsFoundWithItsOutline) {
  GEOMAP_REQUIRE_RECORDING(folder, "icl_labelled");
  geometry::RgbdFrame frame;
  frame.depth = drivers::read_depth_png(folder / "depth.png", 5000);  // rounded to millimetres
  frame.depth_camera = {kWidth, kHeight, 481.2, 480.0, 319.5, 239.5};
  const std::vector<std::uint8_t> labels = read_labels(folder / "labels.pgm");
  ASSERT_FALSE(labels.empty());
  const auto truth = pixels_by_plane(labels);
  ASSERT_GE(truth.size(), 5u);

  const ExtractedPlanes extracted = RansacExtractor().extract(frame, 1, std::nullopt);
  std::map<int, std::set<int>> found;  // by labelled plane: outlines that lie mostly on it
  for (const auto& plane : extracted.planes) {
    const std::set<int> inside = pixels_inside(plane.surface, frame.depth_camera);
    for (const auto& [label, pixels] : truth) {
      if (2 * common(inside, pixels) > inside.size()) found[label].insert(inside.begin(), inside.end());
    }
  }
  for (const auto& [label, pixels] : truth) {
    const double both = static_cast<double>(common(found[label], pixels));
    const double either = static_cast<double>(found[label].size() + pixels.size()) - both;
    EXPECT_GT(both / either, 0.85) << "label " << label << " with " << pixels.size() << " pixels";
    RecordProperty("iou_of_label_" + std::to_string(label), std::to_string(both / either));
    if (getenv("SHOW")) printf("label %d pixels %zu iou %.3f\n", label, pixels.size(), both/either);
  }
}

}  // namespace
}  // namespace geomap::perception
