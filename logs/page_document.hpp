// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace geomap::logs {

struct Heading {
  int level = 2;  // 1 is the page's title
  std::string text;
};

struct Paragraph {
  std::string text;
};

enum class CellTone { kPlain, kGood, kBad };

struct Cell {
  std::string text;
  std::string note = "";  // small, after the text
  bool strong = false;    // better than what stands beside it
  CellTone tone = CellTone::kPlain;
};

struct Column {
  std::string title;
  bool number = true;  // to the right
};

enum class RowKind {
  kPlain,
  kReference,  // what the others are compared with
  kGroup       // heading of the rows below: one cell
};

struct Row {
  std::vector<Cell> cells;  // one a column
  RowKind kind = RowKind::kPlain;
};

struct Table {
  std::string caption;
  std::vector<Column> columns;
  std::vector<Row> rows;
};

struct Picture {
  std::string name;  // file name without folder
  std::string svg;
  std::string caption;
};

/// @brief Pictures side by side where there is room.
struct Gallery {
  std::vector<Picture> pictures;
  bool wide = false;  // each over the whole width
};

using Block = std::variant<Heading, Paragraph, Table, Gallery>;

/// @brief A page, independent of how it is written down. All texts are plain.
struct Document {
  std::string title;
  std::vector<Block> blocks;
};

/// @brief One Markdown file; pictures are referred to as pictures/NAME.
std::string to_markdown(const Document& document);

/// @brief Its tables with their headings one level deeper, to be put into another Markdown file.
std::string tables_markdown(const Document& document);

/// @brief One HTML file that needs no other: style sheet and pictures are in it.
std::string to_html(const Document& document);

/// @brief All pictures in the order of the page.
std::vector<const Picture*> pictures_of(const Document& document);

}  // namespace geomap::logs
