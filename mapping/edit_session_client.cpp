// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/edit_session_client.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <stdexcept>
#include <utility>

#include "geomap/map_request_t.hpp"
#include "mapping/edit_messages.hpp"
#include "mapping/map_client.hpp"
#include "mapping/map_journal.hpp"
#include "messaging/bus.hpp"
#include "messaging/channels.hpp"
#include "messaging/program.hpp"
#include "messaging/safe_decode.hpp"

namespace geomap::mapping {
namespace {

namespace channels = messaging::channels;
using Clock = MapClient::Clock;
using namespace std::chrono_literals;

constexpr auto kAgain = 500ms;  // between two tries to be heard

class FileSession : public EditSession {
 public:
  FileSession(const std::filesystem::path& map, std::filesystem::path out)
      : map_(load_map(map)), out_(std::move(out)) {}

  std::map<FeatureId, ViewFeature> features() override {
    std::map<FeatureId, ViewFeature> features;
    for (const auto& [id, feature] : map_.features()) features.emplace(id, quantised(*feature));
    return features;
  }

  std::vector<geomap::map_edit_record_t> history() override {
    std::vector<geomap::map_edit_record_t> records;
    for (const auto& [number, entry] : map_.history().edits().entries()) {
      records.push_back(record_of(entry, map_));
    }
    return records;
  }

  geomap::map_edit_reply_t edit(const EditCommand& command, bool is_dry_run) override {
    std::optional<GeometricMap> trial;
    GeometricMap& map = is_dry_run ? trial.emplace(map_) : map_;
    geomap::map_edit_reply_t reply = reply_to(command, map.edit(command), is_dry_run, map);
    if (!is_dry_run && reply.done != 0) save_map(out_, map_);
    return reply;
  }

 private:
  GeometricMap map_;
  std::filesystem::path out_;
};

class LiveSession : public EditSession {
 public:
  LiveSession(const std::string& url, const std::string& prefix, double patience)
      : bus_({.url = url, .channel_prefix = prefix}),
        patience_(
            std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(patience))),
        client_([this] { request(channels::kMapSnapshot); }) {
    for (const char* channel : {channels::kMapDelta, channels::kMapSnapshot,
                                channels::kMapEditReply, channels::kMapEditRecord}) {
      bus_.subscribe(channel, messaging::Keep::kEvery);
    }
    bus_.start();
  }

  std::map<FeatureId, ViewFeature> features() override {
    const bool is_there = wait([] {}, [this] { return client_.is_current(); });
    if (!is_there) fail();
    return client_.view().features;
  }

  std::vector<geomap::map_edit_record_t> history() override {
    features();
    records_.clear();
    count_.reset();
    const bool is_whole = wait([this] { request(channels::kMapEditRecord); },
                               [this] { return count_ && *count_ <= records_.size(); });
    if (!is_whole) fail();
    std::vector<geomap::map_edit_record_t> records;
    for (const auto& [number, record] : records_) records.push_back(record);
    return records;
  }

  geomap::map_edit_reply_t edit(const EditCommand& command, bool is_dry_run) override {
    geomap::map_edit_t message = to_message(command);
    message.dry_run = is_dry_run ? 1 : 0;
    message.epoch = client_.view().epoch;
    message.seen_utime = client_.view().utime;
    reply_.reset();
    awaited_ = {command.author, command.command};
    const bool is_answered = wait([&] { bus_.publish(channels::kMapEdit, message); },
                                  [this] { return reply_.has_value(); });
    if (!is_answered) fail();
    return std::move(*reply_);
  }

 private:
  [[noreturn]] void fail() const {
    throw std::runtime_error("no geomap-mapper answers at " + bus_.config().url +
                             ": is one running there? (geomap-doctor looks at the network)");
  }

  void request(const char* channel) {
    geomap::map_request_t request{};
    request.kind = geomap::map_request_t::SNAPSHOT;
    request.author = "geomap-edit";
    request.name = channel;
    bus_.publish(channels::kMapRequest, request);
  }

  // Asks again and again until it is done, or patience is at its end.
  bool wait(const std::function<void()>& ask, const std::function<bool()>& is_done) {
    const Clock::time_point end = Clock::now() + patience_;
    Clock::time_point next = Clock::now();
    while (!is_done()) {
      const Clock::time_point now = Clock::now();
      if (now >= end || messaging::stop_requested()) return false;
      if (now >= next) {
        ask();
        next = now + kAgain;
      }
      if (const auto message = bus_.take(std::min(end, now + 50ms))) take(*message);
      client_.poll(Clock::now());
    }
    return true;
  }

  void take(const messaging::Received& received) {
    if (received.channel == channels::kMapDelta) {
      if (auto delta = decode<geomap::map_delta_t>(received)) client_.take(*delta, Clock::now());
    } else if (received.channel == channels::kMapSnapshot) {
      if (auto map = decode<geomap::map_t>(received)) client_.take(*map, Clock::now());
    } else if (received.channel == channels::kMapEditRecord) {
      auto record = decode<geomap::map_edit_record_t>(received);
      if (!record || record->epoch != client_.view().epoch) return;
      count_ = static_cast<std::size_t>(std::max(0, record->count));
      if (record->number > 0) records_.insert_or_assign(record->number, std::move(*record));
    } else if (received.channel == channels::kMapEditReply) {
      auto reply = decode<geomap::map_edit_reply_t>(received);
      if (reply && std::pair(reply->author, reply->command) == awaited_) {
        reply_ = std::move(*reply);
      }
    }
  }

  template <class Message>
  static std::optional<Message> decode(const messaging::Received& received) {
    return messaging::safe_decode<Message>(received.data.data(), received.data.size()).message;
  }

  messaging::Bus bus_;
  Clock::duration patience_;
  MapClient client_;
  std::map<std::int64_t, geomap::map_edit_record_t> records_;
  std::optional<std::size_t> count_;  // of records that there are
  std::pair<std::string, std::int64_t> awaited_;
  std::optional<geomap::map_edit_reply_t> reply_;
};

}  // namespace

std::unique_ptr<EditSession> edit_file(const std::filesystem::path& map,
                                       const std::filesystem::path& out) {
  return std::make_unique<FileSession>(map, out);
}

std::unique_ptr<EditSession> edit_live(const std::string& url, const std::string& channel_prefix,
                                       double patience) {
  return std::make_unique<LiveSession>(url, channel_prefix, patience);
}

}  // namespace geomap::mapping
