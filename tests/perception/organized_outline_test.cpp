// SPDX-License-Identifier: BSD-3-Clause
// Outlines of the organized extractor on the recorded kitchen: what every polygon must hold.
#include <cmath>

#include "drivers/image_file.hpp"
#include "geometry/polygon.hpp"
#include "perception/organized_extractor.hpp"
#include "perception/plane_rays.hpp"
#include "support/recordings.hpp"

namespace geomap::perception {
namespace {

double lifted_area(const geometry::CameraModel& camera, const ExtractedPlanes& found,
                   std::size_t plane) {
  double area = 0.0;
  for (std::size_t i = 0; i < found.label.size(); ++i) {
    if (found.label[i] != static_cast<int>(plane)) continue;
    const Eigen::Vector2d pixel(static_cast<double>(i % static_cast<std::size_t>(camera.width)),
                                static_cast<double>(i / static_cast<std::size_t>(camera.width)));
    area += pixel_area(camera, found.planes[plane].surface.plane, pixel);
  }
  return area;
}

TEST(OrganizedOutline, PolygonsHaveTheAreaOfTheirPixels) {
  GEOMAP_REQUIRE_RECORDING(folder, "redkitchen");
  double covered = 0.0, outlined = 0.0;
  for (const char* number : {"000000", "000100", "000200", "000300", "000400"}) {
    geometry::RgbdFrame frame;
    frame.depth = drivers::read_depth_png(folder / ("frame-" + std::string(number) + ".depth.png"));
    frame.depth_camera = {640, 480, 585.0, 585.0, 320.0, 240.0};
    const ExtractedPlanes found = OrganizedExtractor().extract(frame, 1, std::nullopt);
    ASSERT_GT(found.planes.size(), 3u);
    for (std::size_t i = 0; i < found.planes.size(); ++i) {
      const geometry::Polygon& polygon = found.planes[i].surface.polygon;
      EXPECT_EQ(geometry::find_fault(polygon), "");
      const double pixels = lifted_area(frame.depth_camera, found, i);
      covered += pixels;
      outlined += geometry::area(polygon);
      if (pixels < 0.1) continue;
      EXPECT_NEAR(geometry::area(polygon), pixels, 0.08 * pixels) << number << " plane " << i;
    }
  }
  EXPECT_NEAR(outlined, covered, 0.02 * covered);
}

}  // namespace
}  // namespace geomap::perception
