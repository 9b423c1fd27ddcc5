// SPDX-License-Identifier: BSD-3-Clause
#include "perception/registration.hpp"

#include <stdexcept>

namespace geomap::perception {

std::string_view to_string(RegistrationReason reason) {
  switch (reason) {
    case RegistrationReason::kPriorTrusted:
      return "prior_trusted";
    case RegistrationReason::kTooFewReadings:
      return "too_few_readings";
    case RegistrationReason::kInvalidPrior:
      return "invalid_prior";
  }
  throw std::invalid_argument("no such registration reason");
}

}  // namespace geomap::perception
