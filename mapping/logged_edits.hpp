// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mapping/edit.hpp"

namespace geomap::mapping {

/// @brief The edits of a log, for a replay: each waits until it is known where it has its place,
/// which its reply says, and the map has got there. So a replay gives the same map however its
/// timing differs from the first time.
class LoggedEdits {
 public:
  struct Placed {
    EditCommand command;
    std::int64_t after = 0;  // key frame behind which it has its place [us]
  };

  /// @param seen_utime newest key frame that the operator had seen [us]; 0: not known.
  void add(EditCommand command, std::int64_t seen_utime);
  /// @brief A reply: `after` is the edit's place, unless it was refused.
  void take_reply(const std::string& author, std::int64_t command, bool is_done,
                  std::int64_t after);

  /// @brief The next edit whose place the map has reached, in the order of the replies.
  /// @param newest key frame in the map [us].
  std::optional<Placed> next(std::int64_t newest);
  /// @brief At the end of the log: the next of all that are left. One without a reply has its place
  /// behind what its author had seen.
  std::optional<Placed> next_at_end();

 private:
  struct Waiting {
    EditCommand command;
    std::int64_t seen_utime = 0;
  };

  std::vector<Waiting> waiting_;  // for their replies
  std::deque<Placed> placed_;     // in the order of the replies
};

}  // namespace geomap::mapping
