// SPDX-License-Identifier: BSD-3-Clause
// What it takes to draw a saved map and a point map, off the screen, while the eye goes round.
#include <epoxy/gl.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "mapping/map_journal.hpp"
#include "messaging/program.hpp"
#include "messaging/stopwatch.hpp"
#include "statistics.hpp"
#include "viewer/framebuffer.hpp"
#include "viewer/offscreen.hpp"
#include "viewer/offscreen_viewer.hpp"
#include "viewer/png_file.hpp"
#include "viewer/renderers.hpp"

namespace {

using namespace geomap;
using Eigen::Vector3d;
using viewer::SceneModel;

constexpr int kWidth = 1280, kHeight = 800;
constexpr int kFrames = 120;
constexpr double kBlock = 1.0;  // side of a block of points [m]

struct Options {
  std::string map, picture;
  std::int64_t points = 200'000;
  std::int64_t budget = 60'000;
  std::int64_t polygons = 0;
  std::int64_t vetoes = 0;
};

void add_map(const std::string& file, SceneModel& scene) {
  for (const mapping::MapFeature& feature :
       mapping::snapshot_of(mapping::load_map(file)).features) {
    scene.map.features.emplace(feature.id, mapping::quantised(feature));
  }
  scene.map.stamp = 1;
}

// From 0 to 1: the same on every machine, which the standard distributions are not.
double share(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }

// Squares of 0.2 to 0.6 m anywhere in the box, along its axes.
std::vector<mapping::MapFeature> made_up_squares(const Eigen::AlignedBox3d& box,
                                                 std::int64_t count) {
  std::mt19937 random(2);
  std::vector<mapping::MapFeature> squares;
  for (std::int64_t i = 0; i < count; ++i) {
    mapping::MapFeature square;
    square.id = {i + 1, static_cast<int>(i % 7)};
    const auto axis = static_cast<Eigen::Index>(random() % 3);
    geometry::PlaneFrame& frame = square.surface.frame;
    frame.normal = Vector3d::Unit(axis);
    frame.x_axis = Vector3d::Unit((axis + 1) % 3);
    const Vector3d at(share(random), share(random), share(random));
    frame.origin = box.min() + at.cwiseProduct(box.sizes());
    const double half = 0.1 + 0.2 * share(random);
    square.surface.plane = frame.plane();
    square.surface.polygon.parts = {
        {.outer = geometry::rectangle({-half, -half}, {half, half}), .holes = {}}};
    squares.push_back(square);
  }
  return squares;
}

void add_squares(const Options& options, SceneModel& scene) {
  const Eigen::AlignedBox3d box = scene.bounds();
  if (options.polygons > 0) scene.map.features.clear();
  for (const mapping::MapFeature& square : made_up_squares(box, options.polygons)) {
    scene.map.features.emplace(square.id, mapping::quantised(square));
  }
  for (const mapping::MapFeature& square : made_up_squares(box, options.vetoes)) {
    scene.map.vetoes.push_back({.edit = 1,
                                .cause = mapping::VetoCause::kDeleted,
                                .feature = square,
                                .region = square.surface.polygon});
  }
}

// Scattered evenly over the walls, the floor and the ceiling of the box, which is a room's.
void add_points(const Eigen::AlignedBox3d& box, std::int64_t points, SceneModel& scene) {
  std::mt19937 random(1);
  std::map<viewer::BlockKey, std::vector<viewer::ScenePoint>> blocks;
  for (std::int64_t i = 0; i < points; ++i) {
    Vector3d at(share(random), share(random), share(random));
    const auto axis = static_cast<Eigen::Index>(random() % 3);
    at[axis] = std::round(at[axis]);
    const auto shade = static_cast<std::uint8_t>(90.0 + 120.0 * at.z());
    at = box.min() + at.cwiseProduct(box.sizes());
    const Eigen::Vector3i key = (at / kBlock).array().floor().cast<int>();
    blocks[{key.x(), key.y(), key.z()}].push_back(
        {.position = at.cast<float>(), .color = {shade, shade, 160}});
  }
  for (auto& [key, block] : blocks) {
    viewer::PointBlock made{.points = {}, .box = {}, .stamp = 1};
    for (const auto& point : block) made.box.extend(point.position.cast<double>());
    made.points = std::make_shared<const std::vector<viewer::ScenePoint>>(std::move(block));
    scene.points.blocks.emplace(key, std::move(made));
  }
  scene.points.points = static_cast<std::size_t>(points);
  scene.points.stamp = 1;
}

struct View {
  const char* name;
  double nearness;  // distance of the eye against that from which everything is in view
  viewer::Projection projection;
};

void time_view(const View& view, const SceneModel& scene, const Options& options,
               viewer::Framebuffer& framebuffer) {
  const auto renderers = viewer::make_renderers();
  const viewer::Theme theme = viewer::dark_theme();
  const viewer::Selection selection;
  viewer::ViewCamera camera;
  camera.resize(kWidth, kHeight);
  viewer::Viewpoint viewpoint = camera.fitting(scene.bounds());
  viewpoint.distance *= view.nearness;
  viewpoint.projection = view.projection;
  std::vector<double> times;
  for (int i = 0; i <= kFrames; ++i) {
    viewpoint.yaw += 2.0 * std::numbers::pi / kFrames;
    camera.set(viewpoint);
    const messaging::Stopwatch stopwatch;
    framebuffer.begin(theme.background);
    viewer::draw_all(renderers, {scene, camera, selection, theme, 1.0F,
                                 static_cast<std::size_t>(options.budget)});
    glFinish();
    // The first one uploads everything and compiles the shaders.
    if (i > 0) times.push_back(1e3 * stopwatch.seconds());
  }
  std::printf("%9zu  %-12s  %8.1f ms  %8.1f ms  %8.0f\n", scene.points.points, view.name,
              bench::median(times), bench::quantile(times, 0.95), 1e3 / bench::median(times));
  std::fflush(stdout);
}

void time_views(const SceneModel& scene, const Options& options) {
  const viewer::OffscreenContext context;
  viewer::Framebuffer framebuffer(kWidth, kHeight);
  std::printf("%s, %d x %d, %zu polygons, %zu vetoes, %lld points drawn at most\n",
              context.renderer().c_str(), kWidth, kHeight, scene.map.features.size(),
              scene.map.vetoes.size(), static_cast<long long>(options.budget));
  std::printf("%9s  %-12s  %11s  %11s  %8s\n", "points", "view", "median", "95 %", "per s");
  for (const View& view : {View{"whole", 1.0, viewer::Projection::kPerspective},
                           View{"near", 0.35, viewer::Projection::kPerspective},
                           View{"orthographic", 1.0, viewer::Projection::kOrthographic}}) {
    time_view(view, scene, options, framebuffer);
    if (options.picture.empty()) continue;
    viewer::write_png(options.picture + "." + view.name + ".png", framebuffer.read());
  }
}

/// Shows a scene that is there already.
class ReadyScene : public viewer::MapSource {
 public:
  explicit ReadyScene(const SceneModel& scene) : ready_(&scene) {}
  std::string title() const override { return "bench"; }
  bool update(SceneModel& scene, viewer::Clock::time_point) override {
    if (!ready_) return false;
    scene = *std::exchange(ready_, nullptr);
    return true;
  }
  void edit(const mapping::EditCommand&) override {}
  std::vector<viewer::Outcome> take_outcomes() override { return {}; }
  const std::vector<viewer::HistoryEntry>& history() const override { return history_; }
  std::int64_t save(const std::string&) override { return 0; }
  std::string default_save_name() const override { return ""; }
  std::string save_prompt() const override { return ""; }
  mapping::MapSnapshot snapshot(const SceneModel&) const override { return {}; }

