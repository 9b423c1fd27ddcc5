// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "mapping/export_features.hpp"
#include "mapping/export_svg_label.hpp"

namespace geomap::mapping {

/// @brief `text` with the characters that mean something in XML written as entities.
std::string escape_xml(std::string_view text);

/// @brief About how wide a text is drawn [px], generous enough for the usual sans-serif fonts.
double text_width(std::string_view text, double font_size);

std::string to_hex(const Rgb& color);  // "#rrggbb"

enum class TextAnchor { kStart, kMiddle, kEnd };

struct TextStyle {
  double size = 12.0;  // [px]
  std::string_view color = "#1f2933";
  TextAnchor anchor = TextAnchor::kStart;
  bool bold = false;
  bool halo = false;  // white rim, for text over drawings
};

struct ShapeStyle {
  std::string fill = "none";
  double fill_opacity = 1.0;
  std::string stroke = "none";
  double stroke_width = 1.0;  // [px]
  double stroke_opacity = 1.0;
  bool dashed = false;
};

/// @brief Collects the elements of an SVG picture; units are pixels, y runs downwards.
class SvgCanvas {
 public:
  void text(const Eigen::Vector2d& at, std::string_view content, const TextStyle& style);
  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, std::string_view color,
            double width);
  /// An open line; nothing for fewer than two points.
  void polyline(const std::vector<Eigen::Vector2d>& points, std::string_view color, double width);
  void circle(const Eigen::Vector2d& centre, double radius, const ShapeStyle& style);
  void rectangle(const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
                 const ShapeStyle& style);
  /// Closed rings, filled by the even-odd rule.
  void rings(const PictureRings& rings, const ShapeStyle& style);
  void begin_group(std::string_view id);
  void end_group();

  /// @brief The whole file, on white.
  std::string finish(const Eigen::Vector2d& size, std::string_view title) const;

 private:
  std::string body_;
};

}  // namespace geomap::mapping
