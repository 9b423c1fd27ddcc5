// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace geomap::drivers {

/// @brief One line of a text file: its words, and where it stood.
struct TextRow {
  std::size_t line = 0;  // counted from 1
  std::vector<std::string> words;
};

/// @brief All bytes of a file.
/// @throws SourceError naming the file when it is missing, no regular file, or larger than 256 MiB.
std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path);

/// @brief The lines of a text file that are neither blank nor a comment (`#`), split at blanks,
/// tabs and commas.
/// @throws SourceError as read_bytes does.
std::vector<TextRow> read_rows(const std::filesystem::path& path);

/// @brief A finite number, whatever the locale.
/// @throws SourceError naming file and line when `word` is anything else.
double to_number(const std::string& word, const std::filesystem::path& path, std::size_t line);

/// @brief The numbers of a text file of `rows` lines with `columns` numbers each, row by row.
/// @throws SourceError naming the file when it holds anything else.
std::vector<double> read_matrix(const std::filesystem::path& path, std::size_t rows,
                                std::size_t columns);

}  // namespace geomap::drivers
