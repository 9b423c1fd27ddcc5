// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map_view_messages.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "mapping/map_messages.hpp"
#include "mapping/outline_code.hpp"

namespace geomap::mapping {
namespace {

constexpr std::size_t kLeastPiece = 64;  // of an outline; below, another part is begun [byte]

geomap::map_feature_t without_outline(const ViewFeature& feature) {
  geomap::map_feature_t message{};
  message.id = to_message(feature.id);
  std::copy(feature.origin.begin(), feature.origin.end(), message.origin);
  std::copy(feature.normal.begin(), feature.normal.end(), message.normal_ppm);
  std::copy(feature.x_axis.begin(), feature.x_axis.end(), message.x_axis);
  message.observations = feature.observations;
  message.rms = feature.rms;
  message.sigma_angle = feature.sigma_angle;
  message.sigma_d = feature.sigma_d;
  std::copy(feature.color.begin(), feature.color.end(), message.color);
  message.locked = static_cast<std::int8_t>(feature.locked);
  message.label = feature.label;
  return message;
}

const geometry::Polygon& polygon_in(const MapView& view, const FeatureId& id) {
  static const geometry::Polygon kNone;
  const auto found = view.features.find(id);
  return found == view.features.end() ? kNone : found->second.polygon;
}

std::optional<ViewFeature> with_outline(const geomap::map_feature_t& message,
                                        const std::vector<std::uint8_t>& outline,
                                        const MapView& before) {
  ViewFeature feature;
  feature.id = from_message(message.id);
  std::copy(std::begin(message.origin), std::end(message.origin), feature.origin.begin());
  std::copy(std::begin(message.normal_ppm), std::end(message.normal_ppm), feature.normal.begin());
  std::copy(std::begin(message.x_axis), std::end(message.x_axis), feature.x_axis.begin());
  feature.observations = message.observations;
  feature.rms = message.rms;
  feature.sigma_angle = message.sigma_angle;
  feature.sigma_d = message.sigma_d;
  std::copy(std::begin(message.color), std::end(message.color), feature.color.begin());
  feature.locked = message.locked != 0;
  feature.label = message.label;
  auto polygon = decode_outline(outline, polygon_in(before, feature.id));
  if (!polygon || !is_sound(feature)) return std::nullopt;
  feature.polygon = std::move(*polygon);
  return feature;
}

// The features of all parts, pieces of one outline joined.
template <class Message>
std::optional<std::vector<ViewFeature>> features_of(
    const std::vector<Message>& parts, std::vector<geomap::map_feature_t> Message::*list,
    const MapView& before) {
  std::vector<ViewFeature> features;
  const geomap::map_feature_t* open = nullptr;
  std::vector<std::uint8_t> outline;
  const auto close = [&] {
    if (open == nullptr) return true;
    auto feature = with_outline(*open, outline, before);
    if (!feature || (!features.empty() && feature->id <= features.back().id)) return false;
    features.push_back(std::move(*feature));
    outline.clear();
    return true;
  };
  for (const Message& part : parts) {
    for (const geomap::map_feature_t& entry : part.*list) {
      const bool goes_on = open != nullptr && from_message(open->id) == from_message(entry.id);
      if (!goes_on && !close()) return std::nullopt;
      open = &entry;
      outline.insert(outline.end(), entry.outline.begin(), entry.outline.end());
    }
  }
  if (!close()) return std::nullopt;
  return features;
}

template <class Message>
bool belong_together(const std::vector<Message>& parts) {
  const auto count = static_cast<std::int32_t>(parts.size());
  for (std::int32_t i = 0; i < count; ++i) {
    const Message& part = parts[static_cast<std::size_t>(i)];
    const bool fits = part.part == i && part.parts == count && part.epoch == parts[0].epoch &&
                      part.revision == parts[0].revision && part.utime == parts[0].utime;
    if (!fits) return false;
  }
  return count > 0;
}

void set_counts(geomap::map_delta_t& message) {
  message.n_changed = static_cast<std::int32_t>(message.changed.size());
  message.n_removed = static_cast<std::int32_t>(message.removed.size());
  message.n_absorbed = static_cast<std::int32_t>(message.absorbed.size());
}

void set_counts(geomap::map_t& message) {
  message.n_features = static_cast<std::int32_t>(message.features.size());
}

// Fills one message after the other.
template <class Message>
class Packer {
 public:
  // `blank` holds what all parts have in common.
  explicit Packer(Message blank) : blank_(std::move(blank)) { begin_part(); }

  template <class Entry>
  void add(std::vector<Entry> Message::*list, Entry entry) {
    const auto bytes = static_cast<std::size_t>(entry._getEncodedSizeNoHash());
    if (bytes > room_ && !is_part_empty_) begin_part();
    (parts_.back().*list).push_back(std::move(entry));
    room_ -= std::min(room_, bytes);
    is_part_empty_ = false;
  }

