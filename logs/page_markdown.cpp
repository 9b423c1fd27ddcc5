// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <string_view>

#include "logs/page_document.hpp"

namespace geomap::logs {
namespace {

// What would end a cell, or begin an element.
std::string escape(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|' || c == '<' || c == '*' || c == '`') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string cell_text(const Cell& cell) {
  std::string text = escape(cell.text);
  if (cell.strong) text = "**" + text + "**";
  if (!cell.note.empty()) text += " (" + escape(cell.note) + ")";
  return text;
}

std::string markdown(const Heading& heading, int deeper) {
  const int level = heading.level + deeper;
  return std::string(static_cast<std::size_t>(level), '#') + " " + escape(heading.text) + "\n\n";
}

std::string markdown(const Table& table) {
  std::string text;
  if (!table.caption.empty()) text += escape(table.caption) + "\n\n";
  std::string rule;
  for (const Column& column : table.columns) {
    text += "| " + escape(column.title) + " ";
    rule += column.number ? "|--:" : "|---";
  }
  text += "|\n" + rule + "|\n";
  for (const Row& row : table.rows) {
    const bool group = row.kind == RowKind::kGroup;
    const std::size_t empty = table.columns.size() - row.cells.size();
    for (Cell cell : row.cells) {
      cell.strong |= group;
      text += fmt::format("| {} ", cell_text(cell));
    }
    for (std::size_t i = 0; i < empty; ++i) text += "| ";
    text += "|\n";
  }
  return text + "\n";
}

std::string markdown(const Gallery& gallery) {
  std::string text;
  for (const Picture& picture : gallery.pictures) {
    text += fmt::format("![{}](pictures/{})\n\n{}\n\n", escape(picture.caption), picture.name,
                        escape(picture.caption));
  }
  return text;
}

}  // namespace

std::string to_markdown(const Document& document) {
  std::string text = markdown(Heading{1, document.title}, 0);
  for (const Block& block : document.blocks) {
    if (const auto* heading = std::get_if<Heading>(&block)) text += markdown(*heading, 0);
    if (const auto* paragraph = std::get_if<Paragraph>(&block)) {
      text += escape(paragraph->text) + "\n\n";
    }
    if (const auto* table = std::get_if<Table>(&block)) text += markdown(*table);
    if (const auto* gallery = std::get_if<Gallery>(&block)) text += markdown(*gallery);
  }
  return text;
}

std::string tables_markdown(const Document& document) {
  std::string text;
  const Heading* heading = nullptr;  // of the next table, written once there is one
  for (const Block& block : document.blocks) {
    if (const auto* next = std::get_if<Heading>(&block)) heading = next;
    if (const auto* table = std::get_if<Table>(&block)) {
      if (heading) text += markdown(*heading, 1);
      heading = nullptr;
      text += markdown(*table);
    }
  }
  return text;
}

std::vector<const Picture*> pictures_of(const Document& document) {
  std::vector<const Picture*> pictures;
  for (const Block& block : document.blocks) {
    const auto* gallery = std::get_if<Gallery>(&block);
    if (!gallery) continue;
    for (const Picture& picture : gallery->pictures) pictures.push_back(&picture);
  }
  return pictures;
}

}  // namespace geomap::logs
