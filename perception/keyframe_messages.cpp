// SPDX-License-Identifier: BSD-3-Clause
#include "perception/keyframe_messages.hpp"

#include <stdexcept>

#include "messaging/convert_geometry.hpp"

namespace geomap::perception {
namespace {

std::int8_t status_of(RegistrationReason reason) {
  using Message = geomap::keyframe_t;
  switch (reason) {
    case RegistrationReason::kAligned:
    case RegistrationReason::kFirst:
    case RegistrationReason::kPriorTrusted:
    case RegistrationReason::kUnknownView:
      return Message::ACCEPTED;
    case RegistrationReason::kTooFewReadings:
      return Message::TOO_FEW_POINTS;
    case RegistrationReason::kInvalidPrior:
      return Message::NO_PRIOR;
    case RegistrationReason::kOverlapTooSmall:
      return Message::OVERLAP_TOO_SMALL;
    case RegistrationReason::kSeenThrough:
      return Message::SEEN_THROUGH;
    case RegistrationReason::kRmsTooLarge:
      return Message::RMS_TOO_LARGE;
    case RegistrationReason::kNotConverged:
      return Message::NOT_CONVERGED;
    case RegistrationReason::kTooFarFromPrior:
      return Message::TOO_FAR_FROM_PRIOR;
    case RegistrationReason::kUnderconstrained:
      return Message::UNDERCONSTRAINED;
  }
  throw std::invalid_argument("no such registration reason");
}

bot_core::image_t without_data(const bot_core::image_t& image) {
  bot_core::image_t empty = image;
  empty.size = 0;
  empty.data.clear();
  return empty;
}

}  // namespace

geomap::keyframe_t to_message(const RegistrationResult& registration,
                              const geomap::rgbd_frame_t& frame, std::int64_t session,
                              std::int64_t sequence) {
  geomap::keyframe_t message{};
  message.utime = frame.utime;
  message.session = session;
  message.sequence = sequence;
  message.status = status_of(registration.reason);
  message.T_world_camera_prior = messaging::to_message(registration.T_world_camera_prior);
  message.T_world_camera = messaging::to_message(registration.T_world_camera);
  if (registration.alignment) {
    const Alignment& found = *registration.alignment;
    message.rms = found.rms;
    message.overlap = found.overlap;
    message.conditioning = found.conditioning;
    message.observed_directions = found.observed_directions;
    message.points = found.partners;
    message.iterations = found.iterations;
  }
  message.frame = frame;
  if (!registration.accepted) {
    message.frame.depth = without_data(frame.depth);
    message.frame.color = without_data(frame.color);
  }
  return message;
}

}  // namespace geomap::perception
