// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace geomap::messaging {

/// @brief One message as it came.
struct Received {
  std::string channel;
  std::vector<std::uint8_t> data;
};

/// @brief Which messages of a channel wait for their turn.
enum class Keep {
  kEvery,
  kNewest,  // a newer one takes the place of one that still waits
};

/// @brief What to do with a message for which there is no room.
enum class WhenFull {
  kDrop,  // and count it
  kWait,  // until there is room: the sender is slowed where the transport can
};

/// @brief Messages on their way from the thread that receives to the one that works, in the order
/// of their arrival. May be used from several threads.
class Inbox {
 public:
  using Clock = std::chrono::steady_clock;
  static Clock::duration duration(double seconds) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  }

  /// @param most_bytes that may wait. A single larger message still finds room in an empty inbox.
  Inbox(std::size_t most_bytes, WhenFull when_full);

  void put(Received message, Keep keep);
  /// @brief The oldest message; nothing when none has come until `deadline`.
  std::optional<Received> take(Clock::time_point deadline);
  /// @brief The same for one channel; the others' messages keep their places.
  std::optional<Received> take(const std::string& channel, Clock::time_point deadline);
  /// @brief Lets a put() that waits go on, and drops what comes from now on.
  void close();

  /// @brief Counts a message for which there was no memory.
  void note_overflow();

  /// @brief Messages that a newer one has replaced, by channel.
  std::map<std::string, std::int64_t> replaced() const;
  /// @brief Messages for which there was no room.
  std::int64_t overflowed() const;

 private:
  using Queue = std::list<Received>;
  bool has_room(std::size_t bytes) const;
  Received remove(Queue::iterator message);

  const std::size_t most_bytes_;
  const WhenFull when_full_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_, taken_;
  Queue queue_;
  std::map<std::string, Queue::iterator> newest_;  // of channels with Keep::kNewest
  std::size_t bytes_ = 0;
  bool closed_ = false;
  std::map<std::string, std::int64_t> replaced_;
  std::int64_t overflowed_ = 0;
};

}  // namespace geomap::messaging
