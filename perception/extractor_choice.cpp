// SPDX-License-Identifier: BSD-3-Clause
#include "perception/extractor_choice.hpp"

namespace geomap::perception {

std::vector<std::string> ExtractorChoice::validate() const {
  ConfigChecks check;
  check.one_of("extractor", extractor, {"organized", "ransac"});
  return check.messages;
}

std::unique_ptr<PlaneExtractor> make_extractor(const PlaneExtractionConfig& config) {
  require_no_faults("plane extraction", config.choice.validate());
  if (config.choice.extractor == "ransac") return std::make_unique<RansacExtractor>(config.ransac);
  return std::make_unique<OrganizedExtractor>(config.organized);
}

}  // namespace geomap::perception
