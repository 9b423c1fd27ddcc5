// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace geomap::messaging {

/// @brief Finds messages that are missing by their sequence numbers.
class SequenceGaps {
 public:
  /// @brief How many messages are missing before this one.
  std::int64_t note(std::int64_t sequence) {
    constexpr std::int64_t kRestart = 1'000'000;  // a longer jump is another sender, not a loss
    const bool is_gap = last_ >= 0 && sequence > last_ && sequence - last_ < kRestart;
    const std::int64_t missing = is_gap ? sequence - last_ - 1 : 0;
    last_ = sequence;
    return missing;
  }
  /// @brief The same for numbers that begin anew, from 0, with each session of the sender.
  std::int64_t note(std::int64_t session, std::int64_t sequence) {
    if (session != session_) last_ = -1;
    session_ = session;
    return note(sequence);
  }

 private:
  std::int64_t last_ = -1;  // negative: none yet
  std::int64_t session_ = -1;
};

}  // namespace geomap::messaging
