// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/export_svg_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "geometry/angles.hpp"
#include "mapping/export_svg_axes.hpp"
#include "mapping/export_svg_label.hpp"
#include "mapping/export_svg_style.hpp"

namespace geomap::mapping {
namespace {

constexpr double kSmallestLabelled = 0.02;  // [m²]
constexpr double kLabelSize = 12.0;         // [px]
constexpr double kLabelClearance = 5.0;     // of a label's middle from its feature's edges [px]
constexpr std::size_t kLongestLabel = 24;   // characters of an operator's label
constexpr std::string_view kAccent = "#c8102e";

// Features in the picture, with what the drawing steps share.
struct Shape {
  const ProjectedFeature* projected = nullptr;
  PictureRings rings;
  Eigen::AlignedBox2d box;
  bool from_behind = false;
  bool highlighted = false;
};

Eigen::Vector2d drawing_corner(const SvgPanel& panel) {
  return panel.corner + Eigen::Vector2d(kPanelGutter, kPanelCaption);
}

Eigen::Vector2d to_pixels(const SvgPanel& panel, const Eigen::Vector2d& p) {
  // A drawing lower than its panel stands at the panel's bottom, like its axes.
  const double bottom = panel.corner.y() + panel.size().y();
  return {drawing_corner(panel).x() + panel.scale * (p.x() - panel.box.min().x()),
          bottom - panel.scale * (p.y() - panel.box.min().y())};
}

PictureRings to_pixels(const SvgPanel& panel, const ProjectedFeature& projected) {
  PictureRings rings;
  for (const auto& ring : projected.rings) {
    auto& pixels = rings.emplace_back();
    for (const Eigen::Vector2d& vertex : ring) pixels.push_back(to_pixels(panel, vertex));
  }
  return rings;
}

std::vector<Shape> shapes_of(const SvgPanel& panel, const PanelStyle& style) {
  std::vector<Shape> shapes;
  for (const std::size_t index : paint_order(panel.features)) {
    Shape& shape = shapes.emplace_back();
    shape.projected = &panel.features[index];
    shape.rings = to_pixels(panel, *shape.projected);
    for (const auto& ring : shape.rings) {
      for (const Eigen::Vector2d& vertex : ring) shape.box.extend(vertex);
    }
    shape.from_behind = is_seen_from_behind(*shape.projected);
    shape.highlighted = std::binary_search(style.highlighted.begin(), style.highlighted.end(),
                                           shape.projected->feature->id);
  }
  return shapes;
}

void draw_shape(SvgCanvas& canvas, const Shape& shape, const PanelStyle& style) {
  const Rgb fill = fill_color(*shape.projected->feature, style.heading);
  const bool pale = !style.highlighted.empty() && !shape.highlighted;
  ShapeStyle look;
  look.fill = to_hex(fill);
  look.fill_opacity = shape.from_behind ? 0.10 : pale ? 0.55 : 0.88;
  look.stroke = to_hex(outline_color(fill));
  look.stroke_width = shape.projected->feature->is_held() ? 3.0 : shape.from_behind ? 0.8 : 1.3;
  look.stroke_opacity = shape.from_behind || pale ? 0.55 : 1.0;
  canvas.rings(shape.rings, look);
}

std::string label_text(const ProjectedFeature& projected) {
  std::string text = fmt::format("#{}", projected.number);
  const std::string label = clean_text(projected.feature->label);
  if (label.empty()) return text;
  text += ' ';
  std::size_t characters = 0;
  for (const char c : label) {
    const bool starts_character = (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    if (starts_character && ++characters > kLongestLabel) return text + "…";
    text += c;
  }
  return text;
}

bool has_vertex_in(const Eigen::AlignedBox2d& box, const PictureRings& rings) {
  return std::any_of(rings.begin(), rings.end(), [&](const auto& ring) {
    return std::any_of(ring.begin(), ring.end(),
                       [&](const Eigen::Vector2d& vertex) { return box.contains(vertex); });
  });
}

// Finds every label a spot where its text lies on nothing else: on no other label, and on no face
// that is painted over the feature.
class LabelPlacer {
 public:
  LabelPlacer(SvgCanvas& canvas, const std::vector<Shape>& shapes)
      : canvas_(canvas), shapes_(shapes) {}

  void place(std::size_t index) {
    const Shape& shape = shapes_[index];
    const std::vector<LabelSpot> spots = label_spots(shape.rings);
    // With the whole text on the feature, else at least its middle. The number of a face seen from
    // behind would then be taken for that of what shines through.
    if (place_at_one_of(spots, index, true) || shape.from_behind) return;
    place_at_one_of(spots, index, false);
  }

 private:
  bool place_at_one_of(const std::vector<LabelSpot>& spots, std::size_t index, bool whole_text) {
    const std::string text = label_text(*shapes_[index].projected);
    const Eigen::Vector2d half(text_width(text, kLabelSize) / 2.0 + 2.0, kLabelSize / 2.0 + 1.0);
    for (const LabelSpot& spot : spots) {
      const Eigen::AlignedBox2d box(spot.point - half, spot.point + half);
      if (spot.clearance < kLabelClearance || is_taken(box) || !is_free(spot.point, index) ||
          (whole_text && !is_free(box, index))) {
        continue;
      }
      taken_.push_back(box);
      draw(spot.point, text, shapes_[index]);
      return true;
    }
    return false;
  }

  bool is_taken(const Eigen::AlignedBox2d& box) const {
    return std::any_of(taken_.begin(), taken_.end(),
                       [&](const Eigen::AlignedBox2d& other) { return other.intersects(box); });
  }

  // Faces that a text on the feature must not lie on: those over it; of one seen from behind, all.
  bool counts_as_cover(std::size_t other, std::size_t index) const {
    if (other == index || shapes_[other].from_behind) return false;
    return other > index || shapes_[index].from_behind;
  }

  bool is_free(const Eigen::Vector2d& point, std::size_t index) const {
    if (clearance(shapes_[index].rings, point) <= 0.0) return false;
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      if (!counts_as_cover(i, index) || !shapes_[i].box.contains(point)) continue;
      if (clearance(shapes_[i].rings, point) > 0.0) return false;
    }
    return true;
  }

  bool is_free(const Eigen::AlignedBox2d& box, std::size_t index) const {
    for (const double across : {-0.5, 0.0, 0.5}) {
      for (const double down : {-0.5, 0.5}) {
        const Eigen::Vector2d part(across * box.sizes().x(), down * box.sizes().y());
        if (!is_free(Eigen::Vector2d(box.center() + part), index)) return false;
      }
    }
    // A face smaller than the text may lie between those points.
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      if (counts_as_cover(i, index) && has_vertex_in(box, shapes_[i].rings)) return false;
    }
    return true;
  }

