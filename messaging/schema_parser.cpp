// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/schema_parser.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <stdexcept>

namespace geomap::messaging {
namespace {

const std::map<std::string, FieldType> kPrimitives = {
    {"int8_t", FieldType::kInt8},   {"int16_t", FieldType::kInt16},
    {"int32_t", FieldType::kInt32}, {"int64_t", FieldType::kInt64},
    {"byte", FieldType::kByte},     {"boolean", FieldType::kBoolean},
    {"float", FieldType::kFloat},   {"double", FieldType::kDouble},
    {"string", FieldType::kString},
};

bool is_word_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '-' ||
         c == '+';
}

/// Words and single punctuation marks; comments and white space are gone.
std::vector<std::string> split_into_tokens(const std::string& text) {
  std::vector<std::string> tokens;
  std::size_t i = 0;
  while (i < text.size()) {
    if (text.compare(i, 2, "//") == 0) {
      i = std::min(text.find('\n', i), text.size());
    } else if (text.compare(i, 2, "/*") == 0) {
      const std::size_t end = text.find("*/", i + 2);
      if (end == std::string::npos) throw std::invalid_argument("a comment does not end");
      i = end + 2;
    } else if (std::isspace(static_cast<unsigned char>(text[i])) != 0) {
      ++i;
    } else if (is_word_character(text[i])) {
      const std::size_t start = i;
      while (i < text.size() && is_word_character(text[i])) ++i;
      tokens.push_back(text.substr(start, i - start));
    } else {
      tokens.emplace_back(1, text[i++]);
    }
  }
  return tokens;
}

class Parser {
 public:
  explicit Parser(const std::string& text) : tokens_(split_into_tokens(text)) {}

  std::vector<MessageSchema> parse() {
    std::vector<MessageSchema> schemas;
    while (position_ < tokens_.size()) {
      if (accept("package")) {
        package_ = word();
        expect(";");
      } else {
        expect("struct");
        schemas.push_back(parse_struct());
      }
    }
    return schemas;
  }

 private:
  MessageSchema parse_struct() {
    MessageSchema schema;
    schema.name = qualified(word());
    expect("{");
    while (!accept("}")) {
      if (accept("const")) {
        while (!accept(";")) next();
      } else {
        parse_fields(schema);
      }
    }
    if (schema.fields.size() > kMaxFields) fail("'" + schema.name + "' has too many fields");
    return schema;
  }

  /// One type and one or more names, for example `double x[3], y[3];`.
  void parse_fields(MessageSchema& schema) {
    const std::string type_name = word();
    const auto primitive = kPrimitives.find(type_name);
    do {
      Field field;
      field.name = word();
      field.type = primitive == kPrimitives.end() ? FieldType::kStruct : primitive->second;
      field.type_name = primitive == kPrimitives.end() ? qualified(type_name) : type_name;
      if (accept("[")) field.array = parse_length(schema);
      schema.fields.push_back(field);
    } while (accept(","));
    expect(";");
  }

  ArrayLength parse_length(const MessageSchema& schema) {
    ArrayLength array;
    array.text = word();
    expect("]");
    array.is_constant = std::isdigit(static_cast<unsigned char>(array.text.front())) != 0;
    if (array.is_constant) {
      array.length = std::stoul(array.text, nullptr, 0);
      return array;
    }
    const auto counter = std::find_if(schema.fields.begin(), schema.fields.end(),
                                      [&](const Field& field) { return field.name == array.text; });
    if (counter == schema.fields.end() || counter->array || counter->type > FieldType::kInt64) {
      fail("'" + array.text + "' does not count anything before this array");
    }
    array.count_field = static_cast<std::size_t>(counter - schema.fields.begin());
    return array;
  }

  std::string qualified(const std::string& name) const {
    return name.find('.') == std::string::npos ? package_ + "." + name : name;
  }

  const std::string& next() {
    if (position_ >= tokens_.size()) fail("the text ends too early");
    return tokens_[position_++];
  }

  const std::string& word() {
    const std::string& token = next();
    if (!is_word_character(token.front())) fail("'" + token + "' where a name should be");
    return token;
  }

  bool accept(const std::string& token) {
    if (position_ >= tokens_.size() || tokens_[position_] != token) return false;
    ++position_;
    return true;
  }

  void expect(const std::string& token) {
    if (next() != token) fail("'" + tokens_[position_ - 1] + "' where '" + token + "' should be");
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw std::invalid_argument("message types: " + what + " (token " + std::to_string(position_) +
                                ")");
  }

  std::vector<std::string> tokens_;
  std::size_t position_ = 0;
  std::string package_;
};

}  // namespace

std::vector<MessageSchema> parse_lcm(const std::string& text) { return Parser(text).parse(); }

}  // namespace geomap::messaging
