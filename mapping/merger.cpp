// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/merger.hpp"

#include <stdexcept>

#include "mapping/moments_merger.hpp"
#include "mapping/paper_merger.hpp"

namespace geomap::mapping {

std::unique_ptr<Merger> make_merger(const MergeConfig& config) {
  const std::vector<std::string> messages = config.validate();
  if (!messages.empty()) throw std::invalid_argument("merge: " + messages.front());
  if (config.mode == "paper") return std::make_unique<PaperMerger>(config);
  return std::make_unique<MomentsMerger>(config);
}

}  // namespace geomap::mapping
