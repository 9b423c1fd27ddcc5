// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/open_file_client.hpp"

#include "messaging/channels.hpp"
#include "messaging/log_reader.hpp"
#include "viewer/log_source_client.hpp"
#include "viewer/map_file_client.hpp"

namespace geomap::viewer {

std::unique_ptr<MapSource> open_file(const std::filesystem::path& file) {
  namespace channels = messaging::channels;
  const auto first = messaging::LogReader(file.string()).next();
  const bool is_map =
      first && (first->channel == channels::kMapEvent || first->channel == channels::kMapState);
  return is_map ? open_map_file(file) : open_log(file);
}

}  // namespace geomap::viewer
