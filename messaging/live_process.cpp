// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/live_process.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "messaging/channels.hpp"
#include "messaging/host_clock.hpp"
#include "messaging/log.hpp"
#include "messaging/stopwatch.hpp"

namespace geomap::messaging {
namespace {

constexpr double kHealthPeriod = 1.0;  // [s]
constexpr double kListen = 1.2;        // for another copy, before anything is done [s]

}  // namespace

void declare_live(OptionParser& parser, LiveOptions& options) {
  parser.flag("--lossless", options.lossless,
              "take every message in its order, as a replay does, and fail when one is missing; "
              "else the newest frame counts");
  parser.option("--spool-mb", options.spool_mb, "memory for messages that wait for their turn");
}

LiveProcess::LiveProcess(const std::string& name, const CommonOptions& common,
                         const LiveOptions& live)
    : bus_({common.lcm_url, common.channel_prefix, live.lossless, std::max(1.0, live.spool_mb)}),
      health_(name, common.config.hash(), host_microseconds()) {
  set_log_name(name);
  on<geomap::health_t>(channels::kHealth, Keep::kEvery,
                       [this](const geomap::health_t& other) { take_health(other); });
  every(kHealthPeriod, [this] { publish_health(); });
}

void LiveProcess::on_bytes(const std::string& channel, Keep keep,
                           std::function<void(const std::string& channel, Bytes data)> handler) {
  bus_.subscribe(channel, keep);
  handlers_[channel] = std::move(handler);
}

void LiveProcess::on_request(std::function<void(const geomap::map_request_t&)> handler) {
  using Request = geomap::map_request_t;
  on<Request>(channels::kMapRequest, Keep::kEvery,
              [this, handler = std::move(handler)](const Request& request) {
                if (request.kind != Request::PAUSE && request.kind != Request::RESUME) {
                  handler(request);
                  return;
                }
                is_paused_ = request.kind == Request::PAUSE;
                log_info(is_paused_ ? "paused" : "resumed");
              });
}

void LiveProcess::every(double period, std::function<void()> task) {
  tasks_.push_back({Inbox::duration(period), Clock::now(), std::move(task)});
}

void LiveProcess::reject(const std::string& channel, const std::string& reason) {
  health_.count("rejected." + channel + "." + reason);
}

void LiveProcess::note_missing(const std::string& channel, std::int64_t messages) {
  if (messages <= 0) return;
  health_.count("missing." + channel, messages);
  if (!bus_.config().lossless) return;
  throw FatalFault(fmt::format(
      "{} messages of {} are missing: send more slowly, use a tcpq URL, or leave out --lossless",
      messages, channel));
}

int LiveProcess::run(const std::function<void()>& finish,
                     const std::function<std::string()>& summary) {
  bus_.start();
  log_info(fmt::format("listening at {}{}", bus_.config().url,
                       bus_.config().lossless ? ", lossless" : ""));
  refuse_second_copy();
  while (!stop_requested()) {
    if (const auto message = bus_.take(next_due())) dispatch(*message);
    run_due_tasks();
  }
  bus_.stop_receiving();
  while (const auto message = bus_.take(Clock::now())) dispatch(*message);
  finish();
  publish_health();
  std::printf("%s%s", health_.summary().c_str(), summary().c_str());
  return 0;
}

// What else arrives meanwhile waits in the inbox.
void LiveProcess::refuse_second_copy() {
  publish_health();
  const Clock::time_point end = Clock::now() + Inbox::duration(kListen);
  while (!stop_requested()) {
    const auto message = bus_.take(channels::kHealth, end);
    if (!message) break;
    dispatch(*message);
  }
}

// The older copy stays: it holds the map.
void LiveProcess::take_health(const geomap::health_t& other) {
  if (other.process != health_.process() || other.started >= health_.started()) return;
  throw FatalFault("another " + other.process +
                   " runs on these channels: stop it, or give this one a --channel-prefix");
}

void LiveProcess::dispatch(const Received& message) {
  const Stopwatch handling;
  health_.count("in." + message.channel);
  try {
    handlers_.at(message.channel)(message.channel, message.data);
  } catch (const FatalFault&) {
    throw;
  } catch (const std::exception& error) {
    health_.count("failed." + message.channel);
    log_error(message.channel + ": " + error.what());
  }
  if (message.channel != channels::kHealth) health_.time(message.channel, handling.seconds());
}

LiveProcess::Clock::time_point LiveProcess::next_due() const {
  return std::min_element(tasks_.begin(), tasks_.end(),
                          [](const Task& a, const Task& b) { return a.due < b.due; })
      ->due;
}

void LiveProcess::run_due_tasks() {
  const Clock::time_point now = Clock::now();
  for (Task& task : tasks_) {
    if (now < task.due) continue;
    task.due = now + task.period;
    task.run();
  }
}

void LiveProcess::publish_health() {
  for (const auto& [channel, count] : bus_.inbox().replaced()) {
    health_.set("replaced." + channel, count);
  }
  health_.set("overflowed", bus_.inbox().overflowed());
  health_.set("unsent", bus_.unsent());
  if (bus_.config().lossless && bus_.inbox().overflowed() > 0) {
    throw FatalFault(
        "messages came faster than they could be taken: raise --spool-mb, send more "
        "slowly, or use a tcpq URL");
  }
  bus_.publish(channels::kHealth, health_.take_message());
}

}  // namespace geomap::messaging
