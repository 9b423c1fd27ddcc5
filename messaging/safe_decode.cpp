// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/safe_decode.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "messaging/big_endian.hpp"
#include "messaging/message_schema.hpp"

namespace geomap::messaging {
namespace {

constexpr std::size_t kMebibyte = std::size_t{1} << 20;

/// How far a quaternion of somebody else's single-precision arithmetic may be off.
constexpr double kQuaternionTolerance = 1e-2;
/// Our own unit vectors and rotations are good to rounding.
constexpr double kUnitTolerance = 1e-6;

/// What a message of a type may need at most [byte].
std::size_t largest_size(const MessageSchema& schema) {
  static const std::map<std::string, std::size_t> kLarge = {
      {"bot_core.image_t", 64 * kMebibyte},        {"bot_core.images_t", 64 * kMebibyte},
      {"kinect.frame_msg_t", 64 * kMebibyte},      {"kinect.image_msg_t", 64 * kMebibyte},
      {"kinect.depth_msg_t", 64 * kMebibyte},      {"geomap.rgbd_frame_t", 64 * kMebibyte},
      {"geomap.keyframe_t", 64 * kMebibyte},       {"geomap.point_map_update_t", 256 * kMebibyte},
      {"geomap.plane_set_t", 8 * kMebibyte},       {"geomap.map_event_t", 64 * kMebibyte},
      {"geomap.map_edit_record_t", 8 * kMebibyte}, {"geomap.keyframe_update_t", 16 * kMebibyte},
      {"geomap.map_delta_t", 32 * kMebibyte},      {"geomap.map_t", 32 * kMebibyte},
      {"geomap.map_state_t", 1024 * kMebibyte},
  };
  const auto found = kLarge.find(schema.name);
  return found == kLarge.end() ? kMebibyte : found->second;
}

/// Unit length of what is a direction or a rotation by its name and number of elements.
bool is_normalised(const Field& field, std::size_t count, const std::uint8_t* bytes) {
  std::array<double, 9> values{};
  if (count > values.size()) return true;
  for (std::size_t i = 0; i < count; ++i) values[i] = read_double(bytes + 8 * i);
  if (count == 4 && (field.name == "quat" || field.name == "orientation")) {
    const double norm = Eigen::Map<const Eigen::Vector4d>(values.data()).norm();
    return std::abs(norm - 1.0) <= kQuaternionTolerance;
  }
  if (count == 3 && (field.name == "normal" || field.name == "x_axis")) {
    const double norm = Eigen::Map<const Eigen::Vector3d>(values.data()).norm();
    return std::abs(norm - 1.0) <= kUnitTolerance;
  }
  if (count == 9 && field.name == "rotation") {
    const Eigen::Map<const Eigen::Matrix3d> rotation(values.data());
    const Eigen::Matrix3d error = rotation * rotation.transpose() - Eigen::Matrix3d::Identity();
    return error.cwiseAbs().maxCoeff() <= kUnitTolerance && rotation.determinant() > 0.0;
  }
  return true;
}

/// Steps over the bytes of a message as its layout says, and checks what it passes.
class MessageWalker {
 public:
  MessageWalker(const std::uint8_t* data, std::size_t size, std::size_t largest)
      : data_(data), size_(size), largest_(largest) {}

  RejectReason walk(const MessageSchema& schema) {
    std::array<std::int64_t, kMaxFields> counts{};
    for (std::size_t i = 0; i < schema.fields.size(); ++i) {
      const Field& field = schema.fields[i];
      std::size_t count = 1;
      if (field.array && field.array->is_constant) {
        count = field.array->length;
      } else if (field.array) {
        const std::int64_t claimed = counts[field.array->count_field];
        if (claimed < 0 || static_cast<std::uint64_t>(claimed) > largest_ / smallest_size(field)) {
          return RejectReason::kBadCount;
        }
        count = static_cast<std::size_t>(claimed);
      }
      if (count * smallest_size(field) > size_ - position_) return RejectReason::kTruncated;
      if (!field.array && field.type <= FieldType::kInt64) {
        counts[i] = read_signed(data_ + position_, encoded_size(field.type));
      }
      const RejectReason reason = pass(field, count);
      if (reason != RejectReason::kNone) return reason;
    }
    return RejectReason::kNone;
  }

