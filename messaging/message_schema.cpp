// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/message_schema.hpp"

#include <stdexcept>
#include <utility>

#include "messaging/big_endian.hpp"
#include "messaging/embedded_text.hpp"
#include "messaging/schema_parser.hpp"

namespace geomap::messaging {
namespace {

/// LCM's fingerprint of one struct, as lcm-gen computes it: members in order with the names of
/// primitive types and the array lengths as written.
class Fingerprint {
 public:
  void add(char value) {
    const auto shifted = static_cast<std::uint64_t>(static_cast<std::int64_t>(value_) >> 55);
    value_ = ((value_ << 8) ^ shifted) + static_cast<std::uint64_t>(value);
  }
  void add(const std::string& text) {
    add(static_cast<char>(text.size()));
    for (const char c : text) add(c);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0x12345678;
};

std::uint64_t own_fingerprint(const MessageSchema& schema) {
  Fingerprint fingerprint;
  for (const Field& field : schema.fields) {
    fingerprint.add(field.name);
    if (field.type != FieldType::kStruct) fingerprint.add(field.type_name);
    fingerprint.add(static_cast<char>(field.array ? 1 : 0));
    if (field.array) {
      fingerprint.add(static_cast<char>(field.array->is_constant ? 0 : 1));
      fingerprint.add(field.array->text);
    }
  }
  return fingerprint.value();
}

/// Fills in nested types first, then the struct's own fingerprint and size.
class Linker {
 public:
  explicit Linker(std::map<std::string, MessageSchema>& by_name) : by_name_(by_name) {}

  void link(MessageSchema& schema) {
    if (schema.fingerprint != 0) return;
    if (++depth_ > by_name_.size()) {
      throw std::invalid_argument("message types: '" + schema.name + "' is part of itself");
    }
    std::uint64_t hash = own_fingerprint(schema);
    for (Field& field : schema.fields) {
      std::size_t size = encoded_size(field.type);
      if (field.type == FieldType::kStruct) {
        const MessageSchema& nested = linked(field.type_name);
        field.nested = &nested;
        hash += static_cast<std::uint64_t>(nested.fingerprint);
        size = nested.smallest_size;
      }
      if (field.array) size *= field.array->is_constant ? field.array->length : 0;
      schema.smallest_size += size;
    }
    schema.fingerprint = static_cast<std::int64_t>((hash << 1) + (hash >> 63));
    --depth_;
  }

 private:
  const MessageSchema& linked(const std::string& name) {
    const auto found = by_name_.find(name);
    if (found == by_name_.end()) {
      throw std::invalid_argument("message types: unknown type '" + name + "'");
    }
    link(found->second);
    return found->second;
  }

  std::map<std::string, MessageSchema>& by_name_;
  std::size_t depth_ = 0;
};

}  // namespace

std::optional<std::int64_t> fingerprint_of(std::span<const std::uint8_t> message) {
  if (message.size() < kFingerprintSize) return std::nullopt;
  return static_cast<std::int64_t>(read_unsigned(message.data(), kFingerprintSize));
}

std::size_t encoded_size(FieldType type) {
  switch (type) {
    case FieldType::kInt8:
    case FieldType::kByte:
    case FieldType::kBoolean:
      return 1;
    case FieldType::kInt16:
      return 2;
    case FieldType::kInt32:
    case FieldType::kFloat:
      return 4;
    case FieldType::kInt64:
    case FieldType::kDouble:
      return 8;
    case FieldType::kString:
      return 5;  // the length, and the terminating zero
    case FieldType::kStruct:
      return 0;
  }
  return 0;
}

SchemaRegistry::SchemaRegistry(const std::string& lcm_text) {
  for (MessageSchema& schema : parse_lcm(lcm_text)) {
    const std::string name = schema.name;
    if (!by_name_.emplace(name, std::move(schema)).second) {
      throw std::invalid_argument("message types: '" + name + "' is defined twice");
    }
  }
  Linker linker(by_name_);
  for (auto& [name, schema] : by_name_) {
    linker.link(schema);
    by_fingerprint_.emplace(schema.fingerprint, &schema);
  }
}

const MessageSchema* SchemaRegistry::find(std::int64_t fingerprint) const {
  const auto found = by_fingerprint_.find(fingerprint);
  return found == by_fingerprint_.end() ? nullptr : found->second;
}

const SchemaRegistry& known_schemas() {
  static const SchemaRegistry registry(kLcmText);
  return registry;
}

}  // namespace geomap::messaging
