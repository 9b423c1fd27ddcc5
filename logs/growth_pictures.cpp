// SPDX-License-Identifier: BSD-3-Clause
#include "logs/growth_pictures.hpp"

#include <fmt/format.h>

#include "mapping/export_file.hpp"
#include "mapping/export_svg.hpp"
#include "mapping/map_journal.hpp"

namespace geomap::logs {
void GrowthPictures::note(const mapping::GeometricMap& map, const mapping::MapChange& change) {
  if (every_ == 0) return;
  ++keyframes_;
  if (keyframes_ != 1 && keyframes_ % every_ != 0) return;
  moments_.push_back({keyframes_,
                      map.revision(),
                      map.features(),
                      {change.upserted.begin(), change.upserted.end()}});
}

void GrowthPictures::write(const std::filesystem::path& folder) const {
  if (moments_.empty()) return;
  std::filesystem::create_directories(folder);
  mapping::SvgOptions options;
  options.views = {mapping::SvgView::kOblique};
  const mapping::MapSnapshot last =
      mapping::snapshot_of(moments_.back().revision, moments_.back().features);
  options.heading = mapping::front_heading(last.features);
  options.turn = mapping::oblique_turn(last.features, *options.heading);
  options.extent.emplace();
  for (const mapping::MapFeature& feature : last.features) {
    options.extent->extend(feature.surface.bounding_box());
  }
  for (const Moment& moment : moments_) {
    options.title = fmt::format("After key frame {}", moment.keyframes);
    options.highlighted = moment.touched;
    mapping::write_file(
        folder / fmt::format("keyframe_{:04}.svg", moment.keyframes),
        mapping::to_svg(mapping::snapshot_of(moment.revision, moment.features), options));
  }
}

}  // namespace geomap::logs
