// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "logs/page_document.hpp"
#include "mapping/export_svg_canvas.hpp"

namespace geomap::logs {
namespace {

using mapping::escape_xml;

constexpr std::string_view kStyle = R"(
:root { color-scheme: light; }
body { margin: 0 auto; max-width: 70rem; padding: 1.2rem; background: #fbfbfa; color: #1f2933;
  font: 16px/1.5 system-ui, "Segoe UI", "DejaVu Sans", Helvetica, Arial, sans-serif; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: .6rem 0 1rem; }
h2 { font-size: 1.25rem; margin: 2.4rem 0 .6rem; padding-top: .8rem; border-top: 1px solid #d9dee4; }
h3 { font-size: 1.05rem; margin: 1.6rem 0 .4rem; }
p { max-width: 46rem; margin: .5rem 0; }
.scroll { overflow-x: auto; margin: .8rem 0 1.2rem; }
table { border-collapse: collapse; background: #fff; font-size: .9rem;
  font-variant-numeric: tabular-nums; border: 1px solid #d9dee4; }
caption { caption-side: top; text-align: left; color: #52606d; padding: 0 0 .35rem; }
th, td { padding: .32rem .7rem; text-align: left; vertical-align: top; background: #fff;
  border-bottom: 1px solid #e8ebee; }
th { background: #f0f2f4; font-weight: 600; vertical-align: bottom; }
th:first-child, td:first-child { position: sticky; left: 0; }
th.group { background: #fff; padding-top: .8rem; }
th.group span { position: sticky; left: .45rem; }
.number { text-align: right; }
td.number { white-space: nowrap; }
th.number { min-width: 3.2rem; max-width: 8.5rem; }
.reference td { background: #f7f3e8; }
.note { display: block; color: #6b7785; font-size: .86em; line-height: 1.2; }
.good { color: #1a6b3c; }
.bad { color: #b3261e; font-weight: 600; }
.gallery { display: flex; flex-wrap: wrap; gap: 1rem; margin: .8rem 0 1.2rem; }
figure { margin: 0; flex: 1 1 24rem; min-width: 0; max-width: 36rem; background: #fff;
  border: 1px solid #d9dee4; padding: .6rem; box-sizing: border-box; }
.wide figure { flex-basis: 100%; max-width: 100%; }
figure svg { display: block; width: 100%; height: auto; }
figcaption { color: #52606d; font-size: .88rem; margin-top: .4rem; }
@media (max-width: 40rem) {
  body { padding: .8rem; } th, td { padding: .28rem .45rem; } figure { flex-basis: 100%; }
}
@media print {
  body { background: #fff; max-width: none; padding: 0; font-size: 10pt; }
  .scroll { overflow: visible; } table { font-size: 8pt; } th, td { padding: .15rem .35rem; }
  tr, figure { break-inside: avoid; } h2, h3 { break-after: avoid; }
}
)";

// An SVG file as an element: without the XML declaration, and with ids that no other picture has.
std::string inlined(std::string_view svg, std::string_view prefix) {
  std::string text(svg.substr(std::min(svg.find("<svg"), svg.size())));
  const std::string_view id = " id=\"";
  for (std::size_t at = text.find(id); at != std::string::npos; at = text.find(id, at + 1)) {
    text.insert(at + id.size(), prefix);
  }
  return text;
}

std::string write(const Column& column) {
  return fmt::format("<th{}>{}</th>", column.number ? " class=\"number\"" : "",
                     escape_xml(column.title));
}

std::string write(const Cell& cell, bool number) {
  std::string text = escape_xml(cell.text);
  if (cell.strong) text = "<strong>" + text + "</strong>";
  if (!cell.note.empty()) text += "<span class=\"note\">" + escape_xml(cell.note) + "</span>";
  std::string classes = number ? "number" : "";
  if (cell.tone == CellTone::kGood) classes += " good";
  if (cell.tone == CellTone::kBad) classes += " bad";
  return classes.empty() ? "<td>" + text + "</td>"
                         : fmt::format("<td class=\"{}\">{}</td>", classes, text);
}

std::string write(const Table& table) {
  std::string text = "<div class=\"scroll\"><table>\n";
  if (!table.caption.empty()) text += "<caption>" + escape_xml(table.caption) + "</caption>\n";
  text += "<thead><tr>";
  for (const Column& column : table.columns) text += write(column);
  text += "</tr></thead>\n<tbody>\n";
  for (const Row& row : table.rows) {
    if (row.kind == RowKind::kGroup) {
      text += fmt::format("<tr><th class=\"group\" colspan=\"{}\"><span>{}</span></th></tr>\n",
                          table.columns.size(), escape_xml(row.cells.front().text));
      continue;
    }
    text += row.kind == RowKind::kReference ? "<tr class=\"reference\">" : "<tr>";
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      text += write(row.cells[i], table.columns.at(i).number);
    }
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

std::string write(const Gallery& gallery, int& pictures) {
  std::string text = gallery.wide ? "<div class=\"gallery wide\">\n" : "<div class=\"gallery\">\n";
  for (const Picture& picture : gallery.pictures) {
    text += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n",
                        inlined(picture.svg, fmt::format("picture{}-", ++pictures)),
                        escape_xml(picture.caption));
  }
  return text + "</div>\n";
}

}  // namespace

std::string to_html(const Document& document) {
  const std::string title = escape_xml(document.title);
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n<meta "
      "name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>{}</title>\n"
      "<style>{}</style>\n</head>\n<body>\n<h1>{}</h1>\n",
      title, kStyle, title);
  int pictures = 0;
  for (const Block& block : document.blocks) {
    if (const auto* heading = std::get_if<Heading>(&block)) {
      text += fmt::format("<h{0}>{1}</h{0}>\n", heading->level, escape_xml(heading->text));
    }
    if (const auto* paragraph = std::get_if<Paragraph>(&block)) {
      text += "<p>" + escape_xml(paragraph->text) + "</p>\n";
    }
    if (const auto* table = std::get_if<Table>(&block)) text += write(*table);
    if (const auto* gallery = std::get_if<Gallery>(&block)) text += write(*gallery, pictures);
  }
  return text + "</body>\n</html>\n";
}

}  // namespace geomap::logs
