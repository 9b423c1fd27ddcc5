// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "perception/organized_extractor.hpp"
#include "perception/plane_extractor.hpp"
#include "perception/ransac_extractor.hpp"

namespace geomap::perception {

/// @brief Which plane extractor is in use.
struct ExtractorChoice {
  std::string extractor = "organized";  // organized: from the image grid; ransac: as in the paper

  std::vector<std::string> validate() const;

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& visitor) {
    visitor("extractor", self.extractor);
  }
};

/// @brief The settings of plane extraction: one member per section of config/default.yaml.
struct PlaneExtractionConfig {
  ExtractorChoice choice;              // section extraction
  OrganizedExtractorConfig organized;  // section organized
  RansacExtractorConfig ransac;        // section ransac
};

/// @brief The chosen extractor. @throws std::invalid_argument for invalid settings.
std::unique_ptr<PlaneExtractor> make_extractor(const PlaneExtractionConfig& config);

}  // namespace geomap::perception
