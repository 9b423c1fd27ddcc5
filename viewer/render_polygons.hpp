// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "viewer/painter.hpp"
#include "viewer/polygon_colors.hpp"
#include "viewer/renderer.hpp"
#include "viewer/surface_batch.hpp"

namespace geomap::viewer {

/// @brief The geometric map: see-through polygons with outlines, marked where they are selected,
/// moved or about to go.
class RenderPolygons : public Renderer {
 public:
  enum class Label { kNone, kNumber, kLabel, kId };

  explicit RenderPolygons(std::shared_ptr<Painter> painter)
      : Renderer("Map polygons", true), painter_(std::move(painter)) {}

  int order() const override { return 10; }
  void draw(const DrawContext& context) override;
  void add_labels(const DrawContext& context, std::vector<SceneLabel>& labels) override;
  bool panel() override;
  void load(const Preferences& preferences) override;
  void store(Preferences& preferences) const override;

  std::int64_t shapes_made() const { return shapes_made_; }  // since the beginning

  PolygonColor color = PolygonColor::kNormal;
  Label label = Label::kLabel;
  double opacity = 0.55;  // 0 to 1

 private:
  struct Kept {
    mapping::ViewFeature feature;  // as it was uploaded
    SurfaceShape shape;
    int number = 0;  // in the order of the ids, from 1, as geomap-edit lists them
    std::size_t part() const { return static_cast<std::size_t>(number - 1); }  // of the batch
  };
  // One polygon at one place: a feature that is being moved is drawn twice.
  struct Piece {
    enum class Kind { kPlain, kMoved, kGhost };
    const Kept* kept = nullptr;
    Kind kind = Kind::kPlain;
    Eigen::Isometry3d T_world_batch = Eigen::Isometry3d::Identity();
    Eigen::Vector3d middle = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::UnitZ();  // world
    double depth = 0.0;  // of its middle, from the eye [m]
  };

  void update(const MapLayer& map);
  std::vector<Piece> pieces(const DrawContext& context) const;
  SurfaceStyle style_of(const DrawContext& context, const Piece& piece) const;
  void draw_back_to_front(const DrawContext& context, const std::vector<Piece>& pieces);
  void draw_moved_outline(const DrawContext& context, const Piece& piece);
  void draw_moved(const DrawContext& context, const Piece& piece);
  void draw_ghost(const DrawContext& context, const Piece& piece);

  std::shared_ptr<Painter> painter_;
  std::map<mapping::FeatureId, Kept> kept_;
  SurfaceBatch batch_;  // of kept_, in its order
  std::int64_t shapes_made_ = 0;
  PolygonColors colors_;
  Stamp stamp_ = 0;
};

}  // namespace geomap::viewer
