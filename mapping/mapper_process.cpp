// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mapper_process.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>
#include <variant>

#include "mapping/map_hash.hpp"
#include "mapping/map_journal.hpp"
#include "mapping/map_messages.hpp"
#include "messaging/channels.hpp"
#include "messaging/log.hpp"
#include "messaging/stopwatch.hpp"

namespace geomap::mapping {

namespace channels = messaging::channels;
using messaging::Keep;

namespace {

constexpr double kRetryPeriod = 1.0;  // of storing what could not be stored [s]

}  // namespace

MapperConfig read_mapper_config(const messaging::Config& config) {
  return {config.read<MergeConfig>("merge"), config.read<HistoryConfig>("history"),
          config.read<MapViewConfig>("mapper")};
}

MapperProcess::MapperProcess(const MapperConfig& config, std::unique_ptr<EventJournal> journal,
                             messaging::LiveProcess& live)
    : live_(live),
      config_(config),
      journal_(std::move(journal)),
      map_(first_map()),
      view_(config.view, map_, live),
      edits_(map_, live, [this](const EditResult& done, ViewCause cause) {
        store(done.edit);
        publish(done.change, cause);
      }) {
  live_.on<geomap::plane_set_t>(channels::kPlanes, Keep::kEvery,
                                [this](const geomap::plane_set_t& planes) { take_planes(planes); });
  live_.on<geomap::keyframe_update_t>(
      channels::kKeyframeUpdate, Keep::kEvery,
      [this](const geomap::keyframe_update_t& update) { take_update(update); });
  live_.on<geomap::map_edit_t>(
      channels::kMapEdit, Keep::kEvery,
      [this](const geomap::map_edit_t& edit) { edits_.take(edit, view_.view()); });
  live_.on<geomap::map_edit_reply_t>(
      channels::kMapEditReply, Keep::kEvery,
      [this](const geomap::map_edit_reply_t& reply) { edits_.take_reply(reply, view_.view()); });
  live_.on_request([this](const geomap::map_request_t& request) { take_request(request); });
  if (!journal_) return;
  messaging::log_info(journal_->recovery());
  live_.every(kRetryPeriod, [this] {
    journal_->retry(map_);
    report_trouble();
  });
}

GeometricMap MapperProcess::first_map() const {
  if (journal_) return journal_->open(config_.merge, config_.history);
  return {config_.merge, config_.history};
}

void MapperProcess::take_planes(const geomap::plane_set_t& message) {
  live_.note_missing(channels::kPlanes, sequence_.note(message.session, message.sequence));
  live_.health().note_utime(message.utime);
  if (live_.is_paused()) {
    live_.health().count("paused.keyframes");
    return;
  }
  const auto observation = from_message(message);
  if (!observation) {
    live_.reject(channels::kPlanes, "bad_plane");
    return;
  }
  apply(channels::kPlanes, observation, ViewCause::kObservation);
}

void MapperProcess::take_update(const geomap::keyframe_update_t& update) {
  for (const MapEvent& event : from_message(update)) {
    const bool is_removal = std::holds_alternative<KeyframeRemoval>(event);
    apply(channels::kKeyframeUpdate, event,
          is_removal ? ViewCause::kKeyframeRemoval : ViewCause::kPoseCorrection);
  }
}

void MapperProcess::take_request(const geomap::map_request_t& request) {
  using Request = geomap::map_request_t;
  switch (request.kind) {
    case Request::CLEAR:
    case Request::RESET:
      replace_map({config_.merge, config_.history}, ViewCause::kReset);
      messaging::log_info("map cleared");
      break;
    case Request::SNAPSHOT:
      if (request.name.empty() || request.name == channels::kMapSnapshot) view_.request_snapshot();
      if (request.name.empty() || request.name == channels::kMapEditRecord) {
        edits_.publish_all(view_.view());
      }
      break;
    case Request::SAVE:
      answer(request, [&] { return save(request.name); });
      break;
    case Request::LOAD:
      answer(request, [&] { return load(request.name); });
      break;
    default:
      live_.reject(channels::kMapRequest, "unknown_kind");
      break;
  }
}

void MapperProcess::apply(const std::string& channel, const MapEvent& event, ViewCause cause) {
  const messaging::Stopwatch merging;
  const ApplyResult applied = map_.apply(event);
  live_.health().time("merging", merging.seconds());
  if (applied.fault != EventFault::kNone) {
    live_.reject(channel, to_string(applied.fault));
    return;
  }
  store(event);
  publish(applied.change, cause);
  edits_.note_change(view_.view());
}

void MapperProcess::store(const MapEvent& event) {
  if (!journal_) return;
  const messaging::Stopwatch storing;
  journal_->add(event, map_);
  live_.health().time("journal", storing.seconds());
  report_trouble();
}

void MapperProcess::replace_map(GeometricMap map, ViewCause cause) {
  const MapChange change = difference(map_.features(), map.features());
  map_ = std::move(map);
  if (journal_) {
    journal_->replace(map_);
    report_trouble();
  }
  publish(change, cause);
  edits_.publish_all(view_.view());
}

// What is thrown goes on to the handler's edge, which counts and logs it.
void MapperProcess::answer(const geomap::map_request_t& request,
                           const std::function<std::string()>& task) {
  try {
    acknowledge(request, true, task());
  } catch (const std::exception& error) {
    acknowledge(request, false, error.what());
    throw;
  }
}

void MapperProcess::acknowledge(const geomap::map_request_t& request, bool is_done,
                                const std::string& text) {
  if (request.utime == 0) return;
  geomap::map_edit_reply_t reply{};
  reply.utime = map_.history().newest();
  reply.command = request.utime;
  reply.author = request.author;
  reply.epoch = view_.view().epoch;
  reply.revision = view_.view().revision;
  reply.done = is_done ? 1 : 0;
  reply.text = text;
  live_.publish(channels::kMapEditReply, reply);
}

std::string MapperProcess::save(const std::string& name) {
  if (!journal_) throw std::runtime_error("maps are saved only with --state DIR");
  save_map(journal_->file_of(name), map_);
  messaging::log_info("map saved as " + journal_->file_of(name).string());
  return "map saved as " + name;
}

std::string MapperProcess::load(const std::string& name) {
  if (!journal_) throw std::runtime_error("maps are loaded only with --state DIR");
  const std::filesystem::path file = journal_->file_of(name);
  replace_map(reopen(load_map(file), config_.merge, config_.history), ViewCause::kLoad);
  messaging::log_info("map loaded from " + file.string());
  return "map loaded from " + name;
}

void MapperProcess::publish(const MapChange& change, ViewCause cause) {
  const messaging::Stopwatch viewing;
  view_.publish(map_, change, cause);
  live_.health().time("view", viewing.seconds());
}

void MapperProcess::report_trouble() {
  const std::string& trouble = journal_->trouble();
  if (trouble == reported_trouble_) return;
  reported_trouble_ = trouble;
  if (trouble.empty()) {
    messaging::log_info("all of the map is stored again");
    live_.health().set_trouble(geomap::health_t::GOOD, "");
  } else {
    messaging::log_error(trouble);
    live_.health().set_trouble(geomap::health_t::FAILING, trouble);
  }
}

std::string MapperProcess::summary() const {
  const MapView& view = view_.view();
  const EventHistory& history = map_.history();
  const auto keyframes = std::count_if(
      history.keyframes().begin(), history.keyframes().end(),
      [&](const auto& keyframe) { return !history.edits().is_dropped(keyframe.first); });
  return fmt::format("{} features of {} key frames\nmap_hash {}\nview_hash {}, revision {}\n",
                     map_.features().size(), keyframes, map_hash(map_.features(), map_.vetoes()),
                     view_hash(view), view.revision);
}

}  // namespace geomap::mapping
