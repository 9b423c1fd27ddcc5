// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "mapping/edit.hpp"
#include "mapping/map_snapshot.hpp"
#include "viewer/scene_model.hpp"

namespace geomap::viewer {

/// @brief What came of a command, or of a request to save.
struct Outcome {
  std::int64_t command = 0;  // EditCommand::command; of save(): what it returned
  bool is_done = false;
  std::string text;           // in words: what was done, or why not
  std::int64_t edit = 0;      // number in the history; 0: none
  std::int64_t revision = 0;  // of the view from which on it is to be seen
};

/// @brief One edit of the map's history.
struct HistoryEntry {
  enum class State { kDone, kUndone, kRevoked, kIdle };
  std::int64_t number = 0;
  std::int64_t utime = 0;  // operator's clock [us]
  std::string author, text;
  mapping::EditKind kind = mapping::EditKind::kDelete;
  State state = State::kDone;
  std::string reason;      // why it is not simply done
  bool keeps_out = false;  // it closes surfaces to observations: can be restored
};

/// @brief The time line of a log.
class Playback {
 public:
  virtual ~Playback() = default;
  virtual double duration() const = 0;  // [s]
  virtual double position() const = 0;  // [s] from the beginning
  virtual bool is_playing() const = 0;
  virtual void play(bool on) = 0;
  virtual double speed() const = 0;
  virtual void set_speed(double times) = 0;
  /// @brief To a time; backwards it is read again from the beginning, with progress() in between.
  virtual void seek(double seconds) = 0;
  /// @brief To the next key frame (or, where there is none, the next planes, frame, or whatever the
  /// log holds most of), and pauses there.
  virtual void step() = 0;
  /// @brief Share of a seek that is done, 0 to 1; 1: no seek is under way.
  virtual double progress() const = 0;
};

/// @brief Where the scene comes from and edits go: a running system, a saved map, or a log.
class MapSource {
 public:
  virtual ~MapSource() = default;

  /// @brief For people: "live at udpm://...", "map.lcmlog", "drive.lcmlog".
  virtual std::string title() const = 0;

  /// @brief Takes what has come since the last call into the scene; does not wait, and works no
  /// longer than some 20 ms. @return true when a layer has changed.
  virtual bool update(SceneModel& scene, Clock::time_point now) = 0;
  /// @brief True when the last update left something for the next one, so that nobody should pause.
  virtual bool has_more() const { return false; }

  /// @brief Asks for an edit, whose author and number the caller has given (operator_name(),
  /// CommandNumbers). What becomes of it comes with take_outcomes(); what is lost on the
  /// way is sent again, and after some seconds without an answer the outcome says so.
  virtual void edit(const mapping::EditCommand& command) = 0;
  virtual std::vector<Outcome> take_outcomes() = 0;
  virtual const std::vector<HistoryEntry>& history() const = 0;

  /// @brief Saves the exact map: of a running mapper under a name in its state folder, of a file at
  /// a path. @return command number of the outcome.
  virtual std::int64_t save(const std::string& where) = 0;
  /// @brief Where save() would by default; and what a person is asked for: "name in the mapper's
  /// state folder" or "file".
  virtual std::string default_save_name() const = 0;
  virtual std::string save_prompt() const = 0;

  /// @brief The map for exports of its looks (.ply, .obj, .glb, .svg). Of a running system it is
  /// what the operator sees: on the grid of the view, up to its tolerance from the exact map, and
  /// without hash, moments, observations, other labels and the numbers of edits.
  /// @throws std::runtime_error.
  virtual mapping::MapSnapshot snapshot(const SceneModel& scene) const = 0;
  /// @brief The map for exports of all that is known (.json).
  /// @throws std::runtime_error, one line, where only the view is known.
  virtual mapping::MapSnapshot exact_snapshot(const SceneModel& scene) const {
    return snapshot(scene);
  }

  /// @brief Null where there is no time line.
  virtual Playback* playback() { return nullptr; }
  /// @brief True when the messages come from processes that run now: then silence is a warning.
  virtual bool is_live() const { return false; }
};

}  // namespace geomap::viewer
