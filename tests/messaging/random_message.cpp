// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/random_message.hpp"

#include <Eigen/Geometry>
#include <array>
#include <bit>

namespace geomap::testing {
namespace {

using messaging::Field;
using messaging::FieldType;
using messaging::MessageSchema;

class Generator {
 public:
  Generator(std::mt19937& random, bool full) : random_(random), full_(full) {}

  void append_struct(const MessageSchema& schema) {
    // An array's count comes before it: all lengths are drawn first.
    std::vector<std::uint64_t> counts(schema.fields.size());
    std::vector<bool> is_count(schema.fields.size(), false);
    for (const Field& field : schema.fields) {
      if (!field.array || field.array->is_constant || is_count[field.array->count_field]) continue;
      is_count[field.array->count_field] = true;
      counts[field.array->count_field] = full_ ? 1 + random_() % 2 : random_() % 4;
    }
    for (std::size_t i = 0; i < schema.fields.size(); ++i) {
      const Field& field = schema.fields[i];
      if (is_count[i]) {
        const std::size_t size = messaging::encoded_size(field.type);
        result_.counts.push_back({result_.bytes.size(), size});
        append_number(counts[i], size);
      } else {
        append_field(field, counts);
      }
    }
  }

  void append_number(std::uint64_t value, std::size_t size) {
    result_.bytes.resize(result_.bytes.size() + size);
    write_number(result_.bytes, {result_.bytes.size() - size, size}, value);
  }

  RandomMessage take() { return std::move(result_); }

 private:
  void append_field(const Field& field, const std::vector<std::uint64_t>& counts) {
    std::uint64_t count = 1;
    if (field.array) {
      count = field.array->is_constant ? field.array->length : counts[field.array->count_field];
    }
    if (field.type == FieldType::kDouble) return append_doubles(field.name, count);
    for (std::uint64_t i = 0; i < count; ++i) {
      if (field.type == FieldType::kStruct) {
        append_struct(*field.nested);
      } else if (field.type == FieldType::kString) {
        append_string();
      } else if (field.type == FieldType::kBoolean) {
        append_number(random_() % 2, 1);
      } else {
        append_number(random_(), messaging::encoded_size(field.type));
      }
    }
  }

  void append_string() {
    const std::size_t length = random_() % 6;
    result_.counts.push_back({result_.bytes.size(), 4});
    append_number(length + 1, 4);
    for (std::size_t i = 0; i < length; ++i) append_number('a' + random_() % 26, 1);
    append_number(0, 1);
  }

  void append_doubles(const std::string& name, std::uint64_t count) {
    std::vector<double> values(count);
    std::normal_distribution<double> normal;
    for (double& value : values) value = normal(random_);
    if (name == "quat" || name == "orientation" || name == "normal" || name == "x_axis") {
      Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(count)).normalize();
    } else if (name == "rotation") {
      const Eigen::Quaterniond q(values[0], values[1], values[2], values[3]);
      Eigen::Map<Eigen::Matrix3d>(values.data()) = q.normalized().toRotationMatrix();
    }
    for (const double value : values) {
      result_.doubles.push_back({result_.bytes.size(), 8});
      append_number(std::bit_cast<std::uint64_t>(value), 8);
    }
  }

  std::mt19937& random_;
  bool full_;
  RandomMessage result_;
};

}  // namespace

RandomMessage random_message(const MessageSchema& schema, std::mt19937& random, bool full) {
  Generator generator(random, full);
  generator.append_number(static_cast<std::uint64_t>(schema.fingerprint), 8);
  generator.append_struct(schema);
  return generator.take();
}

void write_number(std::vector<std::uint8_t>& bytes, RandomMessage::Place place,
                  std::uint64_t value) {
  for (std::size_t i = 0; i < place.size; ++i) {
    bytes[place.offset + place.size - 1 - i] = static_cast<std::uint8_t>(value >> (8 * i));
  }
}

}  // namespace geomap::testing
