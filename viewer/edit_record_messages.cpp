// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/edit_record_messages.hpp"

#include <algorithm>
#include <utility>

#include "mapping/clean_text.hpp"
#include "mapping/map_messages.hpp"
#include "messaging/convert_geometry.hpp"
#include "viewer/sound_geometry.hpp"

namespace geomap::viewer {
namespace {

using Message = geomap::map_edit_record_t;
using mapping::clean_text;
using namespace std::chrono_literals;

constexpr auto kMapperSilence = 10s;  // of a mapper, after which an older epoch is believed
constexpr std::size_t kMostRecords = 100'000;

HistoryEntry::State state_of(std::int8_t state) {
  switch (state) {
    case Message::UNDONE:
      return HistoryEntry::State::kUndone;
    case Message::REVOKED:
      return HistoryEntry::State::kRevoked;
    case Message::IDLE:
      return HistoryEntry::State::kIdle;
    default:
      return HistoryEntry::State::kDone;
  }
}

bool is_plausible(const Message& message) {
  return message.number >= 0 && message.count >= 0 &&
         message.count <= static_cast<std::int32_t>(kMostRecords) && message.kind >= 0 &&
         message.kind <= static_cast<std::int8_t>(mapping::kLastEditKind) &&
         message.state >= Message::DONE && message.state <= Message::IDLE;
}

// Nothing when its surface is not sound.
std::optional<mapping::Veto> veto_of(const geomap::veto_t& message, std::int64_t edit) {
  mapping::Veto veto;
  veto.edit = edit;
  veto.cause = message.held != 0 ? mapping::VetoCause::kObserved : mapping::VetoCause::kDeleted;
  veto.feature.id = mapping::from_message(message.id);
  veto.feature.observations = {veto.feature.id};
  geometry::PlanarPolygon& surface = veto.feature.surface;
  surface.frame = messaging::from_message(message.frame);
  surface.plane = surface.frame.plane();
  surface.polygon = messaging::from_message(message.polygon);
  if (!is_sound(surface)) return std::nullopt;
  veto.region = surface.polygon;
  return veto;
}

}  // namespace

HistoryEntry entry_of(const Message& record) {
  HistoryEntry entry;
  entry.number = record.number;
  entry.utime = record.edit_utime;
  entry.author = clean_text(record.author);
  entry.text = clean_text(record.text);
  entry.kind = static_cast<mapping::EditKind>(record.kind);
  entry.state = state_of(record.state);
  entry.reason = clean_text(record.reason);
  entry.keeps_out = record.state == Message::DONE &&
                    std::any_of(record.vetoes.begin(), record.vetoes.end(),
                                [](const geomap::veto_t& veto) { return veto.held == 0; });
  return entry;
}

std::optional<EditRecords::Record> EditRecords::read(const Message& message) {
  Record record{entry_of(message), {}};
  for (const geomap::veto_t& veto_message : message.vetoes) {
    auto veto = veto_of(veto_message, message.number);
    if (!veto) return std::nullopt;
    if (message.state == Message::DONE) record.vetoes.push_back(std::move(*veto));
  }
  return record;
}

Taken EditRecords::take(const Message& message, Clock::time_point now) {
  const bool is_former = shown_ && message.epoch < shown_->epoch && now - heard_ < kMapperSilence;
  if (!is_plausible(message) || is_former) return Taken::kRefused;
  auto record = read(message);
  if (!record) return Taken::kRefused;
  heard_ = now;
  Collection& collection = collection_for(message);
  collection.count = static_cast<std::size_t>(message.count);
  if (message.number > 0) collection.records.insert_or_assign(message.number, std::move(*record));
  if (collection.records.size() > collection.count) {
    // Some of these are gone, and it is not known which: everything is collected anew.
    Collection fresh{message.epoch, collection.count, {}};
    const auto newest = collection.records.find(message.number);
    if (newest != collection.records.end() && fresh.count > 0) fresh.records.insert(*newest);
    coming_ = std::move(fresh);
  }
  if (coming_ && coming_->records.size() == coming_->count) {
    shown_ = std::move(*coming_);
    coming_.reset();
  }
  if (!coming_) has_news_ = true;
  return Taken::kNothing;
}

EditRecords::Collection& EditRecords::collection_for(const Message& message) {
  if (!shown_) shown_ = Collection{message.epoch, 0, {}};
  if (!coming_ && shown_->epoch == message.epoch) return *shown_;
  if (!coming_ || coming_->epoch != message.epoch) coming_ = Collection{message.epoch, 0, {}};
  return *coming_;
}

bool EditRecords::show() {
  if (!std::exchange(has_news_, false)) return false;
  history_.clear();
  vetoes_.clear();
  for (const auto& [number, record] : shown_->records) {
    history_.push_back(record.entry);
    vetoes_.insert(vetoes_.end(), record.vetoes.begin(), record.vetoes.end());
  }
  return true;
}

bool EditRecords::is_whole(std::int64_t epoch) const {
  return !coming_ && shown_ && shown_->epoch == epoch && shown_->records.size() == shown_->count;
}

}  // namespace geomap::viewer
