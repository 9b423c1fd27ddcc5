// SPDX-License-Identifier: BSD-3-Clause
#include "logs/message_fields.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "logs/message_head.hpp"
#include "logs/table_text.hpp"
#include "messaging/big_endian.hpp"

namespace geomap::logs {
namespace {

using messaging::Field;
using messaging::FieldType;
using messaging::MessageSchema;

constexpr std::size_t kFirstNumbers = 4;
constexpr std::size_t kFirstStructs = 2;

// Does `path` name `field`, or something inside it?
bool is_within(const std::string& path, const std::string& field) {
  return path.starts_with(field) &&
         (path.size() == field.size() || path[field.size()] == '.' || path[field.size()] == '[');
}

/// Reads a message that is known to be sound.
class FieldReader {
 public:
  FieldReader(const std::uint8_t* message, std::string wanted)
      : at_(message + messaging::kFingerprintSize), wanted_(std::move(wanted)) {}

  void read(const MessageSchema& schema, const std::string& prefix) {
    std::array<std::int64_t, messaging::kMaxFields> counts{};
    for (std::size_t i = 0; i < schema.fields.size(); ++i) {
      const Field& field = schema.fields[i];
      if (!field.array && field.type <= FieldType::kInt64) {
        counts[i] = messaging::read_signed(at_, messaging::encoded_size(field.type));
      }
      if (field.array) {
        const auto count = field.array->is_constant
                               ? field.array->length
                               : static_cast<std::size_t>(counts[field.array->count_field]);
        read_array(field, prefix + field.name, count);
      } else {
        read_one(field, prefix + field.name);
      }
    }
  }

  std::vector<FieldText> take_texts() { return std::move(texts_); }

 private:
  void read_one(const Field& field, const std::string& path) {
    if (field.type == FieldType::kStruct) {
      read(*field.nested, path + ".");
    } else {
      show(path, take_value(field.type));
    }
  }

  void read_array(const Field& field, const std::string& path, std::size_t count) {
    if (field.type == FieldType::kByte) {
      at_ += count;
      show(path, fmt::format("{} bytes", count));
    } else if (field.type == FieldType::kStruct) {
      read_structs(field, path, count);
    } else {
      read_values(field, path, count);
    }
  }

  void read_structs(const Field& field, const std::string& path, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::string element = fmt::format("{}[{}]", path, i);
      const bool was_hidden = is_hidden_;
      is_hidden_ |= i >= kFirstStructs && !is_within(wanted_, element);
      read(*field.nested, element + ".");
      is_hidden_ = was_hidden;
    }
    if (count == 0 || count > kFirstStructs) show(path, fmt::format("({})", count));
  }

  void read_values(const Field& field, const std::string& path, std::size_t count) {
    const bool is_one_wanted = wanted_.starts_with(path + "[");
    std::string text;
    for (std::size_t i = 0; i < count; ++i) {
      const std::string value = take_value(field.type);
      if (is_one_wanted && wanted_ == fmt::format("{}[{}]", path, i)) show(wanted_, value);
      if (i < kFirstNumbers) text += value + " ";
    }
    show(path, fmt::format("{}{}({})", text, count > kFirstNumbers ? ".. " : "", count));
  }

  void show(const std::string& path, const std::string& value) {
    if (is_hidden_ || !(wanted_.empty() || is_within(path, wanted_))) return;
    texts_.push_back({path, value});
  }

  std::string take_value(FieldType type) {
    const std::uint8_t* value = at_;
    const std::size_t size = messaging::encoded_size(type);
    if (type == FieldType::kString) return take_string();
    at_ += size;
    switch (type) {
      case FieldType::kDouble:
        return fmt::format("{}", messaging::read_double(value));
      case FieldType::kFloat:
        return fmt::format("{}", messaging::read_float(value));
      case FieldType::kBoolean:
        return *value != 0 ? "true" : "false";
      case FieldType::kByte:
        return fmt::format("{}", *value);
      default:
        return fmt::format("{}", messaging::read_signed(value, size));
    }
  }

  std::string take_string() {
    const auto length = static_cast<std::size_t>(messaging::read_unsigned(at_, 4));
    const std::uint8_t* first = at_ + 4;
    at_ = first + length;
    return '"' + printable({first, at_ - 1}) + '"';  // the last byte is a zero
  }

  const std::uint8_t* at_;
  std::string wanted_;
  bool is_hidden_ = false;
  std::vector<FieldText> texts_;
};

}  // namespace

std::vector<FieldText> message_fields(std::span<const std::uint8_t> message,
                                      const std::string& wanted) {
  const MessageSchema* type = sound_type_of(message);
  if (type == nullptr) return {};
  FieldReader reader(message.data(), wanted);
  reader.read(*type, "");
  return reader.take_texts();
}

}  // namespace geomap::logs
