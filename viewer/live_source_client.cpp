// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/live_source_client.hpp"

#include <stdexcept>
#include <string_view>

#include "geomap/map_request_t.hpp"
#include "mapping/edit_messages.hpp"
#include "mapping/local_time.hpp"
#include "mapping/operator_name.hpp"
#include "messaging/channels.hpp"
#include "viewer/awaited_replies_client.hpp"
#include "viewer/scene_messages.hpp"
#include "viewer/view_snapshot.hpp"

namespace geomap::viewer {
namespace {

namespace channels = messaging::channels;
using geomap::map_request_t;
using messaging::Keep;
using namespace std::chrono_literals;

constexpr auto kMostWork = 15ms;  // of one update
constexpr auto kSilence = 3s;     // after which anything may have happened
constexpr Clock::duration kEditPeriod = 500ms, kSavePeriod = 2s;  // until it is sent again

// Of these only the newest message matters, and they are large.
Keep keep_of(const std::string& channel) {
  const bool is_large = channel == channels::kRgbdFrame || channel == channels::kPlanes;
  return is_large ? Keep::kNewest : Keep::kEvery;
}

class LiveSource : public MapSource {
 public:
  explicit LiveSource(const messaging::BusConfig& config)
      : bus_(config),
        messages_([this](const char* channel) { request(map_request_t::SNAPSHOT, channel, 0); }) {
    for (const std::string& channel : messages_.channels()) {
      bus_.subscribe(channel, keep_of(channel));
    }
    bus_.start();
  }

  std::string title() const override {
    const std::string& prefix = bus_.config().channel_prefix;
    return "live at " + bus_.config().url + (prefix.empty() ? prefix : ", " + prefix);
  }

  bool update(SceneModel& scene, Clock::time_point now) override {
    const Clock::time_point end = Clock::now() + kMostWork;
    const auto heard = scene.heard;
    bool is_changed = false;
    has_more_ = true;
    while (has_more_ && Clock::now() < end) {
      const auto message = bus_.take(now);
      has_more_ = message.has_value();
      if (!message) break;
      is_changed = messages_.take(message->channel, message->data, now, scene) || is_changed;
    }
    scene.overflowed = bus_.inbox().overflowed();
    if (heard && scene.heard != heard && now - *heard > kSilence) messages_.ask_for_all(now);
    note_left_out(scene);
    is_changed = messages_.poll(now, scene) || is_changed;
    is_changed = messages_.show_newest_frame(scene) || is_changed;
    replies_.take(messages_.take_replies());
    replies_.poll(now);
    return is_changed;
  }
  bool has_more() const override { return has_more_; }

  void edit(const mapping::EditCommand& command) override {
    geomap::map_edit_t message = mapping::to_message(command);
    message.epoch = messages_.view().epoch;
    message.seen_utime = messages_.view().utime;
    replies_.add(command.author, command.command, kEditPeriod, Clock::now(),
                 [this, message] { bus_.publish(channels::kMapEdit, message); });
  }

  std::vector<Outcome> take_outcomes() override { return replies_.take_outcomes(); }
  const std::vector<HistoryEntry>& history() const override { return messages_.history(); }

  std::int64_t save(const std::string& where) override {
    const std::string name =
        where.ends_with(kSuffix) ? where.substr(0, where.size() - kSuffix.size()) : where;
    const std::int64_t number = numbers_.next();
    replies_.add(author_, number, kSavePeriod, Clock::now(),
                 [this, name, number] { request(map_request_t::SAVE, name, number); });
    return number;
  }

  std::string default_save_name() const override {
    return mapping::local_time("map_%Y%m%d_%H%M%S");
  }
  std::string save_prompt() const override { return "name in the mapper's state folder"; }

  mapping::MapSnapshot snapshot(const SceneModel& scene) const override {
    return snapshot_of(scene.map);
  }
  mapping::MapSnapshot exact_snapshot(const SceneModel&) const override {
    throw std::runtime_error("JSON needs the exact map: save it and use geomap-export");
  }

  bool is_live() const override { return true; }

 private:
  static constexpr std::string_view kSuffix = ".lcmlog";  // the mapper appends it

  void request(std::int8_t kind, const std::string& name, std::int64_t number) {
    map_request_t message{};
    message.utime = number;
    message.author = author_;
    message.kind = kind;
    message.name = name;
    bus_.publish(channels::kMapRequest, message);
  }

  void note_left_out(SceneModel& scene) {
    for (const auto& [channel, count] : bus_.inbox().replaced()) {
      messages_.note_left_out(channel, count, scene);
    }
  }

  messaging::Bus bus_;
  std::string author_ = mapping::operator_name();
  mapping::CommandNumbers numbers_;
  SceneMessages messages_;
  AwaitedReplies replies_;
  bool has_more_ = false;  // in the inbox
};

}  // namespace

std::unique_ptr<MapSource> open_live(const messaging::BusConfig& config) {
  return std::make_unique<LiveSource>(config);
}

}  // namespace geomap::viewer
