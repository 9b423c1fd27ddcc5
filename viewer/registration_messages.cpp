// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/registration_messages.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>

namespace geomap::viewer {
namespace {

using Message = geomap::keyframe_t;

constexpr int kLostAfter = 3;  // rejected key frames in a row

// Nothing for a status that is not known.
std::optional<std::string> reason_of(const Message& message) {
  switch (message.status) {
    case Message::TOO_FEW_POINTS:
      return "too few points were measured";
    case Message::NOT_CONVERGED:
      return fmt::format("the alignment did not settle in {} steps", message.iterations);
    case Message::RMS_TOO_LARGE:
      return fmt::format("its points lie too far from the map ({:.1f} cm)", 100.0 * message.rms);
    case Message::OVERLAP_TOO_SMALL:
      return fmt::format("too little overlap with the map ({:.2f})", message.overlap);
    case Message::TOO_FAR_FROM_PRIOR:
      return "the alignment is too far from the predicted pose";
    case Message::NO_PRIOR:
      return "no pose was predicted for it";
    case Message::SEEN_THROUGH:
      return "it would look through surfaces of the map";
    case Message::UNDERCONSTRAINED:
      return fmt::format("the view fixes only {} of 6 directions of motion",
                         message.observed_directions);
    default:
      return std::nullopt;
  }
}

}  // namespace

Taken note_registration(const Message& message, RegistrationState& state) {
  if (message.status == Message::ACCEPTED) {
    state = {Level::kGood, "ok", 0};
    return Taken::kChange;
  }
  const auto reason = reason_of(message);
  if (!reason) return Taken::kRefused;
  ++state.rejected_in_row;
  const bool is_lost = state.rejected_in_row >= kLostAfter;
  state.level = is_lost ? Level::kFailing : Level::kDegraded;
  state.text = is_lost
                   ? fmt::format("lost: {} key frames in a row rejected, the last one because {}",
                                 state.rejected_in_row, *reason)
                   : fmt::format("rejected: {}", *reason);
  return Taken::kChange;
}

}  // namespace geomap::viewer
