// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/export_svg_canvas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace geomap::mapping {
namespace {

std::string_view anchor_name(TextAnchor anchor) {
  switch (anchor) {
    case TextAnchor::kStart:
      return "start";
    case TextAnchor::kMiddle:
      return "middle";
    case TextAnchor::kEnd:
      return "end";
  }
  return "start";
}

std::string attributes(const ShapeStyle& style) {
  std::string text = fmt::format("fill=\"{}\"", style.fill);
  if (style.fill != "none") text += fmt::format(" fill-opacity=\"{:.2f}\"", style.fill_opacity);
  if (style.stroke != "none") {
    text += fmt::format(" stroke=\"{}\" stroke-width=\"{:.1f}\" stroke-opacity=\"{:.2f}\"",
                        style.stroke, style.stroke_width, style.stroke_opacity);
    if (style.dashed) text += " stroke-dasharray=\"6 4\"";
  }
  return text;
}

}  // namespace

std::string escape_xml(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

double text_width(std::string_view text, double font_size) {
  // Continuation bytes of UTF-8 are no characters of their own.
  const auto characters = std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  });
  return 0.62 * font_size * static_cast<double>(characters);
}

std::string to_hex(const Rgb& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

void SvgCanvas::text(const Eigen::Vector2d& at, std::string_view content, const TextStyle& style) {
  auto out = std::back_inserter(body_);
  fmt::format_to(out, "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:.0f}\" fill=\"{}\"", at.x(),
                 at.y(), style.size, style.color);
  if (style.anchor != TextAnchor::kStart) {
    fmt::format_to(out, " text-anchor=\"{}\"", anchor_name(style.anchor));
  }
  if (style.bold) body_ += " font-weight=\"bold\"";
  if (style.halo) {
    body_ +=
        " paint-order=\"stroke\" stroke=\"#ffffff\" stroke-width=\"3\" stroke-opacity=\"0.85\"";
    body_ += " stroke-linejoin=\"round\"";
  }
  fmt::format_to(out, ">{}</text>\n", escape_xml(content));
}

void SvgCanvas::line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, std::string_view color,
                     double width) {
  fmt::format_to(std::back_inserter(body_),
                 "<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" stroke=\"{}\" "
                 "stroke-width=\"{:.1f}\"/>\n",
                 from.x(), from.y(), to.x(), to.y(), color, width);
}

void SvgCanvas::polyline(const std::vector<Eigen::Vector2d>& points, std::string_view color,
                         double width) {
  if (points.size() < 2) return;
  auto out = std::back_inserter(body_);
  body_ += "<polyline points=\"";
  for (const Eigen::Vector2d& point : points) {
    fmt::format_to(out, "{:.2f},{:.2f} ", point.x(), point.y());
  }
  body_.back() = '"';
  fmt::format_to(out, " fill=\"none\" stroke=\"{}\" stroke-width=\"{:.1f}\"/>\n", color, width);
}

void SvgCanvas::circle(const Eigen::Vector2d& centre, double radius, const ShapeStyle& style) {
  fmt::format_to(std::back_inserter(body_),
                 "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.1f}\" {}/>\n", centre.x(), centre.y(),
                 radius, attributes(style));
}

void SvgCanvas::rectangle(const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
                          const ShapeStyle& style) {
  fmt::format_to(std::back_inserter(body_),
                 "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" {}/>\n",
                 corner.x(), corner.y(), size.x(), size.y(), attributes(style));
}

void SvgCanvas::rings(const PictureRings& rings, const ShapeStyle& style) {
  auto out = std::back_inserter(body_);
  body_ += "<path d=\"";
  for (const auto& ring : rings) {
    char command = 'M';
    for (const Eigen::Vector2d& vertex : ring) {
      fmt::format_to(out, "{}{:.2f},{:.2f}", command, vertex.x(), vertex.y());
      command = 'L';
    }
    body_ += 'Z';
  }
  fmt::format_to(out, "\" {}/>\n", attributes(style));
}

void SvgCanvas::begin_group(std::string_view id) {
  fmt::format_to(std::back_inserter(body_), "<g id=\"{}\">\n", escape_xml(id));
}

void SvgCanvas::end_group() { body_ += "</g>\n"; }

std::string SvgCanvas::finish(const Eigen::Vector2d& size, std::string_view title) const {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" "
      "fill-rule=\"evenodd\" stroke-linejoin=\"round\">\n<title>{2}</title>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{3}</svg>\n",
      size.x(), size.y(), escape_xml(title), body_);
}

}  // namespace geomap::mapping