  bool at_end() const { return position_ == size_; }

 private:
  /// At least 1, so that every element of an array is paid for by a byte of the message.
  static std::size_t smallest_size(const Field& field) {
    const std::size_t size = field.nested ? field.nested->smallest_size : encoded_size(field.type);
    return std::max<std::size_t>(size, 1);
  }

  RejectReason pass(const Field& field, std::size_t count) {
    switch (field.type) {
      case FieldType::kStruct:
        for (std::size_t i = 0; i < count; ++i) {
          const RejectReason reason = walk(*field.nested);
          if (reason != RejectReason::kNone) return reason;
        }
        return RejectReason::kNone;
      case FieldType::kString:
        for (std::size_t i = 0; i < count; ++i) {
          const RejectReason reason = pass_string();
          if (reason != RejectReason::kNone) return reason;
        }
        return RejectReason::kNone;
      case FieldType::kDouble:
        return pass_doubles(field, count);
      case FieldType::kFloat:
        return pass_floats(count);
      default:
        position_ += count * encoded_size(field.type);
        return RejectReason::kNone;
    }
  }

  RejectReason pass_string() {
    if (size_ - position_ < 4) return RejectReason::kTruncated;
    const std::int64_t length = read_signed(data_ + position_, 4);
    position_ += 4;
    if (length < 1 || static_cast<std::uint64_t>(length) > largest_) return RejectReason::kBadCount;
    if (static_cast<std::size_t>(length) > size_ - position_) return RejectReason::kTruncated;
    position_ += static_cast<std::size_t>(length);
    return data_[position_ - 1] == 0 ? RejectReason::kNone : RejectReason::kBadString;
  }

  RejectReason pass_doubles(const Field& field, std::size_t count) {
    const std::uint8_t* first = data_ + position_;
    for (std::size_t i = 0; i < count; ++i) {
      if (!std::isfinite(read_double(first + 8 * i))) return RejectReason::kNotFinite;
    }
    position_ += 8 * count;
    return is_normalised(field, count, first) ? RejectReason::kNone : RejectReason::kNotUnit;
  }

  RejectReason pass_floats(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i, position_ += 4) {
      if (!std::isfinite(read_float(data_ + position_))) return RejectReason::kNotFinite;
    }
    return RejectReason::kNone;
  }

  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t largest_;
  std::size_t position_ = kFingerprintSize;
};

}  // namespace

RejectReason check_message(const void* data, std::size_t size, std::int64_t fingerprint) {
  const MessageSchema* schema = known_schemas().find(fingerprint);
  if (schema == nullptr) throw std::logic_error("safe_decode: not a type of lcmtypes/");

  const auto* bytes = static_cast<const std::uint8_t*>(data);
  const std::optional<std::int64_t> claimed = fingerprint_of({bytes, size});
  if (!claimed) return RejectReason::kTooShort;
  if (*claimed != fingerprint) return RejectReason::kWrongType;
  const std::size_t largest = largest_size(*schema);
  if (size > largest) return RejectReason::kTooLarge;

  MessageWalker walker(bytes, size, largest);
  const RejectReason reason = walker.walk(*schema);
  if (reason != RejectReason::kNone) return reason;
  return walker.at_end() ? RejectReason::kNone : RejectReason::kTrailing;
}

std::string to_string(RejectReason reason) {
  switch (reason) {
    case RejectReason::kNone:
      return "none";
    case RejectReason::kTooShort:
      return "too_short";
    case RejectReason::kWrongType:
      return "wrong_type";
    case RejectReason::kTooLarge:
      return "too_large";
    case RejectReason::kBadCount:
      return "bad_count";
    case RejectReason::kTruncated:
      return "truncated";
    case RejectReason::kTrailing:
      return "trailing";
    case RejectReason::kBadString:
      return "bad_string";
    case RejectReason::kNotFinite:
      return "not_finite";
    case RejectReason::kNotUnit:
      return "not_unit";
    case RejectReason::kUndecodable:
      return "undecodable";
  }
  return "unknown";
}

}  // namespace geomap::messaging
