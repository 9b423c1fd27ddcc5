// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/clean_text.hpp"

#include <nlohmann/json.hpp>

namespace geomap::mapping {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

// U+FFFE and U+FFFF are valid in UTF-8, but not characters of XML.
bool is_noncharacter(std::string_view text, std::size_t i) {
  const std::string_view bytes = text.substr(i, 3);
  return bytes == "\xEF\xBF\xBE" || bytes == "\xEF\xBF\xBF";
}

std::string valid_utf8(std::string_view text) {
  using nlohmann::json;
  const std::string quoted =
      json(std::string(text)).dump(-1, ' ', false, json::error_handler_t::replace);
  return json::parse(quoted).get<std::string>();
}

}  // namespace

std::string clean_text(std::string_view text) {
  const std::string valid = valid_utf8(text);
  std::string clean;
  for (std::size_t i = 0; i < valid.size(); ++i) {
    const auto byte = static_cast<unsigned char>(valid[i]);
    if (is_noncharacter(valid, i)) {
      clean += kReplacement;
      i += 2;
    } else {
      clean += byte < 0x20 || byte == 0x7F ? ' ' : valid[i];
    }
  }
  return clean;
}

}  // namespace geomap::mapping