 private:
  const SceneModel* ready_;
  std::vector<viewer::HistoryEntry> history_;
};

// All of the window with its panels, turned as by the mouse.
void time_window(const SceneModel& scene) {
  viewer::OffscreenViewer window(std::make_unique<ReadyScene>(scene), {}, kWidth, kHeight, 1.0);
  window.wait_for_scene(0.0, 1.0);
  std::vector<double> times;
  for (int i = 0; i < 2 * kFrames; ++i) {
    window.app().view.camera().orbit(5.0, 0.0);
    const messaging::Stopwatch stopwatch;
    window.draw();
    glFinish();
    // Until then it finds out how many points it can afford.
    if (i >= kFrames) times.push_back(1e3 * stopwatch.seconds());
  }
  std::printf("%9zu  %-12s  %8.1f ms  %8.1f ms  %8.0f\n", scene.points.points, "window",
              bench::median(times), bench::quantile(times, 0.95), 1e3 / bench::median(times));
}

int run(const Options& options) {
  SceneModel scene;
  add_map(options.map, scene);
  add_squares(options, scene);
  add_points(scene.bounds(), options.points, scene);
  time_views(scene, options);
  time_window(scene);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  return messaging::run_program(
      argc, argv,
      {.name = "viewer_frame_times",
       .description = "Times the drawing of a saved map and a point map, off the screen.",
       .uses_config = false},
      [&](messaging::OptionParser& parser) {
        parser.positional("MAP", options.map, "saved map");
        parser.option("--points", options.points, "of a made-up point map around the map");
        parser.option("--budget", options.budget, "most points that are drawn in a frame");
        parser.option("--polygons", options.polygons, "made-up squares in place of the map's own");
        parser.option("--vetoes", options.vetoes, "made-up squares that are kept out");
        parser.option("--picture", options.picture, "beginning of the names of pictures to write");
      },
      [&](const messaging::CommonOptions&) { return run(options); });
}
