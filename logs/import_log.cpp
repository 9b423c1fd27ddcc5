// SPDX-License-Identifier: BSD-3-Clause
#include "logs/import_log.hpp"

#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "logs/log_pass.hpp"
#include "logs/other_file.hpp"
#include "messaging/channels.hpp"
#include "messaging/log_writer.hpp"
#include "messaging/message_schema.hpp"
#include "messaging/part_file.hpp"
#include "messaging/safe_decode.hpp"

namespace geomap::logs {
namespace {

namespace channels = messaging::channels;
using messaging::FrameFault;
using messaging::LogEvent;

template <class Message>
bool is_a(const LogEvent& event) {
  return messaging::fingerprint_of(event.data) == Message::getHash();
}

std::string describe(FrameFault fault) {
  const std::string name = messaging::to_string(fault);
  return fault == FrameFault::kBadSize ? name + " (driver_camera says which size images have)"
                                       : name;
}

// Writes events one by one and keeps count.
class LogImporter {
 public:
  LogImporter(const LogImportSettings& settings, messaging::LogWriter& log)
      : settings_(settings), log_(log) {
    summary_.channel = settings.channel;
  }

  void add(const LogEvent& event) {
    if (event.channel == channels::kRgbdFrame) {
      throw std::runtime_error("the log holds RGBD_FRAME already");
    }
    if (is_frame(event)) {
      is_a<bot_core::images_t>(event) ? add_frame<bot_core::images_t>(event)
                                      : add_frame<kinect::frame_msg_t>(event);
    } else {
      log_.write_bytes(event.channel, event.log_utime, event.data);
      ++summary_.copied;
    }
  }

  const LogImportSummary& summary() const { return summary_; }

 private:
  bool is_frame(const LogEvent& event) {
    if (!settings_.channel.empty()) return event.channel == settings_.channel;
    if (!is_a<bot_core::images_t>(event) && !is_a<kinect::frame_msg_t>(event)) {
      return event.channel == summary_.channel;  // a damaged one is a bad frame
    }
    if (summary_.channel.empty()) summary_.channel = event.channel;
    if (event.channel == summary_.channel) return true;
    throw std::runtime_error("frames on " + summary_.channel + " and on " + event.channel +
                             ": choose one with --channel");
  }

  template <class Message>
  void add_frame(const LogEvent& event) {
    const auto decoded = messaging::safe_decode<Message>(event.data.data(), event.data.size());
    if (!decoded.message) return add_bad(event, messaging::to_string(decoded.reason));
    auto [frame, fault] = messaging::to_own_message(*decoded.message, settings_.cameras);
    if (!frame) return add_bad(event, describe(fault));
    frame->sequence = static_cast<std::int64_t>(summary_.frames++);  // what is left out is no loss
    log_.write(channels::kRgbdFrame, event.log_utime, *frame);
  }

  void add_bad(const LogEvent& event, const std::string& reason) {
    const std::string what =
        "event " + std::to_string(event.number) + " on " + event.channel + ": " + reason;
    if (!settings_.skip_bad) throw std::runtime_error(what);
    if (summary_.frames_bad++ == 0) summary_.first_bad = what;
  }

  const LogImportSettings& settings_;
  messaging::LogWriter& log_;
  LogImportSummary summary_;
};

}  // namespace

LogImportSummary import_log(const std::string& log, const LogImportSettings& settings,
                            const std::string& out) {
  messaging::LogReader reader(log);
  require_other_file(log, out);
  require_other_file(log, messaging::PartFile::part_of(out));
  messaging::PartFile part(out);
  messaging::LogWriter writer(part.name());
  LogImporter importer(settings, writer);
  read_events(reader, [&](const LogEvent& event) { importer.add(event); });

  LogImportSummary summary = importer.summary();
  if (summary.frames == 0) {
    throw std::runtime_error(
        "no frame to import" +
        (summary.first_bad.empty() ? "" : "; the first one: " + summary.first_bad));
  }
  writer.close();
  summary.damages = reader.damages().size();
  summary.log_bytes = std::filesystem::file_size(part.name());
  part.keep();
  return summary;
}

std::string to_string(const LogImportSummary& summary) {
  std::string line = std::to_string(summary.frames) + " frames of " + summary.channel + ", " +
                     std::to_string(summary.copied) + " other events";
  char text[32];
  std::snprintf(text, sizeof text, ", %.1f MB", 1e-6 * static_cast<double>(summary.log_bytes));
  line += text;
  if (summary.frames_bad > 0) {
    line += "; " + std::to_string(summary.frames_bad) +
            " unreadable frames left out, the first: " + summary.first_bad;
  }
  if (summary.damages > 0) {
    line += "; " + std::to_string(summary.damages) + " damaged places of the log passed over";
  }
  return line;
}

}  // namespace geomap::logs
