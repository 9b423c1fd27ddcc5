// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "geomap/keyframe_t.hpp"
#include "messaging/config.hpp"
#include "messaging/live_process.hpp"
#include "messaging/sequence_gaps.hpp"
#include "perception/extractor_choice.hpp"

namespace geomap::perception {

/// @brief The settings of plane extraction. @throws messaging::ConfigError.
PlaneExtractionConfig read_extraction_config(const messaging::Config& config);

/// @brief geomap-planes: KEYFRAME in, PLANES out. Keeps nothing from one key frame to the next, so
/// that after a restart only what was in flight is missing.
class PlanesProcess {
 public:
  PlanesProcess(const PlaneExtractionConfig& config, messaging::LiveProcess& live);

  std::string summary() const;

 private:
  void take(const geomap::keyframe_t& keyframe);

  messaging::LiveProcess& live_;
  std::unique_ptr<PlaneExtractor> extractor_;
  messaging::SequenceGaps sequence_;
  std::optional<std::int64_t> session_;  // utime of the first key frame
  std::int64_t published_ = 0;
  std::int64_t planes_ = 0;
};

}  // namespace geomap::perception
