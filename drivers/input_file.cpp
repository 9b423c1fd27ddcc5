// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/input_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "drivers/frame_source.hpp"

namespace geomap::drivers {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxBytes = std::uintmax_t{256} << 20;

std::vector<std::string> split_words(const std::string& text) {
  constexpr const char* kBlanks = " \t\r,";
  std::vector<std::string> words;
  std::size_t begin = text.find_first_not_of(kBlanks);
  while (begin != std::string::npos) {
    const std::size_t end = text.find_first_of(kBlanks, begin);
    words.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(kBlanks, end);
  }
  return words;
}

}  // namespace

std::vector<std::uint8_t> read_bytes(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw SourceError(path.string() + ": no such file");
  if (!fs::is_regular_file(status)) throw SourceError(path.string() + ": not a regular file");
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) throw SourceError(path.string() + ": " + error.message());
  if (size > kMaxBytes) throw SourceError(path.string() + ": larger than 256 MiB");

  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file) throw SourceError(path.string() + ": cannot be read");
  return bytes;
}

std::vector<TextRow> read_rows(const fs::path& path) {
  const std::vector<std::uint8_t> bytes = read_bytes(path);
  std::vector<TextRow> rows;
  std::size_t line = 0;
  for (auto begin = bytes.begin(); begin != bytes.end();) {
    const auto end = std::find(begin, bytes.end(), '\n');
    ++line;
    std::vector<std::string> words = split_words(std::string(begin, end));
    if (!words.empty() && words.front().front() != '#') rows.push_back({line, std::move(words)});
    begin = end == bytes.end() ? end : end + 1;
  }
  return rows;
}

double to_number(const std::string& word, const fs::path& path, std::size_t line) {
  double value = 0.0;
  const char* end = word.data() + word.size();
  const auto [stopped, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || stopped != end || !std::isfinite(value)) {
    throw SourceError(path.string() + ", line " + std::to_string(line) + ": '" + word +
                      "' is not a finite number");
  }
  return value;
}

std::vector<double> read_matrix(const fs::path& path, std::size_t rows, std::size_t columns) {
  std::vector<double> numbers;
  for (const TextRow& row : read_rows(path)) {
    for (const std::string& word : row.words) numbers.push_back(to_number(word, path, row.line));
  }
  if (numbers.size() != rows * columns) {
    throw SourceError(path.string() + ": " + std::to_string(numbers.size()) +
                      " numbers where a matrix of " + std::to_string(rows) + " x " +
                      std::to_string(columns) + " is wanted");
  }
  return numbers;
}

}  // namespace geomap::drivers