  void add(std::vector<geomap::map_feature_t> Message::*list, const ViewFeature& feature,
           const MapView& before) {
    const geomap::map_feature_t blank = without_outline(feature);
    const auto blank_bytes = static_cast<std::size_t>(blank._getEncodedSizeNoHash());
    const std::vector<std::uint8_t> outline =
        encode_outline(feature.polygon, polygon_in(before, feature.id));
    for (auto at = outline.begin(); at != outline.end();) {
      const auto rest = static_cast<std::size_t>(outline.end() - at);
      if (room_ < blank_bytes + std::min(rest, kLeastPiece)) begin_part();
      const std::size_t room = std::max(room_, blank_bytes + kLeastPiece) - blank_bytes;
      geomap::map_feature_t entry = blank;
      const auto end = at + static_cast<std::ptrdiff_t>(std::min(rest, room));
      entry.outline.assign(at, end);
      entry.n_outline = static_cast<std::int32_t>(entry.outline.size());
      add(list, std::move(entry));
      at = end;
    }
  }

  std::vector<Message> take() {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      parts_[i].part = static_cast<std::int32_t>(i);
      parts_[i].parts = static_cast<std::int32_t>(parts_.size());
      set_counts(parts_[i]);
    }
    return std::move(parts_);
  }

 private:
  void begin_part() {
    parts_.push_back(blank_);
    room_ = kMostViewMessageBytes - static_cast<std::size_t>(blank_.getEncodedSize());
    is_part_empty_ = true;
  }

  Message blank_;
  std::vector<Message> parts_;
  std::size_t room_ = 0;  // in the last part [byte]
  bool is_part_empty_ = true;
};

}  // namespace

std::vector<geomap::map_delta_t> to_messages(const ViewDelta& delta, const MapView& before) {
  using Message = geomap::map_delta_t;
  Message blank{};
  blank.utime = delta.utime;
  blank.epoch = delta.epoch;
  blank.revision = delta.revision;
  blank.cause = static_cast<std::int8_t>(delta.cause);
  Packer<Message> packer(std::move(blank));
  for (const ViewFeature& feature : delta.changed) {
    packer.add(&Message::changed, feature, before);
  }
  for (const FeatureId& id : delta.removed) packer.add(&Message::removed, to_message(id));
  for (const auto& [id, survivor] : delta.absorbed) {
    packer.add(&Message::absorbed,
               geomap::absorbed_feature_t{to_message(id), to_message(survivor)});
  }
  return packer.take();
}

std::vector<geomap::map_t> to_messages(const MapView& view) {
  using Message = geomap::map_t;
  Message blank{};
  blank.utime = view.utime;
  blank.epoch = view.epoch;
  blank.revision = view.revision;
  blank.view_hash = view_hash(view);
  Packer<Message> packer(std::move(blank));
  for (const auto& [id, feature] : view.features) packer.add(&Message::features, feature, {});
  return packer.take();
}

std::optional<ViewDelta> from_messages(const std::vector<geomap::map_delta_t>& parts,
                                       const MapView& before) {
  if (!belong_together(parts)) return std::nullopt;
  const std::int8_t cause = parts[0].cause;
  if (cause < 0 || cause > static_cast<std::int8_t>(kLastViewCause)) return std::nullopt;
  auto changed = features_of(parts, &geomap::map_delta_t::changed, before);
  if (!changed) return std::nullopt;
  ViewDelta delta;
  delta.utime = parts[0].utime;
  delta.epoch = parts[0].epoch;
  delta.revision = parts[0].revision;
  delta.cause = static_cast<ViewCause>(cause);
  delta.changed = std::move(*changed);
  for (const geomap::map_delta_t& part : parts) {
    for (const geomap::observation_id_t& id : part.removed) delta.removed.insert(from_message(id));
    for (const geomap::absorbed_feature_t& gone : part.absorbed) {
      delta.absorbed.emplace(from_message(gone.id), from_message(gone.into));
    }
  }
  return delta;
}

std::optional<MapView> from_messages(const std::vector<geomap::map_t>& parts) {
  if (!belong_together(parts)) return std::nullopt;
  auto features = features_of(parts, &geomap::map_t::features, {});
  if (!features) return std::nullopt;
  MapView view{parts[0].utime, parts[0].epoch, parts[0].revision, {}};
  for (ViewFeature& feature : *features) {
    const FeatureId id = feature.id;
    view.features.emplace(id, std::move(feature));
  }
  if (view_hash(view) != parts[0].view_hash) return std::nullopt;
  return view;
}

}  // namespace geomap::mapping
