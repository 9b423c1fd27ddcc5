// SPDX-License-Identifier: BSD-3-Clause
#include "perception/registration.hpp"

#include <algorithm>
#include <stdexcept>

namespace geomap::perception {

std::string_view to_string(RegistrationReason reason) {
  switch (reason) {
    case RegistrationReason::kAligned:
      return "aligned";
    case RegistrationReason::kFirst:
      return "first";
    case RegistrationReason::kPriorTrusted:
      return "prior_trusted";
    case RegistrationReason::kUnknownView:
      return "unknown_view";
    case RegistrationReason::kTooFewReadings:
      return "too_few_readings";
    case RegistrationReason::kInvalidPrior:
      return "invalid_prior";
    case RegistrationReason::kOverlapTooSmall:
      return "overlap_too_small";
    case RegistrationReason::kSeenThrough:
      return "seen_through";
    case RegistrationReason::kRmsTooLarge:
      return "rms_too_large";
    case RegistrationReason::kNotConverged:
      return "not_converged";
    case RegistrationReason::kTooFarFromPrior:
      return "too_far_from_prior";
    case RegistrationReason::kUnderconstrained:
      return "underconstrained";
  }
  throw std::invalid_argument("no such registration reason");
}

int count_readings(const geometry::DepthImage& depth) {
  return static_cast<int>(std::count_if(depth.millimetres.begin(), depth.millimetres.end(),
                                        geometry::DepthImage::is_reading));
}

}  // namespace geomap::perception
