// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace geomap::messaging {

/// @brief LCM's primitive types, or another struct.
enum class FieldType {
  kInt8,
  kInt16,
  kInt32,
  kInt64,
  kByte,
  kBoolean,
  kFloat,
  kDouble,
  kString,
  kStruct
};

struct MessageSchema;

/// @brief Length of an array: a number, or the field of the same struct that holds the count.
struct ArrayLength {
  std::string text;  // as written, part of the fingerprint
  bool is_constant = true;
  std::size_t length = 0;       // when constant
  std::size_t count_field = 0;  // index into MessageSchema::fields otherwise
};

struct Field {
  std::string name;
  std::string type_name;  // as written; structs with their package
  FieldType type = FieldType::kStruct;
  const MessageSchema* nested = nullptr;  // of kStruct
  std::optional<ArrayLength> array;       // absent: one value
};

/// @brief The layout of one LCM struct.
struct MessageSchema {
  std::string name;  // "package.struct_t"
  std::vector<Field> fields;
  std::int64_t fingerprint = 0;   // what an encoded message of this type starts with
  std::size_t smallest_size = 0;  // bytes of one with empty arrays and strings, without fingerprint
};

/// @brief Most fields a struct may have.
inline constexpr std::size_t kMaxFields = 32;

/// @brief Every encoded message begins with the fingerprint of its type [byte].
inline constexpr std::size_t kFingerprintSize = 8;

/// @brief What an encoded message begins with; nothing when it is too short.
std::optional<std::int64_t> fingerprint_of(std::span<const std::uint8_t> message);

/// @brief Encoded size of one value [byte]; of a string the smallest one, 0 for a struct.
std::size_t encoded_size(FieldType type);

/// @brief The layouts written in some .lcm files, by name; types may be used before they are
/// defined.
/// @throws std::invalid_argument, with the reason, for text that is not LCM's grammar as used here
/// (packages, structs, constants, comments, arrays of one dimension), names an unknown type, or
/// makes a type part of itself.
class SchemaRegistry {
 public:
  explicit SchemaRegistry(const std::string& lcm_text);
  SchemaRegistry(const SchemaRegistry&) = delete;
  SchemaRegistry& operator=(const SchemaRegistry&) = delete;

  /// @brief All layouts, by "package.struct_t".
  const std::map<std::string, MessageSchema>& all() const { return by_name_; }
  /// @brief The layout with this fingerprint; nullptr when there is none.
  const MessageSchema* find(std::int64_t fingerprint) const;

 private:
  std::map<std::string, MessageSchema> by_name_;
  std::map<std::int64_t, const MessageSchema*> by_fingerprint_;
};

/// @brief The layouts of lcmtypes/*.lcm, whose text is part of this library: what safe_decode
/// checks against and what a text spy decodes with, always in step with the generated types.
const SchemaRegistry& known_schemas();

}  // namespace geomap::messaging