  void draw(const Eigen::Vector2d& middle, const std::string& text, const Shape& shape) {
    TextStyle look{.size = kLabelSize, .anchor = TextAnchor::kMiddle, .bold = true, .halo = true};
    if (shape.from_behind) look.color = "#7b8794";
    if (shape.highlighted) look.color = kAccent;
    // Capital letters and digits are about 0.72 of the font's size high.
    canvas_.text(middle + Eigen::Vector2d(0.0, 0.36 * kLabelSize), text, look);
  }

  SvgCanvas& canvas_;
  const std::vector<Shape>& shapes_;
  std::vector<Eigen::AlignedBox2d> taken_;
};

void draw_labels(SvgCanvas& canvas, const std::vector<Shape>& shapes) {
  std::vector<std::pair<double, std::size_t>> by_area;  // largest first, pale ones last
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const double area = geometry::area(shapes[i].projected->feature->surface.polygon);
    if (area < kSmallestLabelled) continue;
    by_area.emplace_back(shapes[i].from_behind ? 1.0 / area : -area, i);
  }
  std::sort(by_area.begin(), by_area.end());
  LabelPlacer placer(canvas, shapes);
  for (const auto& [rank, index] : by_area) placer.place(index);
}

// "-y" for a direction along an axis, else degrees.
std::string direction_text(double heading) {
  constexpr std::array<std::string_view, 4> kAxes = {"+x", "+y", "-x", "-y"};
  const double degrees = geometry::degrees(heading);
  const double quarters = std::round(degrees / 90.0);
  if (std::abs(degrees - 90.0 * quarters) < 0.5) {
    return std::string(kAxes[(static_cast<std::size_t>(quarters + 400.0)) % 4]);
  }
  return fmt::format("{:.0f}° from x", degrees);
}

std::string caption(const SvgPanel& panel, double heading) {
  switch (panel.view) {
    case SvgView::kTop:
      return "Top";
    case SvgView::kFront:
      return "Front, looking along " + direction_text(heading);
    case SvgView::kOblique:
      return "Oblique";
  }
  return "";
}

}  // namespace

Eigen::Vector2d SvgPanel::size() const {
  const Eigen::Vector2d drawing = scale * box.sizes();
  return {kPanelGutter + drawing.x(), kPanelCaption + std::max(kPanelMinHeight, drawing.y())};
}

void draw_panel(SvgCanvas& canvas, const SvgPanel& panel, const PanelStyle& style) {
  canvas.text(panel.corner + Eigen::Vector2d(0.0, 14.0), caption(panel, style.heading),
              {.size = 13.0, .color = "#52606d", .bold = true});
  const Eigen::Vector2d axes_at(34.0, panel.size().y() - kPanelMinHeight / 2.0);
  draw_axes(canvas, panel.corner + axes_at, panel.axes);
  const std::vector<Shape> shapes = shapes_of(panel, style);
  for (const Shape& shape : shapes) draw_shape(canvas, shape, style);
  for (const ProjectedFeature& deleted : panel.deleted) {
    canvas.rings(to_pixels(panel, deleted),
                 {.stroke = std::string(kDeletedColor), .stroke_width = 1.4, .dashed = true});
  }
  for (const Shape& shape : shapes) {
    if (!shape.highlighted) continue;
    canvas.rings(shape.rings, {.stroke = std::string(kAccent), .stroke_width = 2.4});
  }
  if (style.labels) draw_labels(canvas, shapes);
}

}  // namespace geomap::mapping
